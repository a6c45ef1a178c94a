#include "frangia/phase/algorithm/estimate_shifts.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/phase/waveform/frame_samples.h"

namespace frangia {
namespace {

/// Sampled pixels. At 1 % noise the standard error of a shift is then about 1e-4 rad.
constexpr std::size_t kShiftSamples = 20'000;
constexpr Eigen::Index kMinShiftSamples = 100;  ///< fewer pixels do not determine the shifts
constexpr int kIterations = 100;              ///< safety limit; the iteration stops on convergence
constexpr double kConvergedShift_rad = 1e-9;  ///< largest change of a shift, far below its noise

/// Largest ratio of residual to noise variance; the noise model is no more accurate than that.
constexpr double kMaxExcess = 1.5;

/// The least-squares fit of the fringe model to the frames, given their shifts. With n frames it
/// takes n^2 operations.
struct FringeFit {
  Eigen::MatrixXd model;     ///< one row a frame: 1, cos(shift), -sin(shift)
  Eigen::MatrixXd inverse;   ///< its pseudoinverse
  Eigen::MatrixXd fringes;   ///< mean, cosine and sine: `inverse * root`
  Eigen::MatrixXd residual;  ///< `root - model * fringes`

  /// `root * root^T` are the inner products of the frames over all pixels, so that an iteration
  /// does not depend on the number of pixels.
  FringeFit(const Eigen::MatrixXd& root, const std::vector<double>& shifts)
      : model(std::ssize(shifts), 3) {
    for (Eigen::Index k = 0; k < model.rows(); ++k)
      model.row(k) = fringe_model_row(shifts[static_cast<std::size_t>(k)]);
    const Eigen::Matrix3d normal = transposed_product(model, model);
    inverse = product_transposed(normal.inverse(), model);
    fringes = product(inverse, root);
    residual = root - product(model, fringes);
  }
  [[nodiscard]] double cost() const { return residual.squaredNorm(); }
};

/// Normal equations of the residuals in all shifts.
struct ShiftEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
};

/// The derivatives of the residuals by the shifts, multiplied out: each derivative is the sum of
/// two matrices of rank one that are perpendicular to each other, so that no matrix of all
/// derivatives is needed.
///
/// @source   variable projection: Golub and Pereyra 1973
ShiftEquations equations_of(const FringeFit& fit, const Eigen::MatrixXd& products) {
  const Eigen::Index frames = fit.model.rows();
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(frames, 3);  // of the model's rows, by the shift
  slope.col(1) = fit.model.col(2);
  slope.col(2) = -fit.model.col(1);
  // P = I - model * inverse projects on the residuals.
  Eigen::MatrixXd projection = -product(fit.model, fit.inverse);
  projection.diagonal().array() += 1.0;
  Eigen::MatrixXd residual_products = products;
  residual_products -= product(fit.model, product(fit.inverse, products));
  residual_products -=
      product_transposed(product_transposed(residual_products, fit.inverse), fit.model);
  const Eigen::MatrixXd by_fringes = product(slope, fit.fringes);
  const Eigen::MatrixXd by_shifts = product(slope, fit.inverse);
  const Eigen::MatrixXd fringe_term = product_transposed(by_fringes, by_fringes);
  const Eigen::MatrixXd shift_term = product_transposed(by_shifts, by_shifts);
  const Eigen::MatrixXd by_fringe = product_transposed(fit.residual, fit.fringes);
  return {fringe_term.cwiseProduct(projection) + shift_term.cwiseProduct(residual_products),
          -by_fringe.cwiseProduct(slope).rowwise().sum()};
}

/// One Levenberg-Marquardt step in all shifts but the first. The published alternation between
/// phases and shifts converges too slowly.
std::vector<double> levenberg_marquardt_step(const Eigen::MatrixXd& root,
                                             const Eigen::MatrixXd& products,
                                             const std::vector<double>& shifts,
                                             double& damping) {
  const FringeFit fit(root, shifts);
  const ShiftEquations equations = equations_of(fit, products);
  const Eigen::Index free = std::ssize(shifts) - 1;
  Eigen::MatrixXd normal = equations.normal.bottomRightCorner(free, free);
  normal.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd change = solve_symmetric(normal, equations.gradient.tail(free));
  std::vector<double> trial = shifts;
  for (std::size_t k = 1; k < shifts.size(); ++k)
    trial[k] -= change(static_cast<Eigen::Index>(k) - 1);
  const bool better = FringeFit(root, trial).cost() <= fit.cost();
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
  static_cast<void>(fringe_normal_matrix(nominal));  // fails where they determine no phase
  ShiftEstimate out{.shifts_rad = nominal};
  const Eigen::ArrayXXd counts = sample_frames(stack, kShiftSamples).cast<double>();
  if (counts.rows() < kMinShiftSamples) return out;
  const Eigen::MatrixXd products = transposed_product(counts.matrix(), counts.matrix());
  const Eigen::MatrixXd root = Cholesky(products).lower();
  std::vector<double> shifts = nominal;
  double damping = 1e-3;
  bool converged = false;
  for (int i = 0; i < kIterations && !converged; ++i) {
    const std::vector<double> better = levenberg_marquardt_step(root, products, shifts, damping);
    const double change = largest_change(better, shifts);
    converged = change < kConvergedShift_rad && (change > 0.0 || damping > 1e6);
    shifts = better;
  }
  align_to_nominal(nominal, shifts);
  const double residual = FringeFit(root, shifts).cost();
  const auto n = static_cast<double>(counts.rows());
  out.residual_counts2 = residual / (n * static_cast<double>(counts.cols() - 3));
  out.expected_counts2 = noise.variance(counts.mean());
  out.found = converged && out.residual_counts2 < kMaxExcess * out.expected_counts2;
  if (out.found) out.shifts_rad = shifts;
  return out;
}

}  // namespace frangia
