#include "frangia/features/measure_picked.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/features/geometric_tolerance.h"
#include "frangia/geometry/pick_surface.h"
#include "frangia/geometry/surface_extent.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::Input, why);
}

Vector3d normal_at(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3d at = mesh.vertices_mm[a].cast<double>();
  const Vector3d ab = mesh.vertices_mm[b].cast<double>() - at;
  const Vector3d ac = mesh.vertices_mm[c].cast<double>() - at;
  return ab.cross(ac).stableNormalized();
}

/// The largest value of a triangle's corners; NaN where one is not known.
double largest_at(const Mesh& mesh, const std::vector<float>& values, std::uint32_t triangle) {
  if (values.empty()) return kMissing;
  double largest = 0.0;
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    if (!std::isfinite(values[vertex])) return kMissing;
    largest = std::max(largest, static_cast<double>(values[vertex]));
  }
  return largest;
}

PickedElement point_of(const Mesh& mesh, const PickedPlace& place) {
  PickedElement point{.face = false, .point_mm = place.point_mm, .feature = {}};
  Shape& shape = point.feature.fit.shape;
  shape.kind = ShapeKind::Sphere;
  shape.center_mm = place.point_mm;
  const double sigma_mm = largest_at(mesh, mesh.sigma_mm, place.triangle);
  point.feature.uncertainty.center_u95_mm = kNormal95 * sigma_mm;
  return point;
}

std::vector<PickedElement> elements_of(const Mesh& mesh,
                                       std::span<const PickedPlace> places,
                                       const Run& run) {
  std::vector<FeaturePlace> faces;
  for (const PickedPlace& place : places)
    if (place.face) faces.push_back({place.point_mm, normal_at(mesh, place.triangle)});
  std::vector<std::optional<Feature>> found;
  if (!faces.empty()) found = features_at(mesh, faces, {}, run);
  std::vector<PickedElement> elements;
  auto next = found.begin();
  for (const PickedPlace& place : places) {
    if (!place.face) {
      elements.push_back(point_of(mesh, place));
      continue;
    }
    if (!*next) {
      refuse(
          fmt::format("the surface at ({:.2f}, {:.2f}, {:.2f}) is no plane, cylinder, sphere, "
                      "cone or torus; pick a point there, or another face",
                      place.point_mm.x(),
                      place.point_mm.y(),
                      place.point_mm.z()));
    }
    elements.push_back({true, place.point_mm, std::move(**next)});
    ++next;
  }
  return elements;
}

/// The angle at the second of three points, and its uncertainty by the part of each error across
/// its leg, in the plane of both legs.
void measure_corner(PickedMeasurement& found) {
  const auto place = [&](std::size_t i) -> Vector3d { return found.elements[i].point_mm; };
  const auto u95 = [&](std::size_t i) {
    return found.elements[i].feature.uncertainty.center_u95_mm;
  };
  const Vector3d u = place(0) - place(1);
  const Vector3d v = place(2) - place(1);
  require(u.norm() > 0.0 && v.norm() > 0.0, "an angle needs three different points");
  const Vector3d axis = u.cross(v).stableNormalized();
  const Vector3d ga = -axis.cross(u) / u.squaredNorm();
  const Vector3d gc = axis.cross(v) / v.squaredNorm();
  found.value = deg_from_rad(std::atan2(u.cross(v).norm(), u.dot(v)));
  found.u95 =
      deg_from_rad(std::hypot(u95(0) * ga.norm(), u95(2) * gc.norm(), u95(1) * (ga + gc).norm()));
  found.from_mm = place(0);
  found.to_mm = place(2);
}

/// Along the inward normal to the opposite wall. The noise of both walls is independent; what is
/// alike in both does not cancel.
void measure_wall(const Mesh& mesh, const PickedPlace& place, PickedMeasurement& found) {
  const Vector3d inward = -normal_at(mesh, place.triangle);
  double size_mm = 0.0;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite())
      size_mm = std::max(size_mm, (vertex.cast<double>() - place.point_mm).norm());
  const double start_mm = 1e-6 * size_mm;  // the rounding of vertices in single precision
  const auto hit =
      pick_surface(mesh, {.eye_mm = place.point_mm + start_mm * inward, .direction = inward});
  if (!hit) refuse("no wall is behind this point: the surface is open there; pick another point");
  const double cosine = normal_at(mesh, hit->triangle).dot(inward);
  constexpr double kLeastCosine = 0.25;
  if (!(cosine > kLeastCosine))
    refuse("the wall behind this point is inclined by more than 75 degrees; pick another point");
  found.from_mm = place.point_mm;
  found.to_mm = hit->point_mm;
  found.value = (found.to_mm - found.from_mm).norm();
  const auto both = [&](const std::vector<float>& values) {
    return std::pair{largest_at(mesh, values, place.triangle),
                     largest_at(mesh, values, hit->triangle) / cosine};
  };
  const auto [near_noise, far_noise] = both(noise_mm_of(mesh));
  double alike = 0.0;
  if (!mesh.sigma_systematic_mm.empty()) {
    const auto [near, far] = both(mesh.sigma_systematic_mm);
    alike = near + far;
  }
  found.u95 = kNormal95 * std::hypot(near_noise, far_noise, alike);
}

void measure_diameter(PickedMeasurement& found) {
  const PickedElement& element = found.elements.front();
  const Shape& shape = element.feature.fit.shape;
  if (!element.face || shape.kind == ShapeKind::Plane) {
    refuse(fmt::format("a {} has no diameter; pick a cylinder, a sphere, a cone or a torus",
                       element.face ? "plane" : "point"));
  }
  Vector3d out = element.point_mm - shape.center_mm;
  Vector3d center = shape.center_mm;
  if (shape.kind != ShapeKind::Sphere) {
    const double along = out.dot(shape.axis);
    if (shape.kind == ShapeKind::Cylinder) center += along * shape.axis;
    out -= along * shape.axis;
  }
  out.stableNormalize();
  found.value = 2.0 * shape.radius_mm;
  found.u95 = element.feature.uncertainty.u95_mm;
  found.from_mm = center - shape.radius_mm * out;
  found.to_mm = center + shape.radius_mm * out;
}

void measure_between(PickedMeasurement& found) {
  const auto& elements = found.elements;
  const MeasuredFeature first{.feature = elements[0].feature, .points_mm = {}};
  const MeasuredFeature second{.feature = elements[1].feature, .points_mm = {}};
  const bool angle = found.quantity == PickedQuantity::Angle;
  if (angle) {
    if (!elements[0].face || !elements[1].face)
      refuse("an angle is between two faces, or at the second of three points");
    for (const PickedElement& element : elements)
      if (element.feature.fit.shape.kind == ShapeKind::Sphere)
        refuse("a sphere has no direction, so it makes no angle; pick another face");
  }
  const MeasuredValue value =
      measure(angle ? Characteristic::Angle : Characteristic::Distance, first, &second);
  found.value = value.value;
  found.u95 = value.u95;
  const Shape& a = elements[0].feature.fit.shape;
  const Shape& b = elements[1].feature.fit.shape;
  const ShapeEnds ends = angle ? ShapeEnds{a.center_mm, b.center_mm} : ends_between(a, b);
  found.from_mm = ends.from_mm;
  found.to_mm = ends.to_mm;
}

/// Refuses another number of places than a quantity takes.
void check_places(PickedQuantity quantity, std::span<const PickedPlace> places) {
  const auto takes = [&](bool right, std::string_view what) {
    if (!right) refuse(fmt::format("{}: takes {}", name_of(quantity), what));
  };
  switch (quantity) {
    case PickedQuantity::Distance:
      return takes(places.size() == 2, "two points or faces");
    case PickedQuantity::Angle: {
      const bool points = std::none_of(
          places.begin(), places.end(), [](const PickedPlace& place) { return place.face; });
      return takes(places.size() == 2 || (places.size() == 3 && points),
                   "two faces or three points");
    }
    case PickedQuantity::Diameter:
      return takes(places.size() == 1, "one face");
    case PickedQuantity::Thickness:
      return takes(places.size() == 1 && !places.front().face, "one point");
    case PickedQuantity::Area:
    case PickedQuantity::Volume:
      break;
  }
  takes(places.empty(), "no place");
}

}  // namespace

std::string_view unit_of(PickedQuantity quantity) {
  if (quantity == PickedQuantity::Angle) return "degrees";
  if (quantity == PickedQuantity::Area) return "mm2";
  return quantity == PickedQuantity::Volume ? "mm3" : "mm";
}

PickedMeasurement measure_picked(const Mesh& mesh,
                                 PickedQuantity quantity,
                                 std::span<const PickedPlace> places,
                                 const Selection& selection,
                                 const Run& run) {
  check_places(quantity, places);
  for (const PickedPlace& place : places) {
    if (place.triangle >= mesh.triangles.size() || !place.point_mm.allFinite())
      refuse("the surface has no such place; pick it again");
  }
  PickedMeasurement found;
  found.quantity = quantity;
  if (quantity == PickedQuantity::Area || quantity == PickedQuantity::Volume) {
    const SurfaceExtent extent =
        quantity == PickedQuantity::Area ? area_of(mesh, selection) : volume_of(mesh);
    found.value = extent.value;
    found.u95 = kNormal95 * extent.u;
    found.of_selection = quantity == PickedQuantity::Area && count_selected(selection) > 0;
    found.from_mm = found.to_mm = extent.center_mm;
    return found;
  }
  found.elements = elements_of(mesh, places, run);
  if (quantity == PickedQuantity::Thickness) {
    measure_wall(mesh, places.front(), found);
  } else if (quantity == PickedQuantity::Diameter) {
    measure_diameter(found);
  } else if (found.elements.size() == 3) {
    measure_corner(found);
  } else {
    measure_between(found);
  }
  return found;
}

}  // namespace frangia
