#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/internal/drift_field.h"
#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {

/// How the measured points move with changes of the rig, which may differ from view to view.
struct RigChanges {
  DriftField field;
  Eigen::MatrixXd basis;   ///< functions of time that the changes consist of, views x functions
  Eigen::Index count = 0;  ///< of the terms that change

  /// How many unknowns the rig has.
  [[nodiscard]] Eigen::Index unknowns() const { return count * basis.cols(); }
};

/// The changes of the rig in each view.
///
/// @shape    `of_rig`: the terms of the first function of `basis`, then those of the next; terms x
///           views
[[nodiscard]] inline Eigen::MatrixXd changes_of_views(const Eigen::VectorXd& of_rig,
                                                      const Eigen::MatrixXd& basis) {
  const Eigen::Index terms = of_rig.size() / basis.cols();
  return product_transposed(of_rig.reshaped(terms, basis.cols()), basis);
}

/// Views in free poses.
struct PosedViews {
  std::vector<Eigen::Isometry3d> object_from_rig;  ///< by view
  const RigChanges* rig = nullptr;                 ///< none: the rig has no unknowns
};

/// Sum of w (r + J x)^2 / 2 in x, but for a constant.
struct NormalEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;

  /// Adds a multiple of others.
  void add(const NormalEquations& other, double share = 1.0) {
    hessian += share * other.hessian;
    gradient += share * other.gradient;
  }
};

/// All point-to-plane distances between views, in free poses.
///
/// @shape    unknowns: six of each view, the rotation (rad) and the translation (mm) of its points
///           in the object frame; then those of the rig, as `changes_of_views` has them
struct PoseSums {
  /// Of every other region of the views: either half predicts the other.
  std::array<NormalEquations, 2> halves;
  double weight = 0.0;   ///< sum of w, per mm^2
  double squares = 0.0;  ///< sum of w r^2
  /// Sum of w J of each of `fit.regions`: by the six unknowns of the view and the changes of the
  /// rig in it, then the same of the other view; empty where no pair agrees.
  std::vector<Eigen::VectorXd> region_rows;
  Eigen::MatrixXd rig_basis;  ///< of `RigChanges`; empty: the rig has no unknowns
  BundleSums fit;             ///< without equations

  [[nodiscard]] NormalEquations all() const;
  /// Mean distances of the regions with at least `fewest` pairs, after motions x of the views.
  [[nodiscard]] std::vector<float> region_means_mm(const Eigen::VectorXd& motion,
                                                   std::size_t fewest) const;
};

/// Compares the surfels of each view with those of its paired views, within the gate of the bundle.
///
/// @source   as `sum_bundle`
[[nodiscard]] PoseSums sum_poses(const Bundle& bundle,
                                 const SurfelLists& surfels,
                                 const PosedViews& views);

/// Compares the points of the ties of the bundle, in the unknowns of `PoseSums`. Unlike pairs of
/// surfels, of which many share an error, they are independent, and weighted as `sum_ties` does.
[[nodiscard]] NormalEquations sum_pose_ties(const Bundle& bundle, const PosedViews& views);

}  // namespace frangia
