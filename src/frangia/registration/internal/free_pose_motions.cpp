#include "frangia/registration/internal/free_pose_motions.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

/// Where the points of a view are, in the world.
struct Place {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double arm_mm = 1.0;  ///< root mean square distance from the centre
};

Place place_of(const std::vector<SurfelMap::Surfel>& surfels, const Eigen::Isometry3d& world_from) {
  Place place;
  if (surfels.empty()) return place;
  for (const SurfelMap::Surfel& surfel : surfels)
    place.center_mm += world_from * surfel.point_mm.cast<double>();
  const auto count = static_cast<double>(surfels.size());
  place.center_mm /= count;
  double squares = 0.0;
  for (const SurfelMap::Surfel& surfel : surfels)
    squares += (world_from * surfel.point_mm.cast<double>() - place.center_mm).squaredNorm();
  if (squares > 0.0) place.arm_mm = std::sqrt(squares / count);
  return place;
}

/// Shift and rotation about the origin by a shift of the centre and a rotation about it, as the way
/// (mm) at the arm.
Eigen::Matrix<double, 6, 6> about_center(const Place& place) {
  Eigen::Matrix3d cross;
  const Eigen::Vector3d& c = place.center_mm;
  cross << 0.0, -c.z(), c.y(), c.z(), 0.0, -c.x(), -c.y(), c.x(), 0.0;
  Eigen::Matrix<double, 6, 6> to = Eigen::Matrix<double, 6, 6>::Zero();
  to.topLeftCorner<3, 3>().setIdentity();
  to.topRightCorner<3, 3>() = cross / place.arm_mm;
  to.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() / place.arm_mm;
  return to;
}

/// Takes from the information what noise of normals pretends of motions that leave the surface of a
/// view where it is.
void remove_open(Eigen::MatrixXd& information) {
  const Eigen::MatrixXd all = information;
  for (Eigen::Index at = 0; at < all.rows(); at += 6) {
    const Eigen::Matrix<double, 6, 6> own = all.block<6, 6>(at, at);
    const double weight = own.topLeftCorner<3, 3>().trace();  // normals are unit
    if (!(weight > 0.0)) continue;
    const auto eigen = symmetric_eigen(Eigen::MatrixXd(own / weight));
    for (Eigen::Index i = 0; i < 6 && eigen.values[i] < kOpenMotion * kOpenMotion; ++i) {
      Eigen::VectorXd open = Eigen::VectorXd::Zero(all.rows());
      open.segment<6>(at) = eigen.vectors.col(i);
      const Eigen::VectorXd along = product(information, open);
      const double within = open.dot(along);
      const Eigen::MatrixXd across = product_transposed(along, open);
      information += within * product_transposed(open, open) - across - across.transpose();
    }
  }
}

}  // namespace

ViewMotions motions_of_free_poses(const FreePoseBundle& bundle,
                                  const FreePoseSums& sums,
                                  double prior_mm) {
  // Neighbouring points of a scan have errors in common: the pairs of two views are at most as many
  // independent ones as a view has patches of a twentieth of its side.
  constexpr double kIndependent = 400.0;
  const Eigen::Index unknowns = sums.gradient.size();
  if (sums.over_sigma.empty() || !(prior_mm > 0.0)) return {};
  const double excess =
      std::max(1.0, static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal);
  const double counted = std::min(1.0,
                                  kIndependent * static_cast<double>(count_pairs(bundle.pairs)) /
                                      static_cast<double>(sums.over_sigma.size()));
  Eigen::MatrixXd to = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (Eigen::Index at = 0; at < unknowns; at += 6) {
    const auto view = static_cast<std::size_t>(at / 6 + 1);
    to.block<6, 6>(at, at) =
        about_center(place_of(bundle.surfels[view], bundle.rig_from_world[view].inverse()));
  }
  Eigen::MatrixXd information = congruence(to, sums.hessian);
  information = 0.5 * (information + information.transpose()).eval();
  remove_open(information);
  information *= counted / (excess * excess);
  information.diagonal().array() += 1.0 / (prior_mm * prior_mm);
  const auto eigen = symmetric_eigen(information);
  const Eigen::MatrixXd factor =
      product(to, eigen.vectors) *
      eigen.values.array().max(1e-12 * eigen.values[unknowns - 1]).rsqrt().matrix().asDiagonal();
  ViewMotions motions(1, Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, unknowns));
  for (Eigen::Index at = 0; at < unknowns; at += 6) {
    Eigen::Matrix<double, 6, Eigen::Dynamic> motion(6, unknowns);
    motion << factor.middleRows(at + 3, 3), factor.middleRows(at, 3);
    motions.push_back(std::move(motion));
  }
  return motions;
}

}  // namespace frangia
