#include "frangia/registration/explain/internal/cause_motions.h"

#include <cmath>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"
#include "frangia/registration/explain/internal/moved_rig.h"
#include "frangia/registration/explain/internal/time_profiles.h"

namespace frangia {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Isometry3d table_of_view(const PoseSetting& setting, std::size_t view) {
  return setting.object_from_table.empty() ? Eigen::Isometry3d::Identity()
                                           : setting.object_from_table[view];
}

/// A rotation about the axis of a view's table by 1 rad, by a share of each view.
Eigen::MatrixXd turns_of_table(const PoseSetting& setting,
                               const Eigen::VectorXd& shares,
                               Eigen::Index unknowns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, 1);
  for (Eigen::Index view = 0; view < shares.size(); ++view) {
    const Eigen::Isometry3d table = table_of_view(setting, static_cast<std::size_t>(view));
    const Eigen::Vector3d axis = table.linear().col(2);
    all.block<3, 1>(6 * view, 0) = shares[view] * axis;
    all.block<3, 1>(6 * view + 3, 0) = shares[view] * table.translation().cross(axis);
  }
  return all;
}

/// The same motion of the part on its table in each view, by a share.
Eigen::MatrixXd motions_on_table(const PoseSetting& setting,
                                 const Eigen::VectorXd& shares,
                                 Eigen::Index unknowns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, 6);
  for (Eigen::Index view = 0; view < shares.size(); ++view) {
    all.middleRows<6>(6 * view) =
        shares[view] * motions_of_part(setting, static_cast<std::size_t>(view));
  }
  return all;
}

/// 1 for each view from `first` on.
Eigen::VectorXd from_on(std::size_t first, std::size_t views) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(views));
  shares.tail(static_cast<Eigen::Index>(views - first)).setOnes();
  return shares;
}

/// Changes of all terms of the rig, by functions of time.
Eigen::MatrixXd of_rig(const Eigen::MatrixXd& functions,
                       const PoseSetting& setting,
                       Eigen::Index unknowns) {
  const Eigen::Index terms = setting.rig_changes;
  const Eigen::MatrixXd shares = transposed_product(setting.rig_basis, functions);
  const Eigen::Index first = unknowns - terms * shares.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, terms * shares.cols());
  for (Eigen::Index row = 0; row < shares.rows(); ++row) {
    for (Eigen::Index column = 0; column < shares.cols(); ++column)
      all.block(first + terms * row, terms * column, terms, terms)
          .diagonal()
          .setConstant(shares(row, column));
  }
  return all;
}

Eigen::VectorXd turned_angles(const PoseSetting& setting) {
  Eigen::VectorXd angles(static_cast<Eigen::Index>(setting.views));
  for (std::size_t view = 0; view < setting.views; ++view)
    angles[static_cast<Eigen::Index>(view)] = setting.angles_rad[view] - setting.angles_rad[0];
  return angles;
}

}  // namespace

Eigen::Matrix<double, 6, 6> motions_of_part(const PoseSetting& setting, std::size_t view) {
  const Eigen::Matrix3d axes = table_of_view(setting, view).linear();
  Matrix6 by = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d turn = axes.col(i) / setting.radius_mm;
    by.block<3, 1>(0, i) = turn;
    by.block<3, 1>(3, i) = setting.center_mm.cross(turn);
    by.block<3, 1>(3, 3 + i) = axes.col(i);
  }
  return by;
}

Eigen::MatrixXd unit_motions(PoseCause cause,
                             const std::vector<std::size_t>& at,
                             const PoseSetting& setting,
                             Eigen::Index unknowns,
                             std::size_t profile) {
  const auto views = static_cast<Eigen::Index>(setting.views);
  Eigen::MatrixXd none(unknowns, 0);
  switch (cause) {
    case PoseCause::AsStated:
      return none;
    case PoseCause::Turntable: {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, setting.beyond_stated.cols());
      all.topRows(6 * views) = setting.beyond_stated;
      return all;
    }
    case PoseCause::Turned:
      return turns_of_table(setting, from_on(at[0], setting.views) / setting.radius_mm, unknowns);
    case PoseCause::AnglesScaled:
      return turns_of_table(setting, turned_angles(setting), unknowns);
    case PoseCause::AnglesWrong: {
      const auto count = static_cast<Eigen::Index>(at.size());
      Eigen::MatrixXd all(unknowns, count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto view = static_cast<Eigen::Index>(at[static_cast<std::size_t>(i)]);
        all.col(i) = turns_of_table(
            setting, Eigen::VectorXd::Unit(views, view) / setting.radius_mm, unknowns);
      }
      return all;
    }
    case PoseCause::PartMoved:
      return motions_on_table(setting, from_on(at[0], setting.views), unknowns);
    case PoseCause::PartMovedTwice: {
      Eigen::MatrixXd all(unknowns, 12);
      all << unit_motions(PoseCause::PartMoved, {at[0]}, setting, unknowns),
          unit_motions(PoseCause::PartMoved, {at[1]}, setting, unknowns);
      return all;
    }
    case PoseCause::ViewMoved:
      return motions_on_table(
          setting, Eigen::VectorXd::Unit(views, static_cast<Eigen::Index>(at[0])), unknowns);
    case PoseCause::ViewsMoved: {
      const auto count = static_cast<Eigen::Index>(at.size());
      Eigen::MatrixXd all(unknowns, 6 * count);
      for (Eigen::Index i = 0; i < count; ++i) {
        all.middleCols(6 * i, 6) = unit_motions(
            PoseCause::ViewMoved, {at[static_cast<std::size_t>(i)]}, setting, unknowns);
      }
      return all;
    }
    case PoseCause::PartDrift: {
      const Eigen::MatrixXd functions = time_profile(profile, setting.times);
      Eigen::MatrixXd all(unknowns, 6 * functions.cols());
      for (Eigen::Index i = 0; i < functions.cols(); ++i)
        all.middleCols<6>(6 * i) = motions_on_table(setting, functions.col(i), unknowns);
      return all;
    }
    case PoseCause::Wobble:
    case PoseCause::Unexplained: {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, 6 * views);
      for (Eigen::Index view = 0; view < views; ++view)
        all.block<6, 6>(6 * view, 6 * view) =
            motions_of_part(setting, static_cast<std::size_t>(view));
      return all;
    }
    case PoseCause::Rig:
      return of_rig(Eigen::VectorXd::Ones(views), setting, unknowns);
    case PoseCause::TableMoved:
      return motions_in_rig(setting, from_on(at[0], setting.views), unknowns).leftCols<6>();
    case PoseCause::RigMoved:
      return product(motions_in_rig(setting, from_on(at[0], setting.views), unknowns),
                     motions_of_knock(static_cast<MovedRig>(profile)));
    case PoseCause::RigDrift: {
      // The rig may be as stated at the beginning, at the end or between: its mean change is half
      // of its drift.
      const Eigen::MatrixXd drift = time_profile(profile, setting.times);
      // No drift is exactly of one course.
      constexpr double kOffCourse = 0.02;
      const Eigen::MatrixXd any = basis_of_profiles(setting.times);
      Eigen::MatrixXd functions(views, 1 + drift.cols() + any.cols());
      functions << Eigen::VectorXd::Constant(views, 0.5), drift, kOffCourse * any;
      return of_rig(functions, setting, unknowns);
    }
  }
  return none;
}

Eigen::Matrix<double, 6, 1> shares_of_motion(bool slides) {
  // A part that slides stays on its face, but for dust and burrs.
  constexpr double kOffTheTable = 0.03;
  const double off = slides ? kOffTheTable : 1.0;
  return {off, off, 1.0, 1.0, 1.0, off};
}

Eigen::MatrixXd motions_of(const CauseHypothesis& hypothesis,
                           const PoseSetting& setting,
                           Eigen::Index unknowns) {
  Eigen::MatrixXd motions =
      hypothesis.scale *
      unit_motions(hypothesis.cause, hypothesis.views, setting, unknowns, hypothesis.profile);
  if (!hypothesis.slides) return motions;
  return motions * shares_of_motion(true).replicate(motions.cols() / 6, 1).asDiagonal();
}

RigChanges rig_changes(const DriftModel& model,
                       const Pattern& pattern,
                       const SurfelLists& surfels,
                       const Eigen::MatrixXd& basis,
                       const Eigen::VectorXd& at) {
  std::vector<SurfelMap::Surfel> all;
  for (const std::vector<SurfelMap::Surfel>& view : surfels)
    all.insert(all.end(), view.begin(), view.end());
  // The derivatives hardly change within a drift: those of its mean serve all views.
  const Eigen::VectorXd mean = changes_of_views(at, basis).rowwise().mean();
  return {DriftField(PointDrift(model, mean), pattern, all), basis, model.count()};
}

std::vector<Rig> rigs_of_views(const DriftModel& model,
                               const Eigen::MatrixXd& basis,
                               const Eigen::VectorXd& at) {
  std::vector<Rig> rigs;
  const Eigen::MatrixXd changes = changes_of_views(at, basis);
  for (Eigen::Index view = 0; view < changes.cols(); ++view)
    rigs.push_back(model.rig_at(changes.col(view)));
  return rigs;
}

void displace_views(std::vector<SurfelMap>& maps,
                    const Rig& stated,
                    const std::vector<Rig>& rigs,
                    const Pattern& pattern) {
  for (std::size_t view = 0; view < maps.size(); ++view) {
    const Rig& rig = rigs[view];
    const auto surfels = maps[view].surfels.pixels();
    parallel_chunks(surfels.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        SurfelMap::Surfel& surfel = surfels[i];
        if (!(surfel.sigma_mm > 0.0F)) continue;
        const Eigen::Vector3d point = surfel.point_mm.cast<double>();
        const Eigen::Vector2d pixel = stated.reference().model.project(point);
        const Eigen::Vector2d ray = rig.reference().model.ray(pixel);
        const double phase_rad = phase_at(point, pattern, stated.projector);
        const RayDepth found = intersect_fringe(ray, phase_rad, pattern, rig.projector);
        if (std::isnan(found.depth_mm)) {
          surfel = {};
        } else {
          surfel.point_mm = (found.depth_mm * ray.homogeneous()).cast<float>();
        }
      }
    });
  }
}

}  // namespace frangia
