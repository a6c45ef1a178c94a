#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Whether a vertex has a thickness, and otherwise why not.
enum class ThicknessStatus : std::uint8_t {
  Measured,     ///< it has a thickness
  Synthesized,  ///< one of the two walls was not measured
  MeshEdge,     ///< on the boundary of the mesh, where the measurement ends
  NoWall,       ///< no wall faces it: the mesh is open there
  Oblique,      ///< the wall that faces it is inclined too much
  SharpEdge,    ///< its triangles face too differently for one normal
  Unused        ///< no triangle uses it
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(ThicknessStatus /*any*/) {
  return EnumNames<ThicknessStatus, 7>{{{ThicknessStatus::Measured, "measured"},
                                        {ThicknessStatus::Synthesized, "synthesized"},
                                        {ThicknessStatus::MeshEdge, "mesh_edge"},
                                        {ThicknessStatus::NoWall, "no_wall"},
                                        {ThicknessStatus::Oblique, "oblique"},
                                        {ThicknessStatus::SharpEdge, "sharp_edge"},
                                        {ThicknessStatus::Unused, "unused"}}};
}
inline constexpr std::size_t kThicknessStatuses = 7;  ///< number of values of `ThicknessStatus`

/// The thickness of the wall at each vertex.
struct Thickness {
  std::vector<float> thickness_mm;      ///< NaN where there is none
  std::vector<float> u_mm;              ///< standard uncertainty; empty when no sigma is known
  std::vector<ThicknessStatus> status;  ///< of each vertex
};

/// Measures the distance from each vertex along its inward normal to the opposite wall.
///
/// The ray method: it is exact between parallel walls and, unlike the largest inscribed sphere,
/// does not fall to zero towards edges; an inclined wall gives the length of the ray. The
/// uncertainty is that of both walls along the ray: their noise is independent, their systematic
/// parts add up, since what is alike in both walls does not cancel.
///
/// `scene` is that of `mesh`. The result has the same bytes for any number of threads.
/// @units    mm
/// @missing  NaN for the vertices that `ThicknessStatus` leaves out
/// @errors   Error(Input) for a mesh without triangles; Error(Cancelled)
[[nodiscard]] Thickness thickness_of(const RayScene& scene, const Run& run = {});

/// The thickness over a mesh, weighted by area.
struct ThicknessSummary {
  std::array<std::size_t, kThicknessStatuses> count{};  ///< of vertices, by `ThicknessStatus`
  double area_mm2 = 0.0;                                ///< of the measured vertices
  double mean_mm = kMissing;                            ///< of the measured area
  double p5_mm = kMissing;                              ///< 5 % of the area is thinner
  double median_mm = kMissing;                          ///< half of the area is thinner
  double p95_mm = kMissing;                             ///< 5 % of the area is thicker
  double min_mm = kMissing;                             ///< smallest of a vertex
  double max_mm = kMissing;                             ///< largest of a vertex
  double min_u_mm = kMissing;                           ///< standard uncertainty of the smallest
  double median_u_mm = kMissing;                        ///< NaN when none is known
  Eigen::Vector3d min_at_mm = Eigen::Vector3d::Constant(kMissing);  ///< where the smallest is
};

/// Sums up the thickness of a mesh.
///
/// @units    mm
/// @missing  NaN where no vertex has a thickness
[[nodiscard]] ThicknessSummary summarize(const Mesh& mesh, const Thickness& thickness);

}  // namespace frangia
