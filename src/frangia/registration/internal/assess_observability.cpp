#include "frangia/registration/internal/assess_observability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

/// Information gain below which a direction counts as undetermined: the views improve on the
/// prior's standard deviation by less than a factor of three.
constexpr double kWellDetermined = 9.0;

/// The unknowns but for the angles of views that measure nothing, as those that are left out.
struct MeasuredUnknowns {
  std::vector<Eigen::Index> all;
  Eigen::Index angles = 0;  ///< how many of them follow the four of the axis
};

MeasuredUnknowns measured_unknowns(const SurfelLists& surfels, Eigen::Index unknowns) {
  MeasuredUnknowns measured{.all = {0, 1, 2, 3}};
  for (std::size_t view = 1; view < surfels.size(); ++view) {
    if (surfels[view].empty()) continue;
    measured.all.push_back(static_cast<Eigen::Index>(view) + 3);
    ++measured.angles;
  }
  for (auto i = static_cast<Eigen::Index>(surfels.size()) + 3; i < unknowns; ++i)
    measured.all.push_back(i);
  return measured;
}

/// Information of the pairs on some unknowns in units of the prior's: 1 is as much.
SymmetricEigen<Eigen::Dynamic> information_gain(const Bundle& bundle,
                                                const BundleSums& sums,
                                                const std::vector<Eigen::Index>& unknowns) {
  const Eigen::MatrixXd gain =
      effective_weight(bundle, sums) * scaled(sums.hessian, bundle.prior_sigma);
  const Eigen::MatrixXd of_these = gain(unknowns, unknowns);
  return symmetric_eigen(of_these);
}

/// Standard deviation of the axis in its weakest direction, at a distance of `arm_mm`.
double weakest_axis_sigma_mm(const SymmetricEigen<Eigen::Dynamic>& gain,
                             const Eigen::VectorXd& prior_sigma,
                             double arm_mm) {
  const Eigen::Vector4d to_mm(arm_mm, arm_mm, 1.0, 1.0);
  const Eigen::Vector4d scales = to_mm.cwiseProduct(prior_sigma.head<4>());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(4, 4);
  for (Eigen::Index i = 0; i < gain.values.size(); ++i) {
    const Eigen::Vector4d direction = scales.cwiseProduct(gain.vectors.col(i).head<4>());
    covariance += direction * direction.transpose() / (1.0 + std::max(0.0, gain.values[i]));
  }
  return std::sqrt(symmetric_eigen(covariance).values[3]);
}

}  // namespace

void assess_observability(RegistrationReport& report,
                          const Bundle& bundle,
                          const BundleSums& sums,
                          const SurfelLists& surfels,
                          double part_radius_mm) {
  const MeasuredUnknowns measured = measured_unknowns(surfels, bundle.prior_sigma.size());
  const auto gain = information_gain(bundle, sums, measured.all);
  report.weakest = std::sqrt(1.0 + std::max(0.0, gain.values[0]));
  report.condition =
      std::sqrt((1.0 + gain.values.tail<1>()[0]) / (1.0 + std::max(0.0, gain.values[0])));
  report.axis_sigma_mm = weakest_axis_sigma_mm(gain, bundle.prior_sigma, part_radius_mm);
  report.axis_sigma_rad = report.axis_sigma_mm / std::max(1e-9, part_radius_mm);
  std::array<double, 3> undetermined{};  // squared components in tilt, shift, angles
  for (Eigen::Index i = 0; i < gain.values.size() && gain.values[i] < kWellDetermined; ++i) {
    const Eigen::VectorXd direction = gain.vectors.col(i).cwiseAbs2();
    undetermined[0] += direction.head<2>().sum();
    undetermined[1] += direction.segment<2>(2).sum();
    undetermined[2] += direction.segment(4, measured.angles).sum();
  }
  // More than half of a unit vector: the weak direction belongs mainly to these unknowns.
  if (undetermined[0] > 0.5) report.undetermined.emplace_back(kTiltOfAxis);
  if (undetermined[1] > 0.5) report.undetermined.emplace_back(kPositionOfAxis);
  if (undetermined[2] > 0.5) report.undetermined.emplace_back(kAnglesOfViews);
}

}  // namespace frangia
