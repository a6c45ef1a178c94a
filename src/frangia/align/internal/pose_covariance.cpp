#include "frangia/align/internal/pose_covariance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/core/symmetric_eigen.h"
#include "frangia/geometry/robust_gauss_newton.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Twist = Eigen::Matrix<double, 6, 1>;
using TwistMatrix = Eigen::Matrix<double, 6, 6>;

/// A residual of the fit.
struct PoseResidual {
  Vector3d point_mm;
  Twist row = Twist::Zero();
  double value = 0.0;
  double weight = 0.0;  ///< 0: the sample does not count
};

/// Orders residuals so that blocks of equal counts are compact, by medians along the widest side.
void order_blocks(std::span<PoseResidual> residuals, int levels) {
  if (levels == 0 || residuals.size() < 2) return;
  Eigen::AlignedBox3d box;
  for (const PoseResidual& one : residuals)
    box.extend(one.point_mm);
  Eigen::Index side = 0;
  box.sizes().maxCoeff(&side);
  const std::size_t middle = residuals.size() / 2;
  std::sort(residuals.begin(), residuals.end(), [&](const auto& a, const auto& b) {
    return a.point_mm[side] < b.point_mm[side];
  });
  order_blocks(residuals.first(middle), levels - 1);
  order_blocks(residuals.subspan(middle), levels - 1);
}

}  // namespace

PoseUncertainty pose_covariance(std::span<const MeasuredSample> samples,
                                const FindFoot& find_foot,
                                const PoseFit& fit) {
  std::vector<PoseResidual> residuals(samples.size());
  parallel_chunks(samples.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      PoseResidual& one = residuals[i];
      one.point_mm = fit.pose * samples[i].point_mm;
      const auto foot = find_foot(one.point_mm, 1.5 * fit.gate_mm);
      if (!foot || (fit.pose.linear() * samples[i].normal).dot(foot->normal) < 0.5) continue;
      one.value = foot->normal.dot(one.point_mm - foot->point_mm);
      if (std::abs(one.value) >= fit.gate_mm) continue;
      one.weight = tukey_weight(one.value, fit.gate_mm);
      one.row << (one.point_mm - fit.center).cross(foot->normal) / fit.lever_mm, foot->normal;
    }
  });
  std::erase_if(residuals, [](const PoseResidual& one) { return !(one.weight > 0.0); });
  PoseUncertainty uncertainty;
  uncertainty.center_mm = fit.center;
  constexpr int kLevels = 6;
  constexpr std::size_t kBlocks = std::size_t{1} << static_cast<unsigned>(kLevels);
  if (residuals.size() < 4 * kBlocks) return uncertainty;
  order_blocks(residuals, kLevels);
  TwistMatrix hessian = TwistMatrix::Zero();
  TwistMatrix spread = TwistMatrix::Zero();
  double weight = 0.0;
  double slope = 0.0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Twist gradient = Twist::Zero();
    const std::size_t end = (block + 1) * residuals.size() / kBlocks;
    for (std::size_t i = block * residuals.size() / kBlocks; i < end; ++i) {
      const PoseResidual& one = residuals[i];
      weight += one.weight;
      slope += tukey_slope(one.value, fit.gate_mm);
      hessian += one.weight * one.row * one.row.transpose();
      gradient += one.weight * one.value * one.row;
    }
    spread += gradient * gradient.transpose();
  }
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(hessian));
  constexpr double kHeld = 1e-4;  // of the best determined direction
  Twist inverse = Twist::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    if (eigen.values[i] > kHeld * eigen.values[5]) inverse[i] = 1.0 / eigen.values[i];
  const TwistMatrix pseudo = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
  constexpr double kFree = static_cast<double>(kBlocks) / static_cast<double>(kBlocks - 6);
  // The robust weights understate it, see `tukey_slope`.
  constexpr double kMostRobust = 2.0;
  const double robust = slope > 0.0 ? std::clamp(weight / slope, 1.0, kMostRobust) : kMostRobust;
  Twist scale = Twist::Ones();  // the rotations of the fit are times the lever
  scale.head<3>() /= fit.lever_mm;
  uncertainty.covariance = scale.asDiagonal() *
                           (kFree * robust * robust * pseudo * spread * pseudo) *
                           scale.asDiagonal();
  return uncertainty;
}

}  // namespace frangia
