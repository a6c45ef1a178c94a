#include "frangia/features/find_features.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/features/internal/edge_features.h"
#include "frangia/features/internal/refine_feature.h"
#include "frangia/features/internal/search_regions.h"

namespace frangia {
namespace {

SurfaceCells cells_of(const FeaturePoints& points,
                      const FindFeaturesOptions& options,
                      const Run& run) {
  constexpr std::size_t kPointsPerCell = 4;
  return surface_cells(
      points, std::clamp(points.size() / kPointsPerCell, std::size_t{100}, options.cells), run);
}

}  // namespace

void FindFeaturesOptions::check() const {
  require(cells >= 100, "FindFeaturesOptions: cells must be at least 100");
  require(seeds >= 1, "FindFeaturesOptions: seeds must be at least 1");
  require(least_area_share >= 0.0 && least_area_share < 1.0,
          "FindFeaturesOptions: least_area_share must be from 0 to below 1");
  require(gate_mm >= 0.0, "FindFeaturesOptions: gate_mm must not be negative");
}

std::vector<Feature> find_features(const Mesh& mesh,
                                   const FindFeaturesOptions& options,
                                   const Run& run) {
  options.check();
  const FeaturePoints points = feature_points_of(mesh, run, options.calibration_mm);
  const SurfaceCells cells = cells_of(points, options, run);
  const FoundRegions found = search_regions(points, cells, options, run);
  std::vector<FoundSurface> surfaces;
  for (const ShapeRegion& region : found.regions) {
    std::optional<Feature> feature = refine_feature(points, cells, region, found.gate_mm, run);
    if (feature) surfaces.push_back({std::move(*feature), region});
  }
  std::vector<Feature> edges;
  if (options.edges) edges = edge_features(surfaces, cells);
  std::vector<Feature> features;
  features.reserve(surfaces.size() + edges.size());
  for (FoundSurface& surface : surfaces)
    features.push_back(std::move(surface.feature));
  std::move(edges.begin(), edges.end(), std::back_inserter(features));
  run.report(1.0);
  return features;
}

std::vector<std::optional<Feature>> features_at(const Mesh& mesh,
                                                std::span<const FeaturePlace> places,
                                                const FindFeaturesOptions& options,
                                                const Run& run) {
  options.check();
  const FeaturePoints points = feature_points_of(mesh, run, options.calibration_mm);
  const SurfaceCells cells = cells_of(points, options, run);
  const FoundRegions found = regions_at(points, cells, places, options, run);
  std::vector<std::optional<Feature>> features;
  for (const ShapeRegion& region : found.regions) {
    features.push_back(region.cells.empty()
                           ? std::nullopt
                           : refine_feature(points, cells, region, found.gate_mm, run));
  }
  return features;
}

}  // namespace frangia
