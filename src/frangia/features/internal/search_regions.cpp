#include "frangia/features/internal/search_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/internal/shapes_from_normals.h"

namespace frangia {
namespace {

constexpr std::size_t kSmallPatch = 30;  ///< cells of the patches that suggest shapes
constexpr std::size_t kLargePatch = 120;
constexpr std::size_t kLeastPatch = 9;
constexpr std::size_t kLeastCells = 12;   ///< of a region
constexpr double kPatchScatter = 3.0;     ///< a patch that scatters more about its shape has none
constexpr double kGateFactor = 4.5;       ///< gate of the growth, as a multiple of the scatter
constexpr double kParameterCost = 0.015;  ///< of a region's size, for each parameter of the shape
constexpr int kSearchRounds = 6;

FeaturePoints points_of_cells(const FeaturePoints& points, const SurfaceCells& cells) {
  FeaturePoints own;
  own.points_mm = cells.points_mm;
  own.normals = cells.normals;
  own.area_mm2 = points.area_mm2;
  return own;
}

/// Regions are compared by their size, less a share for each parameter.
double score_of(const ShapeRegion& region) {
  return static_cast<double>(region.cells.size()) *
         (1.0 - kParameterCost * parameter_count(region.shape.kind));
}

/// The shapes that a patch lies on, with the patch as their region.
std::vector<ShapeRegion> suggest(const std::vector<std::uint32_t>& patch,
                                 const SurfaceCells& cells,
                                 const FeaturePoints& cell_points) {
  std::vector<ShapeRegion> suggested;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  for (const std::uint32_t cell : patch) {
    points.push_back(cells.points_mm[cell]);
    normals.push_back(cells.normals[cell]);
  }
  for (const Shape& shape : shapes_from_normals(points, normals)) {
    const ShapeFit fit =
        fit_shape(cell_points,
                  patch,
                  shape,
                  {.gate_mm = cells.edge_mm, .robust = true, .max_iterations = 12});
    const bool kept = fit.converged && 10 * fit.points >= 8 * patch.size();
    if (!kept) continue;
    ShapeRegion region{fit.shape, side_of(fit.shape, cells, patch), fit.rms_mm, patch};
    suggested.push_back(std::move(region));
  }
  return suggested;
}

class RegionSearch {
 public:
  RegionSearch(const FeaturePoints& points,
               const SurfaceCells& cells,
               const FindFeaturesOptions& options,
               const Run& run)
      : cells_(cells),
        cell_points_(points_of_cells(points, cells)),
        options_(options),
        run_(run),
        available_(cells.size(), 1) {
    least_cells_ = std::max(
        kLeastCells,
        static_cast<std::size_t>(options.least_area_share * static_cast<double>(cells.size())));
  }

  FoundRegions search() {
    FoundRegions found = begun();
    for (int round = 0; round < kSearchRounds; ++round) {
      run_.report(0.8 * round / kSearchRounds);
      std::vector<ShapeRegion> candidates = candidates_of(seeds_of(round));
      const std::size_t before = found.regions.size();
      accept(std::move(candidates), found.regions);
      if (found.regions.size() == before && round > 0) break;
    }
    return found;
  }

  FoundRegions at(std::span<const FeaturePlace> places) {
    FoundRegions found = begun();
    RegionGrower grower(cells_, cell_points_);
    for (const FeaturePlace& place : places) {
      ShapeRegion there;
      for (const std::uint32_t seed : cells_at(place)) {
        run_.check();
        const auto region = best_at(seed, grower);
        if (!region || region->cells.size() < kLeastCells) continue;
        there = *region;
        break;
      }
      found.regions.push_back(std::move(there));
    }
    return found;
  }

 private:
  /// Without regions, and with the gate by which they grow.
  FoundRegions begun() {
    scatter_mm_ = measure_scatter();
    limits_.gate_mm = options_.gate_mm > 0.0 ? options_.gate_mm : kGateFactor * scatter_mm_;
    FoundRegions found;
    found.gate_mm = limits_.gate_mm;
    return found;
  }

  /// The cells of the side of the surface that faces alike, the nearest first: the one that is
  /// pointed at may be cut by an edge.
  [[nodiscard]] std::vector<std::uint32_t> cells_at(const FeaturePlace& place) const {
    constexpr double kAlike = 0.7;     // cosine: 45 degrees
    constexpr double kFarthest = 3.0;  // in edges of a cell
    constexpr std::size_t kTried = 6;
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
      if (cells_.normals[cell].dot(place.normal) < kAlike) continue;
      const double away = (cells_.points_mm[cell] - place.point_mm).norm();
      if (away < kFarthest * cells_.edge_mm) near.emplace_back(away, cell);
    }
    std::sort(near.begin(), near.end());
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < std::min(kTried, near.size()); ++i)
      cells.push_back(near[i].second);
    return cells;
  }

  [[nodiscard]] std::vector<std::uint32_t> seeds_of(int round) const {
    std::vector<std::uint32_t> free;
    for (std::uint32_t cell = 0; cell < cells_.size(); ++cell)
      if (available_[cell] != 0) free.push_back(cell);
    std::vector<std::uint32_t> seeds;
    const std::size_t count = std::min(options_.seeds, free.size());
    for (std::size_t i = 0; i < count; ++i) {  // one in each of as many equal parts
      const auto random = uniform_from(hash(hash(static_cast<std::uint64_t>(round)), i));
      const double place = (static_cast<double>(i) + random) / static_cast<double>(count);
      seeds.push_back(free[static_cast<std::size_t>(place * static_cast<double>(free.size()))]);
    }
    return seeds;
  }

  /// The usual scatter of the cells about the shapes that suit their patches best.
  double measure_scatter() {
    const std::vector<std::uint32_t> seeds = seeds_of(-1);
    std::vector<double> scatter(seeds.size(), std::numeric_limits<double>::infinity());
    interruptible_chunks(seeds.size(), 4, run_, [&](std::size_t begin, std::size_t end) {
      RegionGrower grower(cells_, cell_points_);
      for (std::size_t i = begin; i < end; ++i) {
        const auto patch = grower.patch(seeds[i], kSmallPatch, available_);
        if (patch.size() < kLeastPatch) continue;
        for (const ShapeRegion& region : suggest(patch, cells_, cell_points_))
          scatter[i] = std::min(scatter[i], region.rms_mm);
      }
    });
    std::sort(scatter.begin(), scatter.end());
    const double usual = scatter.empty() ? 0.0 : scatter[scatter.size() / 3];
    // The chords of a tessellated model are off by about this share of a cell.
    constexpr double kLeastScatter = 2e-3;
    return std::max(std::isfinite(usual) ? usual : 0.0, kLeastScatter * cells_.edge_mm);
  }

  [[nodiscard]] std::optional<ShapeRegion> best_at(std::uint32_t seed, RegionGrower& grower) const {
    std::vector<ShapeRegion> grown;
    for (const std::size_t size : {kSmallPatch, kLargePatch}) {
      const auto patch = grower.patch(seed, size, available_);
      if (patch.size() < kLeastPatch) continue;
      for (const ShapeRegion& region : suggest(patch, cells_, cell_points_)) {
        if (region.rms_mm > kPatchScatter * scatter_mm_) continue;
        grown.push_back(grower.grow(region, limits_, available_));
      }
    }
    const auto larger = [](const ShapeRegion& a, const ShapeRegion& b) {
      return score_of(a) > score_of(b);
    };
    std::stable_sort(grown.begin(), grown.end(), larger);
    constexpr std::size_t kRefined = 3;
    std::optional<ShapeRegion> best;
    for (std::size_t i = 0; i < std::min(kRefined, grown.size()); ++i) {
      ShapeRegion region = grower.settle(std::move(grown[i]), limits_, available_);
      if (!best || score_of(region) > score_of(*best)) best = std::move(region);
    }
    return best;
  }

  [[nodiscard]] std::vector<ShapeRegion> candidates_of(const std::vector<std::uint32_t>& seeds) {
    std::vector<std::optional<ShapeRegion>> best(seeds.size());
    interruptible_chunks(seeds.size(), 4, run_, [&](std::size_t begin, std::size_t end) {
      RegionGrower grower(cells_, cell_points_);
      for (std::size_t i = begin; i < end; ++i)
        best[i] = best_at(seeds[i], grower);
    });
    std::vector<ShapeRegion> candidates;
    for (auto& region : best)
      if (region && region->cells.size() >= least_cells_) candidates.push_back(std::move(*region));
    return candidates;
  }

  /// Takes the largest candidate, and then the largest of what the others have left.
  void accept(std::vector<ShapeRegion> candidates, std::vector<ShapeRegion>& accepted) {
    RegionGrower grower(cells_, cell_points_);
    const auto smaller = [](const ShapeRegion& a, const ShapeRegion& b) {
      return score_of(a) < score_of(b);
    };
    std::stable_sort(candidates.begin(), candidates.end(), smaller);
    while (!candidates.empty()) {
      run_.check();
      ShapeRegion region = std::move(candidates.back());
      candidates.pop_back();
      if (!is_free(region)) {
        region = grower.grow(region, limits_, available_, true);
        if (region.cells.size() < least_cells_) continue;
        region = grower.settle(std::move(region), limits_, available_);
        if (region.cells.size() < least_cells_) continue;
        candidates.insert(std::upper_bound(candidates.begin(), candidates.end(), region, smaller),
                          region);
        continue;
      }
      for (const std::uint32_t cell : region.cells)
        available_[cell] = 0;
      accepted.push_back(std::move(region));
    }
  }

  [[nodiscard]] bool is_free(const ShapeRegion& region) const {
    return std::all_of(
        region.cells.begin(), region.cells.end(), [&](auto cell) { return available_[cell] != 0; });
  }

  const SurfaceCells& cells_;
  FeaturePoints cell_points_;
  const FindFeaturesOptions& options_;
  const Run& run_;
  std::vector<std::uint8_t> available_;
  GrowLimits limits_;
  std::size_t least_cells_ = 0;
  double scatter_mm_ = 0.0;
};

}  // namespace

FoundRegions search_regions(const FeaturePoints& points,
                            const SurfaceCells& cells,
                            const FindFeaturesOptions& options,
                            const Run& run) {
  return RegionSearch(points, cells, options, run).search();
}

FoundRegions regions_at(const FeaturePoints& points,
                        const SurfaceCells& cells,
                        std::span<const FeaturePlace> places,
                        const FindFeaturesOptions& options,
                        const Run& run) {
  return RegionSearch(points, cells, options, run).at(places);
}

}  // namespace frangia
