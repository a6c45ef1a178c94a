#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/exact_surface.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/uncertainty/conformity.h"
#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// Whether a vertex has a deviation, and otherwise why not.
enum class DeviationStatus : std::uint8_t {
  Compared,       ///< it has a deviation
  Synthesized,    ///< it, or all of its triangles, were not measured
  MeshEdge,       ///< on the boundary of the mesh, where the measurement ends
  ReferenceEdge,  ///< its nearest point is on the boundary of an open reference
  SharpEdge,      ///< at an edge of the mesh that its resolution rounds or breaks
  OtherSide,      ///< the nearest surface faces the other way
  TooFar,         ///< farther from the reference than the limit
  Unused          ///< no triangle uses it
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(DeviationStatus /*any*/) {
  return EnumNames<DeviationStatus, 8>{{{DeviationStatus::Compared, "compared"},
                                        {DeviationStatus::Synthesized, "synthesized"},
                                        {DeviationStatus::MeshEdge, "mesh_edge"},
                                        {DeviationStatus::ReferenceEdge, "reference_edge"},
                                        {DeviationStatus::SharpEdge, "sharp_edge"},
                                        {DeviationStatus::OtherSide, "other_side"},
                                        {DeviationStatus::TooFar, "too_far"},
                                        {DeviationStatus::Unused, "unused"}}};
}
inline constexpr std::size_t kDeviationStatuses = 8;  ///< number of values of `DeviationStatus`

/// What is compared, and the uncertainty beside that of the vertices.
struct DeviationOptions {
  double max_distance_mm = std::numeric_limits<double>::infinity();  ///< farther: `TooFar`
  std::optional<PoseUncertainty> pose;  ///< of the mesh on the reference; none: known exactly
  double expansion_per_k = 0.0;         ///< coefficient of thermal expansion of the part, 1/K
  double temperature_u_k = 0.0;         ///< standard uncertainty of its temperature, K
  /// Surface that the reference approximates, such as a CAD model; null: the reference is exact.
  const ExactSurface* exact = nullptr;

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// The deviation of each vertex from a reference.
struct Deviations {
  std::vector<float> deviation_mm;       ///< positive outside; NaN where it was not compared
  std::vector<float> u_mm;               ///< standard uncertainty; empty when no sigma is known
  std::vector<DeviationStatus> status;   ///< of each vertex
  std::vector<Eigen::Vector3f> foot_mm;  ///< nearest point of the reference; of those compared
  /// Largest contribution of the pose and of the temperature to `u_mm`.
  double largest_pose_u_mm = 0.0;
  double largest_temperature_u_mm = 0.0;  ///< see `largest_pose_u_mm`
};

/// Computes the signed distance of each vertex from the nearest point of a reference and its
/// standard uncertainty: that of the vertex, of the pose, and of the thermal expansion from the
/// center of the mesh, along the direction of the deviation, combined as independent.
///
/// The result has the same bytes for any number of threads.
/// @units    mm
/// @missing  NaN for the vertices that `DeviationStatus` leaves out; those at sharp edges only of a
///           mesh with a sigma, which was measured
/// @errors   Error(Input) when either mesh has no triangles; Error(Cancelled)
/// @source   point to triangle: Ericson 2004; GUM (JCGM 100:2008), 5.1.2
[[nodiscard]] Deviations deviations_of(const Mesh& mesh,
                                       const RayScene& reference,
                                       const DeviationOptions& options = {},
                                       const Run& run = {});

/// Deviations of the vertices of a mesh, unfiltered. `judge_surface` decides about them.
struct DeviationSummary {
  std::array<std::size_t, kDeviationStatuses> count{};  ///< of vertices, by `DeviationStatus`
  double area_mm2 = 0.0;                                ///< of the compared vertices
  double mean_mm = kMissing;                            ///< signed, weighted by area
  double rms_mm = kMissing;                             ///< weighted by area
  double min_mm = kMissing;                             ///< smallest signed deviation
  double max_mm = kMissing;                             ///< largest signed deviation
  Eigen::Vector3d min_at_mm = Eigen::Vector3d::Zero();  ///< where `min_mm` is
  Eigen::Vector3d max_at_mm = Eigen::Vector3d::Zero();  ///< where `max_mm` is
  double median_u_mm = kMissing;  ///< standard uncertainty; NaN when none is known
};

/// Decides about each vertex by ISO 14253-1.
///
/// @shape    one for each vertex
/// @missing  undecided for vertices that were not compared; without any sigma, the deviations
///           alone decide
[[nodiscard]] std::vector<Conformity> conformities(const Deviations& deviations,
                                                   const ToleranceLimits& limits);

/// Sums up the deviations of a mesh.
///
/// @units    mm
[[nodiscard]] DeviationSummary summarize(const Mesh& mesh, const Deviations& deviations);

/// How many vertices were not compared, and why: "3 sharp edge, 2 unused", or "none".
[[nodiscard]] std::string left_out_text(const DeviationSummary& summary);

/// Share of the compared area in each of `bins` equal intervals from `low` to `high`; values beyond
/// an end count in the last interval on that side.
///
/// @errors   Error(Input) without bins or when `low` is not below `high`
[[nodiscard]] std::vector<float> deviation_histogram(const Mesh& mesh,
                                                     const std::vector<float>& deviation_mm,
                                                     double low,
                                                     double high,
                                                     std::size_t bins);

}  // namespace frangia
