#include "frangia/calibrate/solve/internal/rig_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "frangia/calibrate/internal/invert_normal.h"

namespace frangia {
namespace {

/// Standard deviations of terms that are held at their nominal values: ordinary lenses and square
/// pixels. Zero: the parameter is always estimated.
constexpr std::array kHeldSigma = {0.0, 2e-3, 0.0, 0.0, 0.0, 0.1, 1e-3, 1e-3, 0.1};

/// Adds what is known beforehand of the terms of a device that are held.
void add_priors(const RigFreedom& freedom, std::size_t first, Eigen::MatrixXd& normal) {
  for (std::size_t i = 0; i < kHeldSigma.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(first + i);
    if (!freedom.free.at(first + i))
      normal(row, row) += 1.0 / (kHeldSigma.at(i) * kHeldSigma.at(i));
  }
}

}  // namespace

SolvedCovariance covariance_of(std::span<const RigObservation> observations,
                               const RigFreedom& freedom,
                               const RigNoise& noise,
                               const RigParameters& parameters,
                               const std::vector<std::string>& names) {
  constexpr double kOpen = 1e-12;
  const RigLayout& layout = freedom.layout;
  RigFreedom all = freedom;  // a held term is uncertain, too, and correlated with the others
  std::fill_n(all.free.begin(), layout.board(), true);
  const RigLinearization full = linearize_rig(observations, layout, noise, parameters);
  const Eigen::MatrixXd jacobian =
      full.jacobian(Eigen::all, free_columns(all, full.jacobian.cols()));
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  add_priors(freedom, 0, normal);
  if (layout.has_projector) add_priors(freedom, layout.projector(), normal);
  for (std::size_t i = 1; i < layout.cameras; ++i)
    add_priors(freedom, layout.camera(i), normal);
  const NormalInverse inverse = invert_normal(normal, kOpen);
  const auto kept = static_cast<Eigen::Index>(names.size());
  SolvedCovariance out{inverse.covariance.topLeftCorner(kept, kept), {}};
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  for (Eigen::Index i = 0; i < kept; ++i) {
    if (inverse.open[i] < kMuch) continue;
    out.undetermined.push_back(names[static_cast<std::size_t>(i)]);
    out.covariance(i, i) = std::numeric_limits<double>::infinity();
  }
  return out;
}

}  // namespace frangia
