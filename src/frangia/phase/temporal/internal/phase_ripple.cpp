#include "frangia/phase/temporal/internal/phase_ripple.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

constexpr int kRippleUnknowns =
    5;  // a constant, and cosine and sine of one and two times the phase
using RippleMatrix = Eigen::Matrix<double, kRippleUnknowns, kRippleUnknowns>;
using RippleVector = Eigen::Matrix<double, kRippleUnknowns, 1>;

constexpr std::size_t kRippleBlocks = 20;   // of neighbours, of which one at a time is left out
constexpr double kMinRippleSquares = 16.0;  // squared amplitude over its variance
constexpr std::size_t kMinRipplePixels = 300;

struct RippleEquations {
  RippleMatrix normal = RippleMatrix::Zero();
  RippleVector right = RippleVector::Zero();
};

}  // namespace

double phase_ripple(std::span<const float> phases_rad, std::span<const double> errors_rad) {
  const std::size_t count = phases_rad.size();
  if (count < kMinRipplePixels) return 0.0;
  std::complex<double> mean = 0.0;
  for (const double error : errors_rad)
    mean += std::polar(1.0, error);
  const double start_rad = std::arg(mean);
  std::vector<RippleEquations> blocks(kRippleBlocks);
  RippleEquations all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto phase = static_cast<double>(phases_rad[i]);
    RippleVector row;
    row << 1.0, std::cos(phase), std::sin(phase), std::cos(2.0 * phase), std::sin(2.0 * phase);
    const double error = wrap_rad(errors_rad[i] - start_rad);
    for (RippleEquations* one : {&all, &blocks[i * kRippleBlocks / count]}) {
      one->normal += row * row.transpose();
      one->right += error * row;
    }
  }
  const RippleVector found = solve_symmetric(all.normal, all.right);
  RippleVector variance = RippleVector::Zero();  // jackknife
  for (const RippleEquations& block : blocks) {
    const RippleVector without =
        solve_symmetric(all.normal - block.normal, all.right - block.right);
    variance += (without - found).cwiseAbs2();
  }
  constexpr auto kCount = static_cast<double>(kRippleBlocks);
  const double chance = variance.tail<4>().sum() * (kCount - 1.0) / kCount;
  const double square = found.tail<4>().squaredNorm();
  if (!(square > kMinRippleSquares * chance)) return 0.0;
  return std::sqrt(0.5 * (square - chance));
}

}  // namespace frangia
