#include "frangia/inspect/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/surface_samples.h"
#include "frangia/inspect/internal/edge_strips.h"
#include "frangia/inspect/internal/missing_patches.h"
#include "frangia/inspect/internal/patch_filter.h"
#include "frangia/inspect/internal/patch_grid.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using inspect::EdgeStrips;
using inspect::kSameFace;
using inspect::kSameSide;
using inspect::PatchFilter;
using inspect::PatchGrid;
using inspect::PatchMean;

constexpr double kMeasuredShare = 0.25;  // of a patch; vertices at sharp edges are left out
constexpr std::size_t kMostPatches = 400'000;
/// Of the reference's size: a mesh that was decimated has triangles larger than its features, and
/// its flat faces are measured between their corners, too. Patches of less than two distances of
/// the vertices hold single ones, whose noise nothing averages.
constexpr double kLargestPatch = 0.04;
constexpr double kLargestStrip = 0.01;  // as `kLargestPatch`
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

bool is_excluded(const Vector3d& point, const std::vector<ExcludedBox>& excluded) {
  return std::any_of(excluded.begin(), excluded.end(), [&](const ExcludedBox& box) {
    return (point.array() >= box.min_mm.array()).all() &&
           (point.array() <= box.max_mm.array()).all();
  });
}

/// How much more the means of patches near each other differ than independent noise explains.
/// Neighboring vertices share pixels, so that their errors are alike: in a mesh that fusion
/// samples, by 0.7 at a spacing, 0.3 at two and less than 0.1 at three, which the patches must be
/// apart.
double noise_factor_of(const SurfacePatches& patches, const PatchGrid& grid, double spacing_mm) {
  constexpr double kAlike = 3.0;       // spacings over which errors are alike
  constexpr double kLargestGap = 2.0;  // diameters; triangles may be larger than patches
  const double nearest_mm =
      patches.diameter_mm + std::min(kAlike * spacing_mm, kLargestGap * patches.diameter_mm);
  const double farthest_mm = nearest_mm + 0.5 * patches.diameter_mm;
  std::vector<double> ratios;
  const auto counts = [&](std::size_t i) {
    return patches.is_measured(i) && patches.at_edge[i] == 0;
  };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!counts(i) || !(patches.noise_mm[i] > 0.0F)) continue;
    std::optional<double> ratio;
    grid.within(patches.center_mm[i], farthest_mm, [&](std::uint32_t k, float d2) {
      const bool apart = static_cast<double>(d2) >= nearest_mm * nearest_mm;
      if (ratio || k <= i || !apart || !counts(k)) return;
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

/// How much the errors of the points in a patch are alike, from 0 to 1: the mean correlation of two
/// of them, by which their scatter about the mean falls short of what independent noise makes. The
/// median over the patches, because the form of the surface scatters them, too.
double correlation_of(const SurfacePatches& patches,
                      const std::vector<std::optional<PatchMean>>& means) {
  constexpr double kMostOfOne = 0.5;         // weight of a point: two points and more
  constexpr double kErrorOfMedian = 1.2533;  // over that of the mean
  std::vector<double> ratios;
  double area_mm2 = 0.0;
  double variance = 0.0;  // of a ratio, summed
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!means[i] || patches.at_edge[i] != 0 || !(means[i]->one_point_mm > 0.0)) continue;
    const double one = means[i]->point_share;
    if (one > kMostOfOne) continue;
    const double freedom = 1.0 / one - 1.0;
    const double expected = means[i]->one_point_mm * means[i]->one_point_mm * (1.0 - one);
    // The median of chi squared over its degrees of freedom (Wilson and Hilferty).
    const double median = std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
    ratios.push_back(means[i]->scatter_mm2 / (expected * median));
    area_mm2 += patches.area_mm2[i];
    variance += 2.0 / freedom;
  }
  if (ratios.empty()) return 0.0;
  // As many patches are independent as fit beside each other.
  const double disk = 0.25 * std::numbers::pi * patches.diameter_mm * patches.diameter_mm;
  const double independent = std::max(1.0, area_mm2 / disk);
  const double sigma =
      kErrorOfMedian * std::sqrt(variance / static_cast<double>(ratios.size()) / independent);
  const double short_by = 1.0 - median_in_place(std::span<double>(ratios));
  return std::clamp(short_by - 2.0 * sigma, 0.0, 1.0);  // what is not significant is not counted
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

double default_edge_mm(const Mesh& mesh, const Mesh& reference) {
  constexpr std::size_t kSamples = 4000;
  constexpr double kMostInStrips = 0.25;  // of the area
  constexpr int kMostHalvings = 6;
  double width_mm =
      std::min(0.5 * default_feature_mm(mesh), kLargestStrip * diagonal_of(reference));
  const auto samples = sample_surface(reference, kSamples);
  for (int i = 0; i < kMostHalvings; ++i) {
    const EdgeStrips strips(reference, width_mm);
    const auto held = std::count_if(samples.begin(), samples.end(), [&](const auto& sample) {
      return strips.hold(sample.point_mm.template cast<float>(),
                         sample.normal.template cast<float>());
    });
    if (static_cast<double>(held) <= kMostInStrips * static_cast<double>(samples.size()))
      return width_mm;
    width_mm *= 0.5;
  }
  return 0.0;
}

SurfacePatches surface_patches(const Mesh& mesh,
                               const Deviations& deviations,
                               const RayScene& reference,
                               double diameter_mm,
                               const std::vector<ExcludedBox>& excluded,
                               double edge_mm,
                               const Run& run) {
  run.stage("patches");
  const double wanted = diameter_mm > 0.0 ? diameter_mm
                                          : std::min(default_feature_mm(mesh),
                                                     kLargestPatch * diagonal_of(reference.mesh()));
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
  const EdgeStrips strips(reference.mesh(), edge_mm);
  std::vector<std::uint8_t> kept(samples.size(), 0);
  std::vector<std::uint8_t> in_strip(samples.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector3f point = samples[i].point_mm.cast<float>();
    const Vector3f normal = samples[i].normal.cast<float>();
    box.extend(samples[i].point_mm);
    if (is_excluded(samples[i].point_mm, excluded)) continue;
    kept[i] = 1;
    in_strip[i] = strips.hold(point, normal) ? 1 : 0;
    bool free = true;
    grid.within(point, 0.5 * patches.diameter_mm, [&](std::uint32_t k, float) {
      free = free && normal.dot(patches.normal[k]) < kSameFace;
    });
    if (!free) continue;
    grid.add(point);
    patches.center_mm.push_back(point);
    patches.normal.push_back(normal);
    patches.at_edge.push_back(in_strip[i]);
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
      if (in_strip[i] != 0 && patches.at_edge[k] == 0) return;
      inside[k] += sample_area;
      if (in_strip[i] == patches.at_edge[k] && squared < least) {
        least = squared;
        best = k;
      }
    };
    grid.within(samples[i].point_mm.cast<float>(), 0.5 * patches.diameter_mm, visit);
    if (in_strip[i] != 0) patches.edge_area_mm2 += sample_area;
    if (in_strip[i] != 0 || !std::isfinite(least)) continue;
    patches.area_mm2[best] += sample_area;
    patches.total_area_mm2 += sample_area;
  }
  require(patches.total_area_mm2 > 0.0,
          "all of the reference lies in strips along its edges; state a smaller edge_mm");
  patches.deviation_mm.assign(patch_count, kMissing);
  patches.noise_mm.assign(patch_count, 0.0F);
  patches.systematic_mm.assign(patch_count, 0.0F);
  const PatchFilter filter(mesh, deviations, reference, grid, patches, strips, run);
  std::vector<std::optional<PatchMean>> means(patch_count);
  run.check();
  for (std::size_t i = 0; i < patch_count; ++i) {
    const auto [mean, area_mm2] = filter.average(i);
    // A ball holds as much of a plane or a sphere through its center as a disk of its diameter:
    // what the samples count beyond that is their scatter, of three samples of nine.
    if (!(area_mm2 > 0.0 && area_mm2 >= kMeasuredShare * std::min(inside[i], disk))) continue;
    means[i] = mean;
    patches.deviation_mm[i] = static_cast<float>(means[i]->deviation_mm);
    patches.noise_mm[i] = static_cast<float>(means[i]->noise_mm);
    patches.systematic_mm[i] = static_cast<float>(means[i]->systematic_mm);
  }
  if (patches.uncertainty_known) {
    // What the points in a patch share shows in their scatter; what is beyond the stated noise, in
    // the differences of patches.
    const double shared = correlation_of(patches, means);
    for (std::size_t i = 0; i < patch_count; ++i) {
      if (!means[i]) continue;
      const double apart2 = means[i]->noise_mm * means[i]->noise_mm;
      const double alike2 = std::max(0.0, std::pow(means[i]->one_point_mm, 2) - apart2);
      patches.noise_mm[i] = static_cast<float>(std::sqrt(apart2 + shared * alike2));
    }
    patches.noise_factor = noise_factor_of(patches, grid, 0.5 * default_feature_mm(mesh));
    const double more = std::sqrt(patches.noise_factor);
    for (std::size_t i = 0; i < patch_count; ++i) {
      if (!means[i]) continue;
      const auto noise = static_cast<double>(patches.noise_mm[i]);
      patches.noise_mm[i] = static_cast<float>(std::hypot(
          std::max(noise, std::min(more * noise, means[i]->one_point_mm)), means[i]->place_mm));
    }
  }
  find_neighbors(patches, grid);
  patches.missing = inspect::missing_patches(patches, mesh, deviations, reference, run);
  return patches;
}

}  // namespace frangia
