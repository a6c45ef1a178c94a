#include "frangia/features/internal/refine_feature.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/features/internal/shapes_from_normals.h"

namespace frangia {
namespace {

/// Points of a region.
struct RegionPoints {
  std::vector<std::uint32_t> chosen;  ///< ascending
  bool with_edges = false;            ///< whether those of cells beside the border are among them
};

/// Points of the region's cells. Those of cells beside the border are left out where enough remain:
/// the measurement rounds off edges.
RegionPoints inner_points(const SurfaceCells& cells, const ShapeRegion& region) {
  std::vector<std::uint32_t> inner;
  std::vector<std::uint32_t> all;
  for (const std::uint32_t cell : region.cells) {
    const auto neighbors = cells.neighbors_of(cell);
    const bool inside = std::all_of(neighbors.begin(), neighbors.end(), [&](std::uint32_t other) {
      return std::binary_search(region.cells.begin(), region.cells.end(), other);
    });
    const auto own = cells.points_of(cell);
    all.insert(all.end(), own.begin(), own.end());
    // A cell at a sharp edge has too few neighbours rather than foreign ones.
    constexpr std::size_t kLeastNeighbors = 8;
    if (inside && neighbors.size() >= kLeastNeighbors)
      inner.insert(inner.end(), own.begin(), own.end());
  }
  constexpr double kLeastInner = 0.3;
  const bool enough =
      static_cast<double>(inner.size()) >= kLeastInner * static_cast<double>(all.size());
  RegionPoints points{enough ? std::move(inner) : std::move(all), !enough};
  std::sort(points.chosen.begin(), points.chosen.end());
  return points;
}

/// The fits that compete for some points: of the region's kind and of all others.
std::vector<ShapeFit> competing_fits(const FeaturePoints& points,
                                     const std::vector<std::uint32_t>& chosen,
                                     const Shape& start,
                                     const ShapeFitOptions& options,
                                     const Run& run) {
  std::vector<ShapeFit> fits;
  const ShapeFit own = fit_shape(points, chosen, start, options, run);
  if (own.converged) fits.push_back(own);
  std::vector<Eigen::Vector3d> some_points;
  std::vector<Eigen::Vector3d> some_normals;
  const std::vector<std::uint32_t> some = thinned(chosen, 2000);
  for (const std::uint32_t point : some) {
    some_points.push_back(points.points_mm[point]);
    some_normals.push_back(points.normals[point]);
  }
  for (const Shape& other : shapes_from_normals(some_points, some_normals)) {
    if (other.kind == start.kind) continue;
    const ShapeFit rough =
        fit_shape(points,
                  some,
                  other,
                  {.gate_mm = 20.0 * options.gate_mm, .robust = true, .max_iterations = 15});
    if (!rough.converged) continue;
    const ShapeFit fit = fit_shape(points, chosen, rough.shape, options, run);
    if (fit.converged) fits.push_back(fit);
  }
  return fits;
}

/// In how many directions a surface is curved.
double curved_directions(ShapeKind kind) {
  if (kind == ShapeKind::Plane) return 0.0;
  return kind == ShapeKind::Cylinder || kind == ShapeKind::Cone ? 1.0 : 2.0;
}

/// Whether the points determine the shape: a patch of another surface may look like part of a
/// sphere, but of one of any size.
bool is_determined(const ShapeFit& fit, const ShapeUncertainty& uncertainty) {
  constexpr double kMostUncertain = 0.02;  // of the diameter
  if (fit.shape.kind == ShapeKind::Plane) return std::isfinite(uncertainty.u95_mm);
  return uncertainty.u95_mm < kMostUncertain * 2.0 * fit.shape.radius_mm;
}

/// The fit of a shape that is wanted and fits nearly all points; null: none does.
const ShapeFit* wanted_fit(const std::vector<ShapeFit>& fits,
                           std::size_t points,
                           const FindFeaturesOptions& options) {
  constexpr double kNearlyAll = 0.9;
  if (!options.wanted) return nullptr;
  const auto found = std::find_if(fits.begin(), fits.end(), [&](const ShapeFit& fit) {
    return static_cast<double>(fit.points) >= kNearlyAll * static_cast<double>(points) &&
           options.wanted(fit.shape);
  });
  return found == fits.end() ? nullptr : &*found;
}

}  // namespace

std::optional<Feature> refine_feature(const FeaturePoints& points,
                                      const SurfaceCells& cells,
                                      const ShapeRegion& region,
                                      double gate_mm,
                                      const FindFeaturesOptions& options,
                                      const Run& run) {
  // The rounded edges of a narrow chamfer look like the curvature of a sphere: a further curvature
  // must make the sum of squares smaller by a third.
  constexpr double kRoundedEdges = 0.4;
  const RegionPoints inner = inner_points(cells, region);
  const std::vector<std::uint32_t>& chosen = inner.chosen;
  const std::vector<ShapeFit> fits =
      competing_fits(points, chosen, region.shape, {.gate_mm = gate_mm}, run);
  if (fits.empty()) return std::nullopt;

  // Schwarz's criterion. Residuals of neighbours are alike, so that about 16 points count as one,
  // and form errors limit the number of independent ones on any surface.
  const double independent = std::clamp(static_cast<double>(chosen.size()) / 16.0, 8.0, 400.0);
  // Residuals of a thousandth of the gate decide nothing: those of a tessellated model are
  // rounding.
  const double floor = 1e-6 * gate_mm * gate_mm * static_cast<double>(chosen.size());
  // All fits are compared by one gate: a fit that ignores points must not seem better.
  const auto cost_of = [&](const ShapeFit& fit) {
    double squares = floor;
    for (const std::uint32_t point : chosen) {
      const double r = distance_to(fit.shape, points.points_mm[point]).distance_mm;
      squares += std::min(r * r, gate_mm * gate_mm);
    }
    const double curved = inner.with_edges ? curved_directions(fit.shape.kind) : 0.0;
    return independent * (std::log(squares) + curved * kRoundedEdges) +
           parameter_count(fit.shape.kind) * std::log(independent);
  };
  const ShapeFit* best = &fits.front();
  double best_cost = cost_of(*best);
  for (const ShapeFit& fit : fits) {
    const double cost = cost_of(fit);
    if (cost >= best_cost) continue;
    best = &fit;
    best_cost = cost;
  }
  if (const ShapeFit* wanted = wanted_fit(fits, chosen.size(), options)) best = wanted;
  Feature feature;
  feature.fit = *best;
  feature.uncertainty = shape_uncertainty(points, chosen, *best);
  if (!is_determined(*best, feature.uncertainty)) return std::nullopt;
  feature.uncertainty = known_uncertainty(points, std::move(feature.uncertainty));
  double side = 0.0;
  for (const std::uint32_t point : chosen) {
    const double cosine =
        distance_to(best->shape, points.points_mm[point]).normal.dot(points.normals[point]);
    if (std::isfinite(cosine)) side += cosine;
  }
  feature.hole = side < 0.0 && best->shape.kind != ShapeKind::Plane;
  if (side < 0.0 && best->shape.kind == ShapeKind::Plane)
    feature.fit.shape.axis = -feature.fit.shape.axis;
  for (const std::uint32_t point : chosen)  // a sample where the mesh was sampled
    feature.vertices.push_back(points.vertices.empty() ? point : points.vertices[point]);
  return feature;
}

}  // namespace frangia
