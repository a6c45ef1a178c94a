#include "frangia/registration/internal/free_pose_bundle.h"

#include <array>
#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

FreePoseSums empty_sums(std::size_t views) {
  const auto unknowns = static_cast<Eigen::Index>(6 * (views - 1));
  return {Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns), {}, 0, 0};
}

/// Adds an equation in the poses of two views; that of view 0 is held.
void add_equation(FreePoseSums& sums,
                  const std::array<std::size_t, 2>& views,
                  const Eigen::Matrix<double, 12, 1>& row,
                  double weight,
                  double distance) {
  for (std::size_t a = 0; a < 2; ++a) {
    if (views.at(a) == 0) continue;
    const auto at = static_cast<Eigen::Index>(6 * (views.at(a) - 1));
    const auto part = row.segment<6>(static_cast<Eigen::Index>(6 * a));
    sums.gradient.segment<6>(at) += weight * distance * part;
    for (std::size_t b = 0; b < 2; ++b) {
      if (views.at(b) == 0) continue;
      const auto to = static_cast<Eigen::Index>(6 * (views.at(b) - 1));
      sums.hessian.block<6, 6>(at, to) +=
          weight * part * row.segment<6>(static_cast<Eigen::Index>(6 * b)).transpose();
    }
  }
}

/// A view's surfels against all other views.
class FreePoseComparison {
 public:
  FreePoseComparison(const FreePoseBundle& bundle, std::size_t from, double gate_mm)
      : bundle_(bundle),
        from_(from),
        gate_mm_(gate_mm),
        world_from_(bundle.rig_from_world[from].inverse()) {}

  /// Adds the pair of a surfel and view `to`, if the surfel lies on a surface that `to` measured.
  bool add_pair(FreePoseSums& sums, const SurfelMap::Surfel& surfel, std::size_t to) const {
    const Eigen::Isometry3d& rig_from_world = bundle_.rig_from_world[to];
    const Eigen::Vector3d point = world_from_ * surfel.point_mm.cast<double>();
    const Eigen::Vector3d seen = rig_from_world * point;
    const SurfelMap::Surfel* target = surfel_at(bundle_.maps[to], bundle_.model, seen);
    if (target == nullptr) return false;
    const Eigen::Vector3d facing =
        rig_from_world.linear() * (world_from_.linear() * surfel.normal.cast<double>());
    const SurfelPair pair(seen, facing, *target);
    const double distance = pair.distance_mm();
    if (!pair.faces_alike() || !(std::abs(distance) < gate_mm_)) return false;
    const double weight =
        tukey_weight(distance, gate_mm_) / (std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                                            std::pow(static_cast<double>(target->sigma_mm), 2));
    const Eigen::Vector3d normal = rig_from_world.linear().transpose() * pair.normal;
    const Eigen::Vector3d foot = rig_from_world.inverse() * target->point_mm.cast<double>();
    Eigen::Matrix<double, 12, 1> row;
    row << point_to_plane_jacobian(normal, point), -point_to_plane_jacobian(normal, foot);
    add_equation(sums, {from_, to}, row, weight, distance);
    sums.distances_mm.push_back(std::abs(distance));
    return true;
  }

 private:
  const FreePoseBundle& bundle_;
  std::size_t from_;
  double gate_mm_;
  Eigen::Isometry3d world_from_;
};

}  // namespace

Eigen::Matrix<double, 6, 1> point_to_plane_jacobian(const Eigen::Vector3d& normal,
                                                    const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 6, 1> row;
  row << normal, point.cross(normal);
  return row;
}

FreePoseSums sum_free_poses(const FreePoseBundle& bundle, double gate_mm) {
  const std::size_t views = bundle.maps.size();
  std::vector<FreePoseSums> parts(views);
  parallel_chunks(views, 1, [&](std::size_t from, std::size_t /*end*/) {
    FreePoseSums& part = parts[from] = empty_sums(views);
    const FreePoseComparison comparison(bundle, from, gate_mm);
    for (const SurfelMap::Surfel& surfel : bundle.surfels[from]) {
      bool matched = false;
      for (std::size_t to = 0; to < views; ++to)
        matched = (to != from && comparison.add_pair(part, surfel, to)) || matched;
      part.matched += matched ? 1U : 0U;
      ++part.surfels;
    }
  });
  FreePoseSums all = empty_sums(views);
  for (const FreePoseSums& part : parts) {
    all.hessian += part.hessian;
    all.gradient += part.gradient;
    all.distances_mm.insert(
        all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
    all.matched += part.matched;
    all.surfels += part.surfels;
  }
  return all;
}

void apply_update(FreePoseBundle& bundle, const Eigen::VectorXd& step) {
  for (std::size_t view = 1; view < bundle.rig_from_world.size(); ++view) {
    const auto part = step.segment<6>(static_cast<Eigen::Index>(6 * (view - 1)));
    const Eigen::Vector3d turn = part.tail<3>();
    Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
      by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    by.translation() = part.head<3>();
    bundle.rig_from_world[view] = bundle.rig_from_world[view] * by.inverse();
  }
}

}  // namespace frangia
