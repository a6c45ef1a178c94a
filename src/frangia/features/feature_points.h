#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Measured points of a surface, which shapes are fitted to.
struct FeaturePoints {
  std::vector<Eigen::Vector3d> points_mm;  ///< positions
  std::vector<Eigen::Vector3d> normals;    ///< unit, outward, one for each point
  std::vector<double> noise_mm;            ///< standard uncertainty without the systematic part,
                                           ///< one for each point, or empty
  std::vector<double> systematic_mm;       ///< systematic part, one for each point, or empty
  /// Displacements along the normals by what is alike in the whole part, independent changes of the
  /// rig's parameters or of the temperature, of one standard deviation each: a row for each change,
  /// a column for each point; empty: not known.
  Eigen::MatrixXf calibration_mm;
  /// Numbers of the mesh's vertices, ascending, one for each point; empty for samples.
  std::vector<std::uint32_t> vertices;
  double area_mm2 = 0.0;  ///< of the surface that the points represent

  [[nodiscard]] std::size_t size() const { return points_mm.size(); }  ///< number of points
};

/// Collects the points of a mesh that were measured: its vertices, without those that are marked as
/// synthesized, that no triangle uses, or whose triangles have no area.
///
/// A mesh whose vertices do not cover its surface evenly, such as a tessellated CAD model, is
/// sampled instead; the samples have the normals of their triangles.
///
/// `calibration_mm` are the displacements of all vertices, as `FeaturePoints` has them. They
/// replace what the systematic part of sigma holds of the calibration.
/// @units    mm
/// @missing  a sigma that is not finite and positive counts as the median one
/// @errors   Error(Input) for a mesh without measured triangles
[[nodiscard]] FeaturePoints feature_points_of(const Mesh& mesh,
                                              const Run& run = {},
                                              const Eigen::MatrixXf* calibration_mm = nullptr);

}  // namespace frangia
