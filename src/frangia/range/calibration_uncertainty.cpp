#include "frangia/range/calibration_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/symmetric_eigen.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

/// Step of the central differences, in standard deviations: small enough for a linear response,
/// large enough for the tolerance of the triangulation, 1e-9 px.
constexpr double kStep = 0.1;

/// One displacement for each independent change of the parameters.
using Displacements = Eigen::Matrix3Xd;

/// Triangulates points by rigs that differ from the true one by one change of the parameters each.
class ChangedRigs {
 public:
  ChangedRigs(const Rig& rig, const Pattern& pattern) : rig_(rig), pattern_(pattern) {
    const RigCovariance& known = rig.calibration->covariance;
    const Eigen::MatrixXd factor = covariance_factor(known);
    for (Eigen::Index i = 0; i < factor.cols(); ++i) {
      for (const double side : {kStep, -kStep})
        changed_.push_back(change_parameters(rig, known.parameters, side * factor.col(i)));
    }
  }

  [[nodiscard]] Eigen::Index changes() const {
    return static_cast<Eigen::Index>(changed_.size() / 2);
  }

  /// The displacements of a measured point; NaN where a rig does not measure it.
  [[nodiscard]] Displacements displacements_of(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector2d pixel = rig_.camera.model.project(point_mm);
    const double phase_rad = phase_at(point_mm, pattern_, rig_.projector);
    const auto seen_by = [&](const Rig& rig) -> Eigen::Vector3d {
      const Eigen::Vector2d ray = rig.camera.model.ray(pixel);
      return intersect_fringe(ray, phase_rad, pattern_, rig.projector).depth_mm * ray.homogeneous();
    };
    Displacements moved(3, changes());
    for (Eigen::Index i = 0; i < changes(); ++i) {
      const auto pair = static_cast<std::size_t>(2 * i);
      moved.col(i) = (seen_by(changed_[pair]) - seen_by(changed_[pair + 1])) / (2.0 * kStep);
    }
    return moved;
  }

 private:
  const Rig& rig_;
  const Pattern& pattern_;
  std::vector<Rig> changed_;  ///< in pairs: by +kStep and by -kStep
};

/// A rigid motion for each change of the parameters, small enough to be linear: a translation and a
/// rotation vector about `center`, per `size_mm`.
struct RigidMotions {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double size_mm = 1.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;

  [[nodiscard]] Eigen::Matrix<double, 3, 6> design(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = (point - center) / size_mm;
    Eigen::Matrix<double, 3, 6> rows;
    rows.leftCols<3>().setIdentity();
    rows.rightCols<3>() << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    return rows;
  }
};

/// Fits a rigid motion to the displacements of points by least squares, for each change.
RigidMotions fit_rigid(std::span<const Eigen::Vector3d> points, const ChangedRigs& rigs) {
  RigidMotions fit;
  for (const Eigen::Vector3d& point : points)
    fit.center += point / static_cast<double>(points.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& point : points)
    squares += (point - fit.center).squaredNorm();
  if (squares > 0.0) fit.size_mm = std::sqrt(squares / static_cast<double>(points.size()));
  std::vector<Displacements> moved(points.size());
  parallel_chunks(points.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      moved[i] = rigs.displacements_of(points[i]);
  });
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, Eigen::Dynamic> right(6, rigs.changes());
  right.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!moved[i].allFinite()) continue;
    const auto rows = fit.design(points[i]);
    normal += rows.transpose() * rows;
    right += rows.transpose() * moved[i];
  }
  fit.motions = normal.completeOrthogonalDecomposition().solve(right);
  return fit;
}

/// Replaces missing nodes, which a changed rig does not measure, by the nearest known one.
void fill_missing(Eigen::MatrixXd& nodes, const std::array<int, 3>& counts) {
  const auto place_of = [&](Eigen::Index i) {
    const auto at = static_cast<int>(i);
    return Eigen::Array3i(at % counts[0], at / counts[0] % counts[1], at / (counts[0] * counts[1]));
  };
  const Eigen::MatrixXd known = nodes;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    if (known.col(i).allFinite()) continue;
    nodes.col(i).setZero();
    int nearest = std::numeric_limits<int>::max();
    for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
      const int apart = (place_of(j) - place_of(i)).square().sum();
      if (apart >= nearest || !known.col(j).allFinite()) continue;
      nearest = apart;
      nodes.col(i) = known.col(j);
    }
  }
}

/// Replaces the rows of a matrix by the fewest rows whose sums of squares of each column agree with
/// the original ones to within 1e-4 of their mean.
Eigen::MatrixXf principal_components(const Eigen::MatrixXd& rows) {
  constexpr double kLost = 1e-4;
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(rows * rows.transpose()));
  const double most = kLost * eigen.values.sum();
  Eigen::Index first = 0;
  for (double lost = 0.0; first < eigen.values.size(); ++first) {
    lost += std::max(0.0, eigen.values[first]);
    if (lost > most) break;
  }
  const Eigen::Index kept = eigen.values.size() - first;
  return (eigen.vectors.rightCols(kept).transpose() * rows).cast<float>();
}

}  // namespace

CalibrationUncertainty::CalibrationUncertainty(const Rig& rig,
                                               const Pattern& pattern,
                                               std::span<const Eigen::Vector3d> volume_mm) {
  if (!rig.calibration || rig.calibration->covariance.empty() || volume_mm.empty()) return;
  const ChangedRigs rigs(rig, pattern);
  if (rigs.changes() == 0) return;
  const RigidMotions rigid = fit_rigid(volume_mm, rigs);
  low_.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low_;
  for (const Eigen::Vector3d& point : volume_mm) {
    const Eigen::Vector2d pixel = rig.camera.model.project(point);
    const Eigen::Array3d at(pixel.x(), pixel.y(), point.z());
    low_ = low_.min(at);
    high = high.max(at);
  }
  constexpr double kLeastStep = 1e-9;  // px or mm; keeps the step of a flat volume above zero
  step_ = ((high - low_) / (node_counts() - 1.0)).max(kLeastStep);
  constexpr int kCount = kNodes[0] * kNodes[1] * kNodes[2];
  Eigen::MatrixXd nodes(rigs.changes(), kCount);
  parallel_chunks(kCount, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<int>(i);
      const Eigen::Array3d at = low_ + step_ * Eigen::Array3d(index % kNodes[0],
                                                              index / kNodes[0] % kNodes[1],
                                                              index / (kNodes[0] * kNodes[1]));
      const Eigen::Vector3d ray = rig.camera.model.ray({at.x(), at.y()}).homogeneous();
      const Eigen::Vector3d point = at.z() * ray;
      const Displacements rest = rigs.displacements_of(point) - rigid.design(point) * rigid.motions;
      nodes.col(index) = rest.transpose() * ray.normalized();
    }
  });
  fill_missing(nodes, kNodes);
  along_ray_mm_ = principal_components(nodes);
}

Eigen::Array3d CalibrationUncertainty::place_of(double x_px, double y_px, double depth_mm) const {
  return ((Eigen::Array3d(x_px, y_px, depth_mm) - low_) / step_).max(0.0).min(node_counts() - 1.0);
}

double CalibrationUncertainty::along_ray_mm(double x_px, double y_px, double depth_mm) const {
  if (along_ray_mm_.size() == 0) return 0.0;
  const Eigen::Array3d place = place_of(x_px, y_px, depth_mm);
  const Eigen::Array3d first = place.floor().min(node_counts() - 2.0);
  const Eigen::Array3d along = place - first;
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(along_ray_mm_.rows());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d upper(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Eigen::Array3i at = (first + upper).cast<int>();
    const double share = (upper * along + (1.0 - upper) * (1.0 - along)).prod();
    sum += static_cast<float>(share) * along_ray_mm_.col(node(at.x(), at.y(), at.z()));
  }
  return static_cast<double>(sum.norm());
}

void CalibrationUncertainty::add_to(RangeGrid& range) const {
  if (along_ray_mm_.size() == 0) return;
  const int width = range.depth_mm.width();
  range.differing_share = 0.0F;  // the rig is that of all views
  if (range.systematic_mm.empty()) {
    range.systematic_mm = Image<float>(width, range.depth_mm.height(), Uninitialized{});
    parallel_rows(range.depth_mm.height(), [&](int y) {
      for (int x = 0; x < width; ++x)
        range.systematic_mm(x, y) = std::isnan(range.depth_mm(x, y)) ? kMissing : 0.0F;
    });
  }
  const Eigen::Index components = along_ray_mm_.rows();
  parallel_rows(range.depth_mm.height(), [&](int y) {
    const double row = place_of(0.0, y, 0.0).y();
    const int upper = std::min(static_cast<int>(row), kNodes[1] - 2);
    const auto down = static_cast<float>(row - upper);
    // The nodes interpolated at this row, with those along depth side by side.
    Eigen::MatrixXf nodes(components, kNodes[0] * kNodes[2]);
    for (int z = 0; z < kNodes[2]; ++z) {
      for (int x = 0; x < kNodes[0]; ++x) {
        nodes.col(x * kNodes[2] + z) = (1.0F - down) * along_ray_mm_.col(node(x, upper, z)) +
                                       down * along_ray_mm_.col(node(x, upper + 1, z));
      }
    }
    for (int x = 0; x < width; ++x) {
      const float depth = range.depth_mm(x, y);
      if (std::isnan(depth)) continue;
      const Eigen::Array3d place = place_of(x, y, static_cast<double>(depth));
      const int left = std::min(static_cast<int>(place.x()), kNodes[0] - 2);
      const int near = std::min(static_cast<int>(place.z()), kNodes[2] - 2);
      const auto right = static_cast<float>(place.x() - left);
      const auto far = static_cast<float>(place.z() - near);
      const float* front = &nodes(0, left * kNodes[2] + near);
      const float* back = front + kNodes[2] * components;
      float squares = 0.0F;
      for (Eigen::Index i = 0; i < components; ++i) {
        const float here = front[i] + far * (front[i + components] - front[i]);
        const float next = back[i] + far * (back[i + components] - back[i]);
        const float moved = here + right * (next - here);
        squares += moved * moved;
      }
      float& systematic = range.systematic_mm(x, y);
      systematic = combined_sigma(systematic, std::sqrt(squares));
    }
  });
}

}  // namespace frangia
