#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/inspect/deviation.h"

namespace frangia {

/// A part of the nominal surface that is not judged, such as the base that a part stands on.
struct ExcludedBox {
  std::string name;                                  ///< for the report
  Eigen::Vector3d min_mm = Eigen::Vector3d::Zero();  ///< least corner, frame of the reference
  Eigen::Vector3d max_mm = Eigen::Vector3d::Zero();  ///< largest corner
};

/// The nominal surface in overlapping round patches, and the deviation that was measured in each.
///
/// The centers are at most half a diameter apart, so that no place lies between patches. Arrays
/// have one entry for each patch.
struct SurfacePatches {
  double diameter_mm = 0.0;     ///< of a patch
  double total_area_mm2 = 0.0;  ///< nominal, less what is excluded and the strips
  double edge_area_mm2 = 0.0;   ///< nominal, of the strips along edges, which are not judged
  double size_mm = 0.0;         ///< diagonal of the bounding box of the reference
  std::vector<Eigen::Vector3f> center_mm;  ///< on the nominal surface
  std::vector<Eigen::Vector3f> normal;     ///< of the nominal surface, unit
  /// Nominal area nearest to the center, less what lies in strips along edges.
  std::vector<double> area_mm2;
  std::vector<std::uint8_t> at_edge;  ///< 1 where the center lies in such a strip
  std::vector<float> deviation_mm;    ///< mean over the patch; NaN where nothing was compared
  std::vector<float> noise_mm;        ///< standard uncertainty of the mean by noise
  std::vector<float> systematic_mm;   ///< by what is alike in the patch: averaging keeps it
  /// 1 where measured surface lies inside of the nominal material below an unmeasured patch, or was
  /// seen through it.
  std::vector<std::uint8_t> missing;
  std::vector<std::vector<std::uint32_t>> neighbors;  ///< patches within a diameter, on this side
  bool uncertainty_known = false;                     ///< the mesh has a sigma
  /// How much the variance of a mean exceeds what the noise states, less what the points in a patch
  /// share, from the differences of patches near each other; 1 or more.
  double noise_factor = 1.0;

  [[nodiscard]] std::size_t size() const { return center_mm.size(); }  ///< number of patches
  /// Whether anything was compared in a patch.
  [[nodiscard]] bool is_measured(std::size_t patch) const;
  /// Combined standard uncertainty of a patch, mm.
  [[nodiscard]] double u_mm(std::size_t patch) const;
};

/// Twice the mean distance of the vertices of a mesh.
///
/// @units    mm
[[nodiscard]] double default_feature_mm(const Mesh& mesh);

/// The width of the strips along edges that are not judged, unless a rule states it: the mean
/// distance of the vertices of a mesh, at most 1 % of the diagonal of the reference, and halved
/// until the strips hold a quarter of the area or less.
///
/// @units    mm
[[nodiscard]] double default_edge_mm(const Mesh& mesh, const Mesh& reference);

/// Filters deviations by a mean over round patches of `diameter_mm` of the nominal surface; 0:
/// `default_feature_mm`. `reference` is what `deviations_of` compared with. Patches grow where
/// there would be more than 400 000. What lies within `edge_mm` of an edge of the reference counts
/// for patches at edges alone.
///
/// @missing  NaN deviation of a patch of which less than a quarter was compared
/// @errors   Error(Input) without triangles, or when all of the reference is excluded or in strips
/// @source   Poisson-disk centers: Cook 1986
[[nodiscard]] SurfacePatches surface_patches(const Mesh& mesh,
                                             const Deviations& deviations,
                                             const RayScene& reference,
                                             double diameter_mm = 0.0,
                                             const std::vector<ExcludedBox>& excluded = {},
                                             double edge_mm = 0.0,
                                             const Run& run = {});

}  // namespace frangia
