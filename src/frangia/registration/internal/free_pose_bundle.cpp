#include "frangia/registration/internal/free_pose_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

/// Sums with `blocks` poses as unknowns.
FreePoseSums empty_sums(std::size_t blocks) {
  const auto unknowns = static_cast<Eigen::Index>(6 * blocks);
  return {Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns), {}, {}, 0, 0};
}

/// Adds an equation in the poses of two views, given by their blocks of unknowns.
void add_equation(FreePoseSums& sums,
                  const std::array<std::size_t, 2>& blocks,
                  const Eigen::Matrix<double, 12, 1>& row,
                  double weight,
                  double distance) {
  for (std::size_t a = 0; a < 2; ++a) {
    const auto at = static_cast<Eigen::Index>(6 * blocks.at(a));
    const auto part = row.segment<6>(static_cast<Eigen::Index>(6 * a));
    sums.gradient.segment<6>(at) += weight * distance * part;
    for (std::size_t b = 0; b < 2; ++b) {
      const auto to = static_cast<Eigen::Index>(6 * blocks.at(b));
      sums.hessian.block<6, 6>(at, to) +=
          weight * part * row.segment<6>(static_cast<Eigen::Index>(6 * b)).transpose();
    }
  }
}

/// A view's surfels against its paired views. Their sums have a block for the view itself, and one
/// for each paired view after it.
class FreePoseComparison {
 public:
  FreePoseComparison(const FreePoseBundle& bundle, std::size_t from, double gate_mm)
      : bundle_(bundle),
        from_(from),
        gate_mm_(gate_mm),
        world_from_(bundle.rig_from_world[from].inverse()) {}

  /// Adds the pair of a surfel and paired view `index`, if the surfel lies on a surface that this
  /// view measured.
  bool add_pair(FreePoseSums& sums, const SurfelMap::Surfel& surfel, std::size_t index) const {
    const std::size_t to = bundle_.pairs[from_][index];
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
    const double variance = std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                            std::pow(static_cast<double>(target->sigma_mm), 2);
    const double weight = tukey_weight(distance, gate_mm_) / variance;
    const Eigen::Vector3d normal = rig_from_world.linear().transpose() * pair.normal;
    const Eigen::Matrix<double, 6, 1> own =
        point_to_plane_jacobian(normal, rig_from_world.inverse() * pair.middle);
    Eigen::Matrix<double, 12, 1> row;
    row << own, -own;
    add_equation(sums, {0, index + 1}, row, weight, distance);
    sums.distances_mm.push_back(std::abs(distance));
    sums.over_sigma.push_back(static_cast<float>(std::abs(distance) / std::sqrt(variance)));
    return true;
  }

 private:
  const FreePoseBundle& bundle_;
  std::size_t from_;
  double gate_mm_;
  Eigen::Isometry3d world_from_;
};

/// Adds a view's normal equations to those of all views. The pose of view 0 is held.
void add_blocks(FreePoseSums& all,
                std::size_t from,
                const std::vector<std::size_t>& others,
                const FreePoseSums& part) {
  const auto view_of = [&](std::size_t block) { return block == 0 ? from : others[block - 1]; };
  for (std::size_t a = 0; a <= others.size(); ++a) {
    if (view_of(a) == 0) continue;
    const auto own = static_cast<Eigen::Index>(6 * a);
    const auto at = static_cast<Eigen::Index>(6 * (view_of(a) - 1));
    all.gradient.segment<6>(at) += part.gradient.segment<6>(own);
    for (std::size_t b = 0; b <= others.size(); ++b) {
      if (view_of(b) == 0) continue;
      all.hessian.block<6, 6>(at, static_cast<Eigen::Index>(6 * (view_of(b) - 1))) +=
          part.hessian.block<6, 6>(own, static_cast<Eigen::Index>(6 * b));
    }
  }
}

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
    const std::size_t others = bundle.pairs[from].size();
    FreePoseSums& part = parts[from] = empty_sums(others + 1);
    const FreePoseComparison comparison(bundle, from, gate_mm);
    for (const SurfelMap::Surfel& surfel : bundle.surfels[from]) {
      bool matched = false;
      for (std::size_t i = 0; i < others; ++i)
        matched = comparison.add_pair(part, surfel, i) || matched;
      part.matched += matched ? 1U : 0U;
      ++part.surfels;
    }
  });
  FreePoseSums all = empty_sums(views - 1);
  for (std::size_t from = 0; from < views; ++from) {
    FreePoseSums& part = parts[from];
    add_blocks(all, from, bundle.pairs[from], part);
    all.distances_mm.insert(
        all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
    part.distances_mm = {};
    all.over_sigma.insert(all.over_sigma.end(), part.over_sigma.begin(), part.over_sigma.end());
    part.over_sigma = {};
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
