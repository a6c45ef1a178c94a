#include "frangia/inspect/surface_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/core/missing.h"
#include "frangia/geometry/sample_surface.h"
#include "frangia/inspect/internal/patch_grid.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using inspect::PatchGrid;

constexpr float kSameFace = 0.3F;        // cosine: surfaces that differ by less are one face
constexpr float kSameSide = -0.2F;       // cosine: as the limit of DeviationStatus::OtherSide
constexpr double kMeasuredShare = 0.25;  // of a patch; vertices at sharp edges are left out
constexpr std::size_t kMostPatches = 400'000;
/// Of the reference's size: a mesh that was decimated has triangles larger than its features, and
/// its flat faces are measured between their corners, too.
constexpr double kLargestShare = 0.02;
constexpr double kSamplesPerPatch = 9.0;

double diagonal_of(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vector3f& vertex : mesh.vertices_mm)
    box.extend(vertex);
  return static_cast<double>(box.diagonal().norm());
}

double area_of(const Mesh& mesh) {
  const std::vector<double> areas = vertex_areas(mesh);
  double sum = 0.0;
  for (const double area : areas)
    sum += area;
  return sum;
}

/// A measured point on the nominal surface: a vertex, or a part of a large triangle.
struct MeasuredPoint {
  Vector3f foot;
  Vector3f normal;
  double area_mm2 = 0.0;
  std::array<std::pair<std::uint32_t, float>, 3> vertices;  ///< with their weights
};

/// What was measured in a patch, mm.
struct PatchMean {
  double deviation_mm = 0.0;
  double noise_mm = 0.0;       ///< of independent vertices
  double one_vertex_mm = 0.0;  ///< noise of a vertex: the most that vertices which err alike have
  double systematic_mm = 0.0;
};

/// Adds the area of the measured points of a mesh to the patches that they lie in.
class PatchFilter {
 public:
  PatchFilter(const Mesh& mesh,
              const Deviations& deviations,
              const PatchGrid& grid,
              const SurfacePatches& patches)
      : mesh_(mesh),
        deviations_(deviations),
        grid_(grid),
        patches_(patches),
        normals_(vertex_normals(mesh)),
        weights_(patches.size()) {}

  void add_all() {
    std::vector<double> thirds(mesh_.vertices_mm.size(), 0.0);
    for (const auto& triangle : mesh_.triangles)
      add_triangle(triangle, thirds);
    for (std::uint32_t v = 0; v < thirds.size(); ++v) {
      if (!(thirds[v] > 0.0)) continue;
      add({deviations_.foot_mm[v], facing(v), thirds[v], {{{v, 1.0F}, {v, 0.0F}, {v, 0.0F}}}});
    }
  }

  /// Area of the compared surface in a patch, mm2.
  [[nodiscard]] double area(std::size_t patch) const {
    double sum = 0.0;
    for (const auto& [vertex, weight] : weights_[patch])
      sum += weight;
    return sum;
  }

  [[nodiscard]] PatchMean average(std::size_t patch) {
    auto& weights = weights_[patch];
    std::sort(weights.begin(), weights.end());
    const double total = area(patch);
    PatchMean mean;
    double squares = 0.0;
    for (std::size_t i = 0; i < weights.size();) {
      const std::uint32_t vertex = weights[i].first;
      double weight = 0.0;
      for (; i < weights.size() && weights[i].first == vertex; ++i)
        weight += weights[i].second / total;
      mean.deviation_mm += weight * static_cast<double>(deviations_.deviation_mm[vertex]);
      if (deviations_.u_mm.empty()) continue;
      const auto u = static_cast<double>(deviations_.u_mm[vertex]);
      const double noise = std::min(u, noise_of(vertex));
      squares += weight * weight * noise * noise;
      mean.one_vertex_mm += weight * noise;
      mean.systematic_mm += weight * std::sqrt(std::max(0.0, u * u - noise * noise));
    }
    mean.noise_mm = std::sqrt(squares);
    return mean;
  }

 private:
  [[nodiscard]] bool is_compared(std::uint32_t vertex) const {
    return deviations_.status[vertex] == DeviationStatus::Compared;
  }
  [[nodiscard]] double noise_of(std::uint32_t vertex) const {
    const auto& noise = mesh_.sigma_noise_mm.empty() ? mesh_.sigma_mm : mesh_.sigma_noise_mm;
    return static_cast<double>(noise[vertex]);
  }

  /// Normal of the nominal surface at the foot of a vertex.
  [[nodiscard]] Vector3f facing(std::uint32_t vertex) const {
    const float deviation = deviations_.deviation_mm[vertex];
    if (static_cast<double>(std::abs(deviation)) < 1e-2 * patches_.diameter_mm)
      return normals_[vertex];
    return ((mesh_.vertices_mm[vertex] - deviations_.foot_mm[vertex]) / deviation).normalized();
  }

  void add_triangle(const Mesh::Triangle& triangle, std::vector<double>& thirds) {
    std::array<Vector3f, 3> at;
    int compared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      at.at(i) = mesh_.vertices_mm[triangle.at(i)];
      compared += is_compared(triangle.at(i)) ? 1 : 0;
    }
    if (compared == 0) return;
    const auto area = 0.5 * static_cast<double>((at[1] - at[0]).cross(at[2] - at[0]).norm());
    const float longest =
        std::max({(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()});
    const double step = patches_.diameter_mm;
    if (compared < 3 || static_cast<double>(longest) <= step) {
      for (const std::uint32_t v : triangle)
        if (is_compared(v)) thirds[v] += area / 3.0;
      return;
    }
    constexpr double kMostParts = 1000.0;  // along an edge
    const int parts = static_cast<int>(
        std::min(kMostParts, std::ceil(2.0 * static_cast<double>(longest) / step)));
    const double share = area / (static_cast<double>(parts) * parts);
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; j < parts - i; ++j) {
        add_part(triangle, (i + 1.0 / 3.0) / parts, (j + 1.0 / 3.0) / parts, share);
        if (j + 1 < parts - i)
          add_part(triangle, (i + 2.0 / 3.0) / parts, (j + 2.0 / 3.0) / parts, share);
      }
    }
  }

  void add_part(const Mesh::Triangle& triangle, double b, double c, double area) {
    const std::array<float, 3> weights{
        static_cast<float>(1.0 - b - c), static_cast<float>(b), static_cast<float>(c)};
    MeasuredPoint point{Vector3f::Zero(), Vector3f::Zero(), area, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      point.foot += weights.at(i) * deviations_.foot_mm[triangle.at(i)];
      point.normal += weights.at(i) * facing(triangle.at(i));
      point.vertices.at(i) = {triangle.at(i), weights.at(i)};
    }
    point.normal.normalize();
    add(point);
  }

  void add(const MeasuredPoint& point) {
    grid_.within(point.foot, 0.5 * patches_.diameter_mm, [&](std::uint32_t patch, float) {
      if (point.normal.dot(patches_.normal[patch]) < kSameFace) return;
      for (const auto& [vertex, weight] : point.vertices)
        if (weight > 0.0F)
          weights_[patch].emplace_back(vertex, static_cast<double>(weight) * point.area_mm2);
    });
  }

  const Mesh& mesh_;
  const Deviations& deviations_;
  const PatchGrid& grid_;
  const SurfacePatches& patches_;
  std::vector<Vector3f> normals_;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> weights_;  ///< vertices of each patch
};

bool is_excluded(const Vector3d& point, const std::vector<ExcludedBox>& excluded) {
  return std::any_of(excluded.begin(), excluded.end(), [&](const ExcludedBox& box) {
    return (point.array() >= box.min_mm.array()).all() &&
           (point.array() <= box.max_mm.array()).all();
  });
}

/// How much more the means of patches beside each other differ than independent noise explains.
/// Neighboring vertices share pixels, so that their errors are alike.
double noise_factor_of(const SurfacePatches& patches, const PatchGrid& grid) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches.is_measured(i) || !(patches.noise_mm[i] > 0.0F)) continue;
    std::optional<double> ratio;
    grid.within(patches.center_mm[i], 1.5 * patches.diameter_mm, [&](std::uint32_t k, float d2) {
      const bool apart = static_cast<double>(d2) >= patches.diameter_mm * patches.diameter_mm;
      if (ratio || k <= i || !apart || !patches.is_measured(k)) return;
      if (patches.normal[i].dot(patches.normal[k]) < 0.95F) return;
      const auto difference =
          static_cast<double>(patches.deviation_mm[i] - patches.deviation_mm[k]);
      const double variance = std::pow(static_cast<double>(patches.noise_mm[i]), 2) +
                              std::pow(static_cast<double>(patches.noise_mm[k]), 2);
      ratio = difference * difference / variance;
    });
    if (ratio) ratios.push_back(*ratio);
  }
  constexpr std::size_t kEnough = 20;
  constexpr double kMedianOfSquare = 0.45494;  // of a normal number's square
  if (ratios.size() < kEnough) return 1.0;
  return std::max(1.0, median_in_place(std::span<double>(ratios)) / kMedianOfSquare);
}

/// Whether measured surface lies inside of the material below a nominal place: it faces the same
/// way, and the nominal surface is not left before. Light passed through the place to reach it.
bool is_missing(const Vector3d& center,
                const Vector3d& normal,
                const RayScene& mesh,
                const RayScene& reference,
                double margin_mm) {
  const auto hit = mesh.first_hit(center - margin_mm * normal, -normal);
  if (!hit || hit->normal.dot(normal) < static_cast<double>(kSameFace)) return false;
  const auto& marks = mesh.mesh().triangle_marks;
  if (!marks.empty() && marks[hit->triangle] == Mark::Synthesized) return false;
  // A wall that is thinner than the margin is left before the ray begins.
  const double below_mm = 0.01 * margin_mm;
  return !reference.first_hit(
      center - below_mm * normal, -normal, margin_mm - below_mm + hit->distance);
}

void mark_missing(SurfacePatches& patches, const Mesh& mesh, const RayScene& reference) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < patches.size(); ++i)
    if (!patches.is_measured(i)) open.push_back(i);
  if (open.empty()) return;
  const RayScene scene(mesh);
  // A mesh cuts sharp edges off by the distance of its points, half a diameter.
  const double margin_mm = 2.0 * patches.diameter_mm;
  std::vector<std::uint8_t> candidate(patches.size(), 0);
  for (const std::uint32_t i : open) {
    const Vector3d center = patches.center_mm[i].cast<double>();
    const Vector3d normal = patches.normal[i].cast<double>();
    candidate[i] = is_missing(center, normal, scene, reference, margin_mm) ? 1 : 0;
  }
  // A single patch may be the end of a rounded edge: all around it the material must be missing.
  for (const std::uint32_t i : open) {
    const auto supports = [&](std::uint32_t k) {
      if (patches.normal[i].dot(patches.normal[k]) < kSameFace || candidate[k] != 0) return true;
      return static_cast<double>(std::abs(patches.deviation_mm[k])) > margin_mm;
    };
    const auto& around = patches.neighbors[i];
    if (candidate[i] != 0 && std::all_of(around.begin(), around.end(), supports))
      patches.missing[i] = 1;
  }
}

void find_neighbors(SurfacePatches& patches, const PatchGrid& grid) {
  patches.neighbors.resize(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    grid.within(patches.center_mm[i], patches.diameter_mm, [&](std::uint32_t k, float) {
      if (k != i && patches.normal[i].dot(patches.normal[k]) >= kSameSide)
        patches.neighbors[i].push_back(k);
    });
  }
}

}  // namespace

bool SurfacePatches::is_measured(std::size_t patch) const {
  return std::isfinite(deviation_mm[patch]);
}

double SurfacePatches::u_mm(std::size_t patch) const {
  return std::hypot(static_cast<double>(noise_mm[patch]),
                    static_cast<double>(systematic_mm[patch]));
}

double default_feature_mm(const Mesh& mesh) {
  std::vector<std::uint8_t> used(mesh.vertices_mm.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      used[v] = 1;
  const auto count = static_cast<double>(std::count(used.begin(), used.end(), 1));
  require(count > 0.0, "the mesh has no triangles, only points; give a mesh with triangles");
  return 2.0 * std::sqrt(area_of(mesh) / count);
}

SurfacePatches surface_patches(const Mesh& mesh,
                               const Deviations& deviations,
                               const RayScene& reference,
                               double diameter_mm,
                               const std::vector<ExcludedBox>& excluded,
                               const Run& run) {
  run.stage("patches");
  const double wanted = diameter_mm > 0.0 ? diameter_mm
                                          : std::min(default_feature_mm(mesh),
                                                     kLargestShare * diagonal_of(reference.mesh()));
  const double nominal_area = area_of(reference.mesh());
  require(nominal_area > 0.0,
          "the reference has no triangles, only points; give a mesh with triangles");
  SurfacePatches patches;
  patches.uncertainty_known = !deviations.u_mm.empty();
  // Centers half a diameter apart stand on about 0.7 squares of that side each.
  constexpr double kAreaOfCenter = 0.17;
  patches.diameter_mm = std::max(
      wanted, std::sqrt(nominal_area / (kAreaOfCenter * static_cast<double>(kMostPatches))));
  const double disk = 0.25 * std::numbers::pi * patches.diameter_mm * patches.diameter_mm;
  const auto count =
      static_cast<std::size_t>(std::max(2000.0, kSamplesPerPatch * nominal_area / disk));
  const auto samples = sample_surface(reference.mesh(), count);
  const double sample_area = nominal_area / static_cast<double>(samples.size());
  Eigen::AlignedBox3d box;
  PatchGrid grid(patches.diameter_mm);
  std::vector<std::uint8_t> kept(samples.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector3f point = samples[i].point_mm.cast<float>();
    const Vector3f normal = samples[i].normal.cast<float>();
    box.extend(samples[i].point_mm);
    if (is_excluded(samples[i].point_mm, excluded)) continue;
    kept[i] = 1;
    bool free = true;
    grid.within(point, 0.5 * patches.diameter_mm, [&](std::uint32_t k, float) {
      free = free && normal.dot(patches.normal[k]) < kSameFace;
    });
    if (!free) continue;
    grid.add(point);
    patches.center_mm.push_back(point);
    patches.normal.push_back(normal);
  }
  require(patches.size() > 0, "the plan excludes all of the reference; make its boxes smaller");
  patches.size_mm = box.diagonal().norm();
  const std::size_t patch_count = patches.size();
  patches.area_mm2.assign(patch_count, 0.0);
  std::vector<double> inside(patch_count, 0.0);  // nominal area within the patch
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (kept[i] == 0) continue;
    const Vector3f normal = samples[i].normal.cast<float>();
    std::uint32_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    const auto visit = [&](std::uint32_t k, float squared) {
      if (normal.dot(patches.normal[k]) < kSameFace) return;
      inside[k] += sample_area;
      if (squared < least) {
        least = squared;
        best = k;
      }
    };
    grid.within(samples[i].point_mm.cast<float>(), 0.5 * patches.diameter_mm, visit);
    if (!std::isfinite(least)) continue;
    patches.area_mm2[best] += sample_area;
    patches.total_area_mm2 += sample_area;
  }
  patches.deviation_mm.assign(patch_count, kMissing);
  patches.noise_mm.assign(patch_count, 0.0F);
  patches.systematic_mm.assign(patch_count, 0.0F);
  patches.missing.assign(patch_count, 0);
  PatchFilter filter(mesh, deviations, grid, patches);
  filter.add_all();
  std::vector<std::optional<PatchMean>> means(patch_count);
  run.check();
  for (std::size_t i = 0; i < patch_count; ++i) {
    if (filter.area(i) >= kMeasuredShare * inside[i] && filter.area(i) > 0.0)
      means[i] = filter.average(i);
    if (!means[i]) continue;
    patches.deviation_mm[i] = static_cast<float>(means[i]->deviation_mm);
    patches.noise_mm[i] = static_cast<float>(means[i]->noise_mm);
    patches.systematic_mm[i] = static_cast<float>(means[i]->systematic_mm);
  }
  if (patches.uncertainty_known) {
    patches.noise_factor = noise_factor_of(patches, grid);
    const double alike = std::sqrt(patches.noise_factor);
    for (std::size_t i = 0; i < patch_count; ++i) {
      if (!means[i]) continue;
      patches.noise_mm[i] =
          static_cast<float>(std::min(alike * means[i]->noise_mm, means[i]->one_vertex_mm));
    }
  }
  find_neighbors(patches, grid);
  mark_missing(patches, mesh, reference);
  return patches;
}

}  // namespace frangia
