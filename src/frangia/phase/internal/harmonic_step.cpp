#include "frangia/phase/internal/harmonic_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/QR>

#include "frangia/phase/internal/fit_residuals.h"
#include "frangia/phase/internal/fringe_bins.h"

namespace frangia {
namespace {

constexpr std::size_t kStepSamples = 30'000;  ///< pixels for the harmonics
constexpr double kStepRange = 0.25;           ///< largest relative error of the step
constexpr int kScan = 200;                    ///< steps of the first search
constexpr int kRefinements = 60;              ///< golden sections, down to the rounding error

/// Sum of squares of the frames that a mean and `harmonics` free harmonics of this step leave.
class FreeHarmonics {
 public:
  FreeHarmonics(const Eigen::ArrayXXf& counts, int harmonics)
      : products_(products_of(counts)), harmonics_(harmonics) {}

  [[nodiscard]] double operator()(double step_rad) const {
    const Eigen::Index frames = products_.rows();
    Eigen::MatrixXd model(frames, 1 + 2 * harmonics_);
    for (Eigen::Index k = 0; k < frames; ++k) {
      model(k, 0) = 1.0;
      for (int n = 1; n <= harmonics_; ++n) {
        const double angle = n * step_rad * static_cast<double>(k);
        model(k, 2 * n - 1) = std::cos(angle);
        model(k, 2 * n) = std::sin(angle);
      }
    }
    const Eigen::MatrixXd basis =
        Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(model).householderQ())
            .leftCols(model.cols());
    return std::max(products_.trace() - (basis.transpose() * products_ * basis).trace(), 0.0);
  }

 private:
  static Eigen::MatrixXd products_of(const Eigen::ArrayXXf& counts) {
    const Eigen::MatrixXd all = counts.matrix().cast<double>();
    return all.transpose() * all;
  }
  Eigen::MatrixXd products_;
  int harmonics_;
};

/// The sum of squares that coherent harmonics at the nominal step explain, as a share of all
/// residuals of the sampled pixels.
double explained_by_harmonics(const FrameStack& stack) {
  const NoiseModel unit{.floor_counts2 = 1.0};  // squares in counts
  const FringeBins bins = bin_fringes(stack, stack.pattern.shifts_rad, unit, kStepSamples);
  if (bins.pixels == 0) return 0.0;
  return explained_residual(bins, stack.pattern.shifts_rad) / static_cast<double>(bins.pixels);
}

}  // namespace

HarmonicStep find_harmonic_step(const FrameStack& stack,
                                const Eigen::ArrayXXf& counts,
                                double nominal_rad,
                                double step_rad) {
  HarmonicStep out;
  const auto pixels = static_cast<double>(counts.rows());
  const FreeHarmonics sine(counts, 1);
  const double with_harmonics = sine(nominal_rad) / pixels - explained_by_harmonics(stack);
  out.harmonics = with_harmonics < sine(step_rad) / pixels;
  const auto frames = static_cast<int>(counts.cols());
  if (!out.harmonics || frames < 6) return out;

  const FreeHarmonics free(counts, std::min(4, (frames - 2) / 2));
  const double range = kStepRange * std::abs(nominal_rad);
  double best = nominal_rad;
  double least = free(best);
  for (int i = 0; i <= kScan; ++i) {
    const double trial = nominal_rad + range * (2.0 * i / kScan - 1.0);
    const double cost = free(trial);
    if (cost >= least) continue;
    best = trial;
    least = cost;
  }
  const double spacing = 2.0 * range / kScan;
  double low = best - spacing;
  double high = best + spacing;
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < kRefinements; ++i) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    (free(a) < free(b) ? high : low) = free(a) < free(b) ? b : a;
  }
  out.step_rad = 0.5 * (low + high);
  least = free(out.step_rad);
  const double probe = 0.1 * spacing;
  const double curvature =
      (free(out.step_rad + probe) - 2.0 * least + free(out.step_rad - probe)) / (probe * probe);
  const double freedom = pixels * (frames - 1 - 2 * std::min(4, (frames - 2) / 2));
  out.sigma_rad = std::sqrt(2.0 * least / freedom / curvature);
  const bool inside = std::abs(out.step_rad - nominal_rad) < range - spacing;
  out.found = curvature > 0.0 && inside && std::isfinite(out.sigma_rad);
  return out;
}

}  // namespace frangia
