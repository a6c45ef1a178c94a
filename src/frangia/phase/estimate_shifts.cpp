#include "frangia/phase/estimate_shifts.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/solve_symmetric.h"
#include "frangia/phase/frame_samples.h"
#include "frangia/phase/phase_algorithm.h"

namespace frangia {
namespace {

/// Sampled pixels. At 1 % noise the standard error of a shift is then about 1e-4 rad.
constexpr std::size_t kSamples = 20'000;
constexpr Eigen::Index kMinSamples = 100;  ///< fewer pixels do not determine the shifts
constexpr int kIterations = 100;           ///< safety limit; the iteration stops on convergence
constexpr double kConverged_rad = 1e-9;    ///< largest change of a shift, far below its noise

/// Largest ratio of residual to noise variance; the noise model is no more accurate than that.
constexpr double kMaxExcess = 1.5;

/// Residuals of the fringe model with these shifts. `root * root^T` are the inner products of the
/// frames over all pixels, so an iteration does not depend on the number of pixels.
Eigen::VectorXd residuals_of(const Eigen::MatrixXd& root, const std::vector<double>& shifts) {
  const PhaseAlgorithm fit = least_squares(shifts);
  const auto frames = static_cast<Eigen::Index>(shifts.size());
  const auto column = [&](const std::vector<double>& weights) {
    return Eigen::Map<const Eigen::VectorXd>(weights.data(), frames);
  };
  Eigen::MatrixXd residual = root;
  for (Eigen::Index k = 0; k < frames; ++k) {
    const double shift = shifts[static_cast<std::size_t>(k)];
    const Eigen::VectorXd weights = column(fit.mean) + std::cos(shift) * column(fit.cosine) -
                                    std::sin(shift) * column(fit.sine);
    residual.row(k) -= weights.transpose() * root;
  }
  return residual.reshaped();
}

/// One Levenberg-Marquardt step in all shifts but the first. The published alternation between
/// phases and shifts converges too slowly.
std::vector<double> levenberg_marquardt_step(const Eigen::MatrixXd& root,
                                             const std::vector<double>& shifts,
                                             double& damping) {
  constexpr double kProbe_rad = 1e-6;  // step of the numerical derivative
  const Eigen::VectorXd residual = residuals_of(root, shifts);
  Eigen::MatrixXd slopes(residual.size(), std::ssize(shifts) - 1);
  for (std::size_t k = 1; k < shifts.size(); ++k) {
    std::vector<double> probe = shifts;
    probe[k] += kProbe_rad;
    slopes.col(static_cast<Eigen::Index>(k) - 1) =
        (residuals_of(root, probe) - residual) / kProbe_rad;
  }
  Eigen::MatrixXd normal = slopes.transpose() * slopes;
  normal.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd change = solve_symmetric(normal, slopes.transpose() * residual);
  std::vector<double> trial = shifts;
  for (std::size_t k = 1; k < shifts.size(); ++k)
    trial[k] -= change(static_cast<Eigen::Index>(k) - 1);
  const bool better = residuals_of(root, trial).squaredNorm() <= residual.squaredNorm();
  damping *= better ? 0.2 : 10.0;
  return better ? trial : shifts;
}

/// Chooses the common offset of the shifts such that the scaled nominal shifts fit best.
void align_to_nominal(const std::vector<double>& nominal, std::vector<double>& shifts) {
  const auto n = static_cast<double>(nominal.size());
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t k = 0; k < nominal.size(); ++k) {
    shifts[k] = nominal[k] + wrap_rad(shifts[k] - shifts[0] - (nominal[k] - nominal[0]));
    x += nominal[k] / n;
    y += shifts[k] / n;
    xx += nominal[k] * nominal[k];
    xy += nominal[k] * shifts[k];
  }
  const double scale = (xy - n * x * y) / (xx - n * x * x);
  for (double& shift : shifts)
    shift -= y - scale * x;
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  double change = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    change = std::max(change, std::abs(a[k] - b[k]));
  return change;
}

}  // namespace

ShiftEstimate estimate_shifts(const FrameStack& stack, const NoiseModel& noise) {
  require(
      stack.frames.size() >= 6 && stack.frames.size() == stack.pattern.shifts_rad.size(),
      "the algorithm \"aia\" needs at least six frames to estimate the shifts; take more frames");
  const std::vector<double>& nominal = stack.pattern.shifts_rad;
  ShiftEstimate out{.shifts_rad = nominal};
  const Eigen::ArrayXXd counts = sample_frames(stack, kSamples).cast<double>();
  if (counts.rows() < kMinSamples) return out;
  const Eigen::MatrixXd root = (counts.matrix().transpose() * counts.matrix()).llt().matrixL();
  std::vector<double> shifts = nominal;
  double damping = 1e-3;
  bool converged = false;
  for (int i = 0; i < kIterations && !converged; ++i) {
    const std::vector<double> better = levenberg_marquardt_step(root, shifts, damping);
    const double change = largest_change(better, shifts);
    converged = change < kConverged_rad && (change > 0.0 || damping > 1e6);
    shifts = better;
  }
  align_to_nominal(nominal, shifts);
  const double residual = residuals_of(root, shifts).squaredNorm();
  const auto n = static_cast<double>(counts.rows());
  out.residual_counts2 = residual / (n * static_cast<double>(counts.cols() - 3));
  out.expected_counts2 = noise.variance(counts.mean());
  out.found = converged && out.residual_counts2 < kMaxExcess * out.expected_counts2;
  if (out.found) out.shifts_rad = shifts;
  return out;
}

}  // namespace frangia
