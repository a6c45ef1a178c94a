#include "frangia/phase/wrap/merge_exposures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/algorithm/published_algorithms.h"

namespace frangia {
namespace {

/// Least ratio of the smallest to the largest pivot of a normal matrix; below it the phase is
/// undetermined.
constexpr double kMinPivot = 1e-4;

/// One frame of one exposure. Its counts are row . (mean, cosine, sine of the fringe).
struct Shot {
  const Frame* frame;
  Eigen::Vector3d row;
  int white_level;
};

std::vector<Shot> shots_of(std::span<const FrameStack> exposures,
                           const std::vector<double>& shifts_rad) {
  require(!exposures.empty(), "merge_exposures: no frames given");
  std::vector<Shot> shots;
  const Frame& first = exposures.front().frames.front();
  for (const FrameStack& stack : exposures) {
    require(stack.frames.size() == shifts_rad.size(),
            "merge_exposures: the number of frames differs from the number of shifts");
    for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
      const Frame& frame = stack.frames[k];
      require(width_of(frame) == width_of(first) && height_of(frame) == height_of(first),
              "merge_exposures: the frames differ in size");
      const Eigen::Vector3d row(1.0, std::cos(shifts_rad[k]), -std::sin(shifts_rad[k]));
      shots.push_back({&frame, stack.gain() * row, stack.white_level});
    }
  }
  return shots;
}

/// Mean, cosine and sine of one pixel's fringe and their covariance.
struct Fit {
  bool determined = false;
  Eigen::Vector3d fringe = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

class Fitter {
 public:
  Fitter(std::vector<Shot> shots, const NoiseModel& noise)
      : shots_(std::move(shots)), noise_(noise) {}

  /// Solves twice. The first solution weights by the measured counts, whose noise biases it; the
  /// second by the fitted counts.
  [[nodiscard]] Fit fit(int x, int y) const {
    Fit found = solve(x, y, nullptr);
    if (!found.determined) return found;
    const Eigen::Vector3d before = found.fringe;
    return solve(x, y, &before);
  }

 private:
  [[nodiscard]] Fit solve(int x, int y, const Eigen::Vector3d* fringe) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Shot& shot : shots_) {
      const int counts = counts_at(*shot.frame, x, y);
      if (counts >= shot.white_level) continue;
      const double expected = fringe == nullptr ? counts : shot.row.dot(*fringe);
      const double weight = 1.0 / noise_.variance(expected);
      normal += weight * shot.row * shot.row.transpose();
      right += weight * counts * shot.row;
    }
    Fit out;
    const Eigen::LDLT<Eigen::Matrix3d> factors(normal);
    const Eigen::Vector3d pivots = factors.vectorD();
    if (!(pivots.minCoeff() > kMinPivot * pivots.maxCoeff())) return out;
    out.determined = true;
    out.fringe = factors.solve(right);
    out.covariance = factors.solve(Eigen::Matrix3d::Identity());
    return out;
  }

  std::vector<Shot> shots_;
  const NoiseModel& noise_;
};

void write_pixel(const Fit& fit, const WrapOptions& options, int x, int y, WrappedPhase& out) {
  out.mean_counts(x, y) = static_cast<float>(fit.fringe[0]);
  const double cosine = fit.fringe[1];
  const double sine = fit.fringe[2];
  const double square = cosine * cosine + sine * sine;
  out.modulation_counts(x, y) = static_cast<float>(std::sqrt(square));
  if (!fit.determined) {
    out.status(x, y) = PixelStatus::Saturated;
    return;
  }
  if (!(square > 0.0)) return;  // completely dark, for example a background without light
  const Eigen::Vector3d slope(0.0, -sine / square, cosine / square);  // d(phi) / d(fringe)
  const double sigma = std::sqrt(slope.dot(fit.covariance * slope));
  if (!(sigma <= static_cast<double>(options.max_sigma_rad))) return;
  out.status(x, y) = PixelStatus::Measured;
  out.phase_rad(x, y) = static_cast<float>(std::atan2(sine, cosine));
  out.sigma_rad(x, y) = static_cast<float>(sigma);
}

}  // namespace

WrappedPhase merge_exposures(std::span<const FrameStack> exposures,
                             const std::vector<double>& shifts_rad,
                             const NoiseModel& noise,
                             const WrapOptions& options) {
  const Fitter fitter(shots_of(exposures, shifts_rad), noise);
  const int width = width_of(exposures.front().frames.front());
  const int height = height_of(exposures.front().frames.front());
  WrappedPhase out{.pattern = exposures.front().pattern,
                   .phase_rad = Image<float>(width, height, kMissing),
                   .sigma_rad = Image<float>(width, height, kMissing),
                   .modulation_counts = Image<float>(width, height, 0.0F),
                   .mean_counts = Image<float>(width, height, 0.0F),
                   .status = Image<PixelStatus>(width, height, PixelStatus::Unmodulated)};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x)
      write_pixel(fitter.fit(x, y), options, x, y, out);
  });
  return out;
}

namespace {

constexpr int kWhite = std::numeric_limits<std::uint16_t>::max();

}  // namespace

std::size_t recover_saturated(FrameStack& stack) {
  const double step = common_step(stack.pattern.shifts_rad);
  require(stack.frames.size() == 4 && std::abs(std::abs(step) - 0.5 * kPi) < 1e-3,
          "saturated counts can be recovered only from four frames 90 degrees apart");
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  std::vector<Image<std::uint16_t>> wide;
  for (const Frame& frame : stack.frames) {
    wide.emplace_back(width, height, Uninitialized{});
    std::visit(
        [&](const auto& image) {
          std::transform(image.pixels().begin(),
                         image.pixels().end(),
                         wide.back().pixels().begin(),
                         [](auto counts) { return static_cast<std::uint16_t>(counts); });
        },
        frame);
  }
  std::size_t recovered = 0;
  for (std::size_t i = 0; i < wide.front().pixels().size(); ++i) {
    std::array<int, 4> counts{};
    int saturated = 0;
    std::size_t which = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      counts[k] = wide[k].pixels()[i];
      if (counts[k] < stack.white_level) continue;
      ++saturated;
      which = k;
    }
    if (saturated == 0) continue;
    // The two neighbours of the saturated frame minus the frame half a turn away.
    const int found = counts[(which + 1) % 4] + counts[(which + 3) % 4] - counts[(which + 2) % 4];
    const bool one = saturated == 1 && found < kWhite;
    if (one) ++recovered;
    wide[which].pixels()[i] =
        static_cast<std::uint16_t>(one ? std::max(found, stack.white_level) : kWhite);
  }
  for (std::size_t k = 0; k < 4; ++k)
    stack.frames[k] = std::move(wide[k]);
  stack.white_level = kWhite;
  return recovered;
}

}  // namespace frangia
