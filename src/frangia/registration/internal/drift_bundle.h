#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/drift_field.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// A view, triangulated by the rig of the current round, and how its points move with the rig.
struct DriftView {
  SurfelMap map;
  std::size_t station = 0;
  DriftField field{};
};

/// Drift of a rig and its turntable, in one linearization of the triangulation.
struct DriftState {
  Eigen::VectorXd w;  ///< changes of the rig, as `DriftModel` has them
  TableState table;
};

/// A refinement of a rig in progress.
///
/// A step in the unknowns holds the coordinates of a change of w in `free_directions`, then a step
/// of the table.
struct DriftBundle {
  std::vector<DriftView> views;
  FastCameraModel camera;           ///< of the rig at `linearized_at`
  Eigen::VectorXd linearized_at;    ///< w for which the views were triangulated
  Eigen::MatrixXd free_directions;  ///< orthonormal columns
  TableState given;                 ///< prior of the table
  Eigen::VectorXd table_sigma;      ///< of its prior
  ViewPairs pairs;                  ///< the views that are compared
  double noise_mm = 0.0;            ///< of the distance of a pair
  double min_gate_mm = 0.0;         ///< the noise of the surfels allows no narrower gate
  double systematic_mm = 0.0;       ///< error that all pairs of two views have in common
  double gate_mm = 0.0;             ///< pairs farther apart do not count
  DriftState state;
};

/// Normal equations of the distances between all views, in one state.
struct DriftSums {
  Eigen::MatrixXd hessian;           ///< sum of w J^T J
  Eigen::VectorXd gradient;          ///< sum of w J^T r
  Eigen::MatrixXd region_gradients;  ///< the same, a column for each quarter of a view
  std::vector<float> distances_mm;   ///< absolute, of all pairs within the gate

  /// Weight of the pairs relative to the prior. The pairs of two views share an error of
  /// `systematic_mm`, so that they count as (noise / systematic)^2 independent ones at most, and
  /// what the noise does not explain adds to the variance of each.
  [[nodiscard]] double weight(const DriftBundle& bundle) const;
};

/// Compares about `surfels` surfels of each view with the views that it is paired with.
[[nodiscard]] DriftSums sum_drift(const DriftBundle& bundle, std::size_t surfels);

/// Minimizes the distances together with the prior; `gate_mm` is that of the start and of the end.
void optimize_drift(DriftBundle& bundle, std::size_t surfels, int max_iterations, const Run& run);

/// What the pairs tell of w alone, axis and angles being unknown: their part of the loss is
/// 0.5 d^T hessian d + gradient^T d, with d the change of w from that of the bundle.
struct DriftEvidence {
  Eigen::MatrixXd hessian;  ///< the information, in units of the prior's
  Eigen::VectorXd gradient;
};

/// The evidence with `table_sigma` as the standard deviations of the prior of axis and angles.
[[nodiscard]] DriftEvidence evidence_of(const DriftBundle& bundle,
                                        const DriftSums& sums,
                                        const Eigen::VectorXd& table_sigma);

/// The information of the pairs on w once it has been fitted to them, axis and angles being
/// unknown. What is left between the views of each region pulls at w: where the regions do so by
/// more than their noise, they have errors that no number of pairs averages out.
///
/// @source   sandwich estimator with clusters: White 1980, Liang & Zeger 1986
[[nodiscard]] Eigen::MatrixXd information_of(const DriftBundle& bundle, const DriftSums& sums);

}  // namespace frangia
