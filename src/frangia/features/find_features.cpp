#include "frangia/features/find_features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/features/internal/refine_feature.h"
#include "frangia/features/internal/search_regions.h"
#include "frangia/features/internal/surface_cells.h"

namespace frangia {

namespace {

/// A surface that was found, with its region.
struct FoundSurface {
  Feature feature;
  ShapeRegion region;
};

using Eigen::Vector3d;

constexpr double kReach = 2.5;  ///< of a cell from the edge that it lies at, in cells

/// The cells of a region near a curve.
template <typename DistanceTo>
std::vector<std::uint32_t> cells_near(const ShapeRegion& region,
                                      const SurfaceCells& cells,
                                      const DistanceTo& distance_to_edge) {
  std::vector<std::uint32_t> near;
  for (const std::uint32_t cell : region.cells)
    if (distance_to_edge(cells.points_mm[cell]) < kReach * cells.edge_mm) near.push_back(cell);
  return near;
}

/// Fills in what a constructed element has: the number of points near it on both surfaces, and an
/// uncertainty.
Feature edge_feature(const Shape& shape, std::size_t points, double u95_mm) {
  Feature feature;
  feature.fit.shape = shape;
  feature.fit.converged = true;
  feature.fit.points = points;
  feature.uncertainty.is_known = std::isfinite(u95_mm);
  feature.uncertainty.u95_mm = u95_mm;
  return feature;
}

std::size_t points_in(const std::vector<std::uint32_t>& chosen, const SurfaceCells& cells) {
  std::size_t count = 0;
  for (const std::uint32_t cell : chosen)
    count += cells.points_of(cell).size();
  return count;
}

constexpr std::size_t kLeastEdgeCells = 4;  ///< of each surface along an edge

std::optional<Feature> line_of(const FoundSurface& a,
                               const FoundSurface& b,
                               const SurfaceCells& cells) {
  const Shape& first = a.feature.fit.shape;
  const Shape& second = b.feature.fit.shape;
  Shape line{ShapeKind::Line};
  const Vector3d along = first.axis.cross(second.axis);
  constexpr double kLeastSine = 0.1;  // flatter edges have no certain place
  if (along.norm() < kLeastSine) return std::nullopt;
  line.axis = along.normalized();
  Eigen::Matrix3d planes;
  planes << first.axis.transpose(), second.axis.transpose(), line.axis.transpose();
  const Vector3d offsets(first.axis.dot(first.center_mm), second.axis.dot(second.center_mm), 0.0);
  line.center_mm = planes.inverse() * offsets;
  const auto distance = [&](const Vector3d& point) {
    const Vector3d from = point - line.center_mm;
    return (from - from.dot(line.axis) * line.axis).norm();
  };
  const auto near_a = cells_near(a.region, cells, distance);
  const auto near_b = cells_near(b.region, cells, distance);
  if (std::min(near_a.size(), near_b.size()) < kLeastEdgeCells) return std::nullopt;
  const auto middle_of = [&](const std::vector<std::uint32_t>& near) {
    Eigen::AlignedBox<double, 1> range;
    for (const std::uint32_t cell : near) {
      range.extend(
          Eigen::Matrix<double, 1, 1>((cells.points_mm[cell] - line.center_mm).dot(line.axis)));
    }
    return range;
  };
  const auto both = middle_of(near_a).intersection(middle_of(near_b));
  if (both.isEmpty()) return std::nullopt;
  line.center_mm += both.center()[0] * line.axis;
  // The planes' offsets move the line across both; an acute edge moves farther.
  const double u95 =
      std::hypot(a.feature.uncertainty.u95_mm, b.feature.uncertainty.u95_mm) / along.norm();
  return edge_feature(line, points_in(near_a, cells) + points_in(near_b, cells), u95);
}

std::optional<Feature> circle_of(const FoundSurface& plane,
                                 const FoundSurface& round,
                                 const SurfaceCells& cells) {
  const Shape& flat = plane.feature.fit.shape;
  const Shape& shape = round.feature.fit.shape;
  const double cosine = flat.axis.dot(shape.axis);
  constexpr double kMostTilt_rad = 0.02;  // beyond, the edge is an ellipse
  if (std::abs(cosine) < std::cos(kMostTilt_rad)) return std::nullopt;
  Shape circle{ShapeKind::Circle};
  const double along = (flat.center_mm - shape.center_mm).dot(flat.axis) / cosine;
  circle.center_mm = shape.center_mm + along * shape.axis;
  circle.axis = shape.axis;
  const double slope = shape.kind == ShapeKind::Cone ? std::tan(shape.half_angle_rad) : 0.0;
  circle.radius_mm = shape.radius_mm + slope * along;
  if (!(circle.radius_mm > 0.0)) return std::nullopt;
  const auto distance = [&](const Vector3d& point) {
    const Vector3d from = point - circle.center_mm;
    const double height = from.dot(circle.axis);
    return std::hypot((from - height * circle.axis).norm() - circle.radius_mm, height);
  };
  const auto near_flat = cells_near(plane.region, cells, distance);
  const auto near_round = cells_near(round.region, cells, distance);
  if (std::min(near_flat.size(), near_round.size()) < kLeastEdgeCells) return std::nullopt;
  // The size of a cylinder is that of its edge; on a cone it grows with the place of the plane.
  const double by_place = 2.0 * std::abs(slope) * plane.feature.uncertainty.u95_mm;
  const double angle = round.feature.uncertainty.angle_u95_rad;
  const double by_angle =
      shape.kind == ShapeKind::Cone ? 2.0 * along * angle * (1.0 + slope * slope) : 0.0;
  const double u95 = std::sqrt(std::pow(round.feature.uncertainty.u95_mm, 2) + by_place * by_place +
                               by_angle * by_angle);
  return edge_feature(circle, points_in(near_flat, cells) + points_in(near_round, cells), u95);
}

/// The lines in which two planes meet, and the circles in which a plane meets a cylinder or a cone
/// about its normal. They are computed from the two surfaces, whose regions touch; the rounded edge
/// itself is not fitted.
std::vector<Feature> edge_features(const std::vector<FoundSurface>& surfaces,
                                   const SurfaceCells& cells) {
  std::vector<Feature> edges;
  const auto kind_of = [](const FoundSurface& surface) { return surface.feature.fit.shape.kind; };
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (std::size_t k = i + 1; k < surfaces.size(); ++k) {
      const FoundSurface* first = &surfaces[i];
      const FoundSurface* second = &surfaces[k];
      if (kind_of(*first) != ShapeKind::Plane) std::swap(first, second);
      if (kind_of(*first) != ShapeKind::Plane) continue;
      std::optional<Feature> edge;
      if (kind_of(*second) == ShapeKind::Plane) edge = line_of(*first, *second, cells);
      if (kind_of(*second) == ShapeKind::Cylinder || kind_of(*second) == ShapeKind::Cone)
        edge = circle_of(*first, *second, cells);
      if (edge) edges.push_back(std::move(*edge));
    }
  }
  return edges;
}

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
    std::optional<Feature> feature =
        refine_feature(points, cells, region, found.gate_mm, options, run);
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
                           : refine_feature(points, cells, region, found.gate_mm, options, run));
  }
  return features;
}

}  // namespace frangia
