#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/acceptance/acceptance_plan.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A ball as a scan has it.
struct MeasuredBall {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of the Gaussian (least-squares) sphere
  double diameter_mm = 0.0;                             ///< of the Gaussian sphere
  /// Least width of a shell about the center that contains 95 % of the points (P_Form.Sph.D95%).
  double form_95_mm = 0.0;
  /// The same with all points but 3 in 1000, which VDI/VDE 2634-3 allows to discard.
  double form_all_mm = 0.0;
  std::size_t points = 0;  ///< that these are measured with
  double seen = 0.0;       ///< share of the sphere's area that the points cover, 0 to 1
};

/// The balls of one arrangement.
struct MeasuredArtifact {
  std::vector<MeasuredBall> balls;  ///< in the order of the artifact's diameters
  double spacing_mm = 0.0;          ///< of the two centers; 0: a single ball
  /// Across both balls along the line of their centers: from the median point of one outer cap, of
  /// 15 degrees around the line, to that of the other. NaN: a single ball, or an end is not seen.
  double length_mm = kMissing;
};

/// Measures the balls of a ball bar, or a single ball, in the mesh of a scan.
///
/// All measured vertices of a ball count, none is rejected by its residual, except those within 6
/// degrees of where the surface leaves the sphere by more than 1 % of the diameter (its stem) or of
/// a border of the mesh.
///
/// @units    mm
/// @errors   Error(Input) where a ball is not found, or less than a fifth of it is seen;
///           Error(Cancelled)
/// @source   ISO 10360-13:2021; VDI/VDE 2634 part 3:2008
[[nodiscard]] MeasuredArtifact measure_balls(const Mesh& mesh,
                                             const ReferenceArtifact& artifact,
                                             const Run& run = {});

}  // namespace frangia
