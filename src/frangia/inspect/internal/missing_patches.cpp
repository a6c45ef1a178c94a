#include "frangia/inspect/internal/missing_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace frangia::inspect {
namespace {

using Eigen::Vector3d;

constexpr double kFacing = 0.3;  // cosine: surfaces that differ by less are one face

/// The measured surface behind an unmeasured place.
struct Behind {
  const RayScene& mesh;
  const RayScene& reference;
  double margin_mm;

  /// Depth of the material that is missing below a place; nothing where it is not known to be.
  [[nodiscard]] std::optional<double> depth_mm(const Vector3d& center,
                                               const Vector3d& normal) const {
    if (mesh.nearest(center, margin_mm)) return std::nullopt;
    const auto hit = mesh.first_hit(center, -normal);
    if (!hit || hit->normal.dot(normal) < kFacing) return std::nullopt;
    const auto& marks = mesh.mesh().triangle_marks;
    if (!marks.empty() && marks[hit->triangle] == Mark::Synthesized) return std::nullopt;
    // What is left before belongs to another side of the part.
    const double below_mm = 0.01 * margin_mm;
    if (reference.first_hit(center - below_mm * normal, -normal, hit->distance - below_mm))
      return std::nullopt;
    return hit->distance;
  }
};

/// Keeps the connected parts of missing patches that are as wide as they are deep.
void keep_wide(const SurfacePatches& patches,
               const std::vector<double>& depth_mm,
               std::vector<std::uint8_t>& missing) {
  std::vector<std::uint8_t> seen(missing.size(), 0);
  for (std::uint32_t first = 0; first < missing.size(); ++first) {
    if (missing[first] == 0 || seen[first] != 0) continue;
    std::vector<std::uint32_t> part{first};
    seen[first] = 1;
    double area_mm2 = 0.0;
    double deepest_mm = 0.0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      area_mm2 += patches.area_mm2[part[next]];
      deepest_mm = std::max(deepest_mm, depth_mm[part[next]]);
      for (const std::uint32_t k : patches.neighbors[part[next]]) {
        if (missing[k] == 0 || seen[k] != 0) continue;
        seen[k] = 1;
        part.push_back(k);
      }
    }
    if (area_mm2 >= deepest_mm * deepest_mm) continue;
    for (const std::uint32_t patch : part)
      missing[patch] = 0;
  }
}

}  // namespace

std::vector<std::uint8_t> missing_patches(const SurfacePatches& patches,
                                          const Mesh& mesh,
                                          const RayScene& reference) {
  std::vector<std::uint8_t> missing(patches.size(), 0);
  std::vector<double> depth_mm(patches.size(), 0.0);  // 0: nothing is missing
  const bool all_measured = [&] {
    for (std::size_t i = 0; i < patches.size(); ++i)
      if (!patches.is_measured(i)) return false;
    return true;
  }();
  if (all_measured) return missing;
  const RayScene scene(mesh);
  // A mesh cuts sharp edges off by the distance of its points, half a diameter.
  const Behind behind{scene, reference, 2.0 * patches.diameter_mm};
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches.is_measured(i)) continue;
    depth_mm[i] =
        behind.depth_mm(patches.center_mm[i].cast<double>(), patches.normal[i].cast<double>())
            .value_or(0.0);
  }
  // A single patch may be the end of a rounded edge: all around it the material must be missing.
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!(depth_mm[i] > 0.0)) continue;
    const auto supports = [&](std::uint32_t k) {
      if (static_cast<double>(patches.normal[i].dot(patches.normal[k])) < kFacing ||
          depth_mm[k] > 0.0)
        return true;
      return static_cast<double>(std::abs(patches.deviation_mm[k])) > behind.margin_mm;
    };
    const auto& around = patches.neighbors[i];
    missing[i] = std::all_of(around.begin(), around.end(), supports) ? 1 : 0;
  }
  keep_wide(patches, depth_mm, missing);
  return missing;
}

}  // namespace frangia::inspect
