#include "frangia/report/internal/feature_places.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"

namespace frangia::report {
namespace {

constexpr int kAround = 8;  // places about an axis

/// Places on the shape itself.
std::vector<PicturedPlace> places_on_shape(const Shape& shape) {
  if (shape.kind == ShapeKind::Plane) return {{shape.center_mm, shape.axis}};
  std::vector<PicturedPlace> places;
  const Eigen::Vector3d across = shape.axis.unitOrthogonal();
  for (int i = 0; i < kAround; ++i) {
    const double turn = kTwoPi * i / kAround;
    const Eigen::Vector3d away = Eigen::AngleAxisd(turn, shape.axis) * across;
    places.push_back({shape.center_mm + shape.radius_mm * away, away});
  }
  return places;
}

}  // namespace

std::vector<PicturedPlace> feature_places(const Mesh& mesh,
                                          const std::vector<Eigen::Vector3f>& normals,
                                          const Shape& shape,
                                          const std::vector<std::uint32_t>& vertices) {
  if (!is_surface(shape.kind)) return places_on_shape(shape);
  struct Candidate {
    double off_mm = 0.0;  // from the middle
    PicturedPlace place;
  };
  std::vector<Candidate> candidates;
  for (const std::uint32_t vertex : vertices) {
    if (vertex >= mesh.vertices_mm.size()) continue;
    const Eigen::Vector3d point = mesh.vertices_mm[vertex].cast<double>();
    const Eigen::Vector3d from = point - shape.center_mm;
    const ShapeDistance distance = distance_to(shape, point);
    // Vertices of a mesh that does not cover the surface are those of samples, anywhere.
    constexpr double kOnShape = 0.02;
    if (!distance.normal.allFinite() || std::abs(distance.distance_mm) > kOnShape * from.norm())
      continue;
    const double along = from.dot(shape.axis);
    const double off = shape.kind == ShapeKind::Plane    ? from.norm()
                       : shape.kind == ShapeKind::Sphere ? 0.0
                                                         : std::abs(along);
    // Of the shape, because that of a vertex at an edge also leans to the next surface; outward.
    const bool inside_out = normals[vertex].cast<double>().dot(distance.normal) < 0.0;
    candidates.push_back({off, {point, inside_out ? -distance.normal : distance.normal}});
  }
  if (candidates.empty()) return places_on_shape(shape);
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.off_mm < b.off_mm;
  });
  // Those next to the middle lie all around an axis; of a sphere any.
  constexpr std::size_t kNear = 96;
  constexpr std::size_t kMost = 24;
  const std::size_t near =
      shape.kind == ShapeKind::Sphere ? candidates.size() : std::min(kNear, candidates.size());
  const std::size_t step = std::max<std::size_t>(1, near / kMost);
  std::vector<PicturedPlace> places;
  for (std::size_t i = 0; i < near; i += step)
    places.push_back(candidates[i].place);
  return places;
}

}  // namespace frangia::report
