#include "frangia/registration/internal/free_pose_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& by) {
  Eigen::Matrix3d cross;
  cross << 0.0, -by.z(), by.y(), by.z(), 0.0, -by.x(), -by.y(), by.x(), 0.0;
  return cross;
}

/// Sums with `blocks` poses as unknowns.
FreePoseSums empty_sums(std::size_t blocks) {
  const auto unknowns = static_cast<Eigen::Index>(6 * blocks);
  return {.hessian = Eigen::MatrixXd::Zero(unknowns, unknowns),
          .gradient = Eigen::VectorXd::Zero(unknowns),
          .ways = Eigen::MatrixXd::Zero(unknowns, unknowns)};
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
        world_from_(bundle.rig_from_world[from].inverse()),
        moments_(bundle.pairs[from].size(), Eigen::Matrix4d::Zero()) {}

  /// Adds the pair of a surfel and paired view `index`, if the surfel lies on a surface that this
  /// view measured.
  bool add_pair(FreePoseSums& sums, const SurfelMap::Surfel& surfel, std::size_t index) {
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
    const Eigen::Vector3d middle = rig_from_world.inverse() * pair.middle;
    const Eigen::Matrix<double, 6, 1> own = point_to_plane_jacobian(normal, middle);
    Eigen::Matrix<double, 12, 1> row;
    row << own, -own;
    add_equation(sums, {0, index + 1}, row, weight, distance);
    moments_[index] += weight * middle.homogeneous() * middle.homogeneous().transpose();
    sums.distances_mm.push_back(std::abs(distance));
    sums.over_sigma.push_back(static_cast<float>(std::abs(distance) / std::sqrt(variance)));
    return true;
  }

  /// Adds the whole ways of the pairs so far.
  void add_ways(FreePoseSums& sums) const {
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      const Eigen::Matrix<double, 6, 6> way = squared_way(moments_[i]);
      const auto to = static_cast<Eigen::Index>(6 * (i + 1));
      sums.ways.block<6, 6>(0, 0) += way;
      sums.ways.block<6, 6>(to, to) += way;
      sums.ways.block<6, 6>(0, to) -= way;
      sums.ways.block<6, 6>(to, 0) -= way;
    }
  }

 private:
  /// Sum of w |way|^2 of points by a shift and a rotation about the origin, from the sum of w p p^T
  /// of the points p in homogeneous coordinates.
  static Eigen::Matrix<double, 6, 6> squared_way(const Eigen::Matrix4d& moments) {
    const Eigen::Matrix3d cross = cross_matrix(moments.topRightCorner<3, 1>());
    const Eigen::Matrix3d squares = moments.topLeftCorner<3, 3>();
    Eigen::Matrix<double, 6, 6> way;
    way << moments(3, 3) * Eigen::Matrix3d::Identity(), -cross, cross,
        squares.trace() * Eigen::Matrix3d::Identity() - squares;
    return way;
  }

  const FreePoseBundle& bundle_;
  std::size_t from_;
  double gate_mm_;
  Eigen::Isometry3d world_from_;
  std::vector<Eigen::Matrix4d> moments_;  ///< sum of w p p^T of the pairs, by paired view
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
      const auto to = static_cast<Eigen::Index>(6 * (view_of(b) - 1));
      const auto other = static_cast<Eigen::Index>(6 * b);
      all.hessian.block<6, 6>(at, to) += part.hessian.block<6, 6>(own, other);
      all.ways.block<6, 6>(at, to) += part.ways.block<6, 6>(own, other);
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
    FreePoseComparison comparison(bundle, from, gate_mm);
    for (const SurfelMap::Surfel& surfel : bundle.surfels[from]) {
      bool matched = false;
      for (std::size_t i = 0; i < others; ++i)
        matched = comparison.add_pair(part, surfel, i) || matched;
      part.matched += matched ? 1U : 0U;
      ++part.surfels;
    }
    comparison.add_ways(part);
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
  Eigen::Matrix<double, 6, 6> to = Eigen::Matrix<double, 6, 6>::Zero();
  to.topLeftCorner<3, 3>().setIdentity();
  to.topRightCorner<3, 3>() = cross_matrix(place.center_mm) / place.arm_mm;
  to.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() / place.arm_mm;
  return to;
}

/// The places of the views 1, 2, ..., in `poses`.
std::vector<Place> places_of(const FreePoseBundle& bundle,
                             std::span<const Eigen::Isometry3d> poses) {
  std::vector<Place> places;
  for (std::size_t view = 1; view < poses.size(); ++view)
    places.push_back(place_of(bundle.surfels[view], poses[view].inverse()));
  return places;
}

Eigen::MatrixXd about_centers(const std::vector<Place>& places) {
  const auto unknowns = static_cast<Eigen::Index>(6 * places.size());
  Eigen::MatrixXd to = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    to.block<6, 6>(at, at) = about_center(places[i]);
  }
  return to;
}

/// Motions in units of the way by which they move the points of the pairs against each other, in
/// which the equations of the pairs are diagonal.
struct MotionsByShare {
  Eigen::MatrixXd root;            ///< lower: its transpose turns unknowns into these units
  Eigen::MatrixXd motions;         ///< orthonormal; no columns where there are no pairs
  Eigen::VectorXd squared_shares;  ///< of the way that is along the normals, ascending
  /// How many motions, the first ones, leave the surfaces where they are: what moves them along
  /// their normals by less than `kOpenMotion` of the way is noise of normals.
  Eigen::Index open = 0;
};

MotionsByShare motions_by_share(const Eigen::MatrixXd& hessian, Eigen::MatrixXd ways) {
  constexpr double kNothing = 1e-9;  // of the largest: a view without pairs moves freely
  MotionsByShare out{{}, Eigen::MatrixXd(hessian.rows(), 0), {}};
  const double most = ways.diagonal().maxCoeff();
  if (!(most > 0.0)) return out;
  ways.diagonal().array() += kNothing * most;
  const Eigen::LLT<Eigen::MatrixXd> root(ways);
  Eigen::MatrixXd shares = root.matrixL().solve(hessian);
  shares = root.matrixL().solve(shares.transpose().eval());
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(0.5 * (shares + shares.transpose())));
  while (out.open < eigen.values.size() && eigen.values[out.open] < kOpenMotion * kOpenMotion)
    ++out.open;
  out.root = root.matrixL();
  out.motions = eigen.vectors;
  out.squared_shares = eigen.values;
  return out;
}

/// The equations of the pairs about the centres of the views.
RestedEquations centered(const FreePoseSums& sums, Eigen::MatrixXd to) {
  RestedEquations out;
  out.hessian = congruence(to, sums.hessian);
  out.hessian = 0.5 * (out.hessian + out.hessian.transpose()).eval();
  out.gradient = transposed_product(to, sums.gradient);
  out.to = std::move(to);
  return out;
}

/// The same without the motions that leave the surfaces where they are: of one view, or of several
/// together.
RestedEquations without_open(const FreePoseSums& sums, Eigen::MatrixXd to) {
  RestedEquations out = centered(sums, std::move(to));
  const MotionsByShare by = motions_by_share(out.hessian, congruence(out.to, sums.ways));
  if (by.open == 0) return out;
  const Eigen::MatrixXd motions = by.motions.leftCols(by.open);
  const Eigen::MatrixXd rows = product(by.root, motions);
  const Eigen::VectorXd steps = by.root.triangularView<Eigen::Lower>().solve(out.gradient);
  out.gradient -= product(rows, transposed_product(motions, steps));
  out.hessian -= product_transposed(
      product(rows, Eigen::MatrixXd(by.squared_shares.head(by.open).asDiagonal())), rows);
  return out;
}

/// The share of the pairs' information that counts: neighbouring points have errors in common, and
/// distances may be larger than noise explains.
double counted_share(const FreePoseBundle& bundle, const FreePoseSums& sums) {
  // The pairs of two views are at most as many independent ones as a view has patches of a
  // twentieth of its side.
  constexpr double kIndependent = 400.0;
  const double excess =
      std::max(1.0, static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal);
  const double counted = std::min(1.0,
                                  kIndependent * static_cast<double>(count_pairs(bundle.pairs)) /
                                      static_cast<double>(sums.over_sigma.size()));
  return counted / (excess * excess);
}

/// How far the poses of the bundle are from given ones, in the unknowns of `RestedEquations`.
Eigen::VectorXd offsets_from(const FreePoseBundle& bundle,
                             const std::vector<Place>& places,
                             std::span<const Eigen::Isometry3d> given) {
  Eigen::VectorXd offsets(static_cast<Eigen::Index>(6 * places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d& center = places[i].center_mm;
    const Eigen::Isometry3d moved = bundle.rig_from_world[i + 1].inverse() * given[i + 1];
    const Eigen::AngleAxisd turn(moved.rotation());
    offsets.segment<6>(static_cast<Eigen::Index>(6 * i)) << center - moved.inverse() * center,
        places[i].arm_mm * turn.angle() * turn.axis();
  }
  return offsets;
}

}  // namespace

RestedEquations rest_on_given(const FreePoseBundle& bundle,
                              const FreePoseSums& sums,
                              std::span<const Eigen::Isometry3d> given,
                              double prior_mm) {
  const std::vector<Place> places = places_of(bundle, bundle.rig_from_world);
  RestedEquations out = without_open(sums, about_centers(places));
  if (sums.over_sigma.empty() || !(prior_mm > 0.0)) return out;
  const double information = 1.0 / (prior_mm * prior_mm * counted_share(bundle, sums));
  out.hessian.diagonal().array() += information;
  out.gradient += information * offsets_from(bundle, places, given);
  return out;
}

DeterminedOffsets determined_offsets(const FreePoseBundle& bundle,
                                     const FreePoseSums& sums,
                                     std::span<const Eigen::Isometry3d> given) {
  const std::vector<Place> places = places_of(bundle, bundle.rig_from_world);
  const RestedEquations all = centered(sums, about_centers(places));
  const MotionsByShare by = motions_by_share(all.hessian, congruence(all.to, sums.ways));
  const Eigen::Index count = by.motions.cols() - by.open;
  if (count <= 0) return {};
  // The offsets without the open motions, in unknowns.
  const Eigen::VectorXd offsets = offsets_from(bundle, places, given);
  const auto upper = by.root.transpose().triangularView<Eigen::Upper>();
  const Eigen::MatrixXd determined = by.motions.rightCols(count);
  const Eigen::VectorXd part = product(determined, transposed_product(determined, upper * offsets));
  // The covariance of a motion that has a way of 1 is that of its distances over its share.
  const Eigen::MatrixXd open = upper.solve(
      determined *
      by.squared_shares.tail(count).cwiseSqrt().cwiseInverse().asDiagonal().toDenseMatrix());
  const auto motions = static_cast<double>(count);
  const Eigen::VectorXd off = upper.solve(part);
  double shifts = 0.0;
  double turns = 0.0;
  for (Eigen::Index i = 0; i < off.size(); ++i)
    (i % 6 < 3 ? shifts : turns) += off[i] * off[i];
  return {std::sqrt(2.0 * std::max(shifts, turns) / motions),
          std::sqrt(open.squaredNorm() / motions / counted_share(bundle, sums)),
          static_cast<std::size_t>(count)};
}

ViewMotions motions_of_free_poses(const FreePoseBundle& bundle,
                                  const FreePoseSums& sums,
                                  double prior_mm) {
  const Eigen::Index unknowns = sums.gradient.size();
  if (sums.over_sigma.empty() || !(prior_mm > 0.0)) return {};
  const RestedEquations rested =
      without_open(sums, about_centers(places_of(bundle, bundle.rig_from_world)));
  Eigen::MatrixXd information = counted_share(bundle, sums) * rested.hessian;
  information.diagonal().array() += 1.0 / (prior_mm * prior_mm);
  const auto eigen = symmetric_eigen(information);
  const Eigen::MatrixXd factor =
      product(rested.to, eigen.vectors) *
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
