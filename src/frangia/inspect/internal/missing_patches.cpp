#include "frangia/inspect/internal/missing_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/inspect/internal/patch_grid.h"

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

/// Directions evenly over a cone about z: a surface that is inclined by more is hardly measured.
std::vector<Vector3d> directions_of_views() {
  constexpr std::size_t kDirections = 256;
  const double least_cosine = std::cos(75.0 * std::numbers::pi / 180.0);
  const double turn_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));  // the golden angle
  std::vector<Vector3d> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const auto number = static_cast<double>(i);
    const double z = 1.0 - (1.0 - least_cosine) * (number + 0.5) / kDirections;
    const double across = std::sqrt(1.0 - z * z);
    directions.emplace_back(
        across * std::cos(turn_rad * number), across * std::sin(turn_rad * number), z);
  }
  return directions;
}

/// Measured places deep inside of the nominal material.
class Roots {
 public:
  Roots(const SurfacePatches& patches, const RayScene& reference)
      : patches_(patches), reference_(reference), grid_(patches.diameter_mm) {
    for (const Eigen::Vector3f& center : patches.center_mm)
      grid_.add(center);
  }

  /// Vertices that may be such places, at least half a diameter apart.
  [[nodiscard]] std::vector<std::uint32_t> candidates(const Mesh& mesh,
                                                      const Deviations& deviations) const {
    constexpr std::size_t kMost = 20'000;  // each takes up to 256 rays
    std::vector<std::uint32_t> found;
    PatchGrid taken(patches_.diameter_mm);
    for (std::uint32_t v = 0; v < mesh.vertices_mm.size() && found.size() < kMost; ++v) {
      const DeviationStatus status = deviations.status[v];
      const bool deep = status == DeviationStatus::Compared &&
                        static_cast<double>(deviations.deviation_mm[v]) < -patches_.diameter_mm;
      if (!deep && status != DeviationStatus::OtherSide && status != DeviationStatus::TooFar)
        continue;
      bool free = true;
      taken.within(mesh.vertices_mm[v], 0.5 * patches_.diameter_mm, [&](std::uint32_t, float) {
        free = false;
      });
      if (!free) continue;
      taken.add(mesh.vertices_mm[v]);
      found.push_back(v);
    }
    return found;
  }

  /// The patches through which views may have seen a place; none where one of them was measured,
  /// or the place is not inside.
  [[nodiscard]] std::vector<std::uint32_t> passed(const Vector3d& at,
                                                  const Vector3d& normal) const {
    static const std::vector<Vector3d> kDirections = directions_of_views();
    if (reference_.nearest(at, patches_.diameter_mm)) return {};
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
    std::vector<std::uint32_t> all;
    for (const Vector3d& direction : kDirections) {
      const auto patch = open_exit(at, turn * direction);
      if (!patch) return {};
      all.push_back(*patch);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  /// The patch where a ray leaves the material; nothing where it does not, or surface is there.
  [[nodiscard]] std::optional<std::uint32_t> open_exit(const Vector3d& at,
                                                       const Vector3d& direction) const {
    const auto hit = reference_.first_hit(at, direction);
    if (!hit || !(hit->normal.dot(direction) > 0.0)) return std::nullopt;
    const Eigen::Vector3f exit = (at + hit->distance * direction).cast<float>();
    const Eigen::Vector3f facing = hit->normal.cast<float>();
    std::optional<std::uint32_t> nearest;
    float least = std::numeric_limits<float>::infinity();
    grid_.within(exit, patches_.diameter_mm, [&](std::uint32_t k, float squared) {
      if (squared >= least || static_cast<double>(facing.dot(patches_.normal[k])) < kFacing) return;
      least = squared;
      nearest = k;
    });
    return nearest && !is_there(*nearest) ? nearest : std::nullopt;
  }
  /// Whether surface was measured in a patch. What was measured inside of it, such as the root of a
  /// pin below its flank, is another one.
  [[nodiscard]] bool is_there(std::uint32_t patch) const {
    constexpr double kInside = 0.25;  // of the diameter
    return static_cast<double>(patches_.deviation_mm[patch]) > -kInside * patches_.diameter_mm;
  }

  const SurfacePatches& patches_;
  const RayScene& reference_;
  PatchGrid grid_;
};

/// Adds the patches that views have passed which saw surface inside of the material.
void add_passed(const SurfacePatches& patches,
                const Mesh& mesh,
                const Deviations& deviations,
                const RayScene& reference,
                const RayScene& scene,
                double margin_mm,
                std::vector<std::uint8_t>& missing,
                const Run& run) {
  constexpr int kFewestPlaces = 3;  // a single one may be a blunder
  const Roots roots(patches, reference);
  const std::vector<std::uint32_t> places = roots.candidates(mesh, deviations);
  if (places.empty()) return;
  const std::vector<Eigen::Vector3f> normals =
      mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals;
  std::vector<std::vector<std::uint32_t>> passed(places.size());
  interruptible_chunks(places.size(), 16, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      passed[i] = roots.passed(mesh.vertices_mm[places[i]].cast<double>(),
                               normals[places[i]].cast<double>());
    }
  });
  std::vector<int> seen_through(patches.size(), 0);
  for (const auto& some : passed)
    for (const std::uint32_t patch : some)
      ++seen_through[patch];
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (seen_through[i] < kFewestPlaces || missing[i] != 0) continue;
    missing[i] = scene.nearest(patches.center_mm[i].cast<double>(), margin_mm) ? 0 : 1;
  }
}

}  // namespace

std::vector<std::uint8_t> missing_patches(const SurfacePatches& patches,
                                          const Mesh& mesh,
                                          const Deviations& deviations,
                                          const RayScene& reference,
                                          const Run& run) {
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
  add_passed(patches, mesh, deviations, reference, scene, behind.margin_mm, missing, run);
  return missing;
}

}  // namespace frangia::inspect
