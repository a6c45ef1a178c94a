#include "frangia/cad/internal/nominal_shape.h"

#include <cmath>

#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <gp_Pln.hxx>

namespace frangia {
namespace {

using Eigen::Vector3d;

/// The shape of a plane, cylinder, cone, sphere or torus.
std::optional<Shape> elementary_shape_of(const FootSurface& surface,
                                         double side,
                                         const Vector3d& amid) {
  Shape shape;
  const Handle(Geom_Surface)& geometry = surface.surface();
  const auto set_axis = [&](const gp_Ax3& place) {
    shape.center_mm = vector_from(place.Location());
    shape.axis = vector_from(place.Direction());
  };
  const auto move_along_axis = [&] {
    const double along = (amid - shape.center_mm).dot(shape.axis);
    shape.center_mm += along * shape.axis;
    return along;
  };
  switch (surface.type()) {
    case GeomAbs_Plane: {
      const gp_Pln plane = Handle(Geom_Plane)::DownCast(geometry)->Pln();
      set_axis(plane.Position());
      if (!plane.Position().Direct()) shape.axis = -shape.axis;
      shape.axis *= side;
      shape.center_mm = amid - (amid - shape.center_mm).dot(shape.axis) * shape.axis;
      return shape;
    }
    case GeomAbs_Cylinder: {
      const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(geometry);
      shape.kind = ShapeKind::Cylinder;
      set_axis(cylinder->Position());
      move_along_axis();
      shape.radius_mm = cylinder->Radius();
      return shape;
    }
    case GeomAbs_Cone: {
      const auto cone = Handle(Geom_ConicalSurface)::DownCast(geometry);
      shape.kind = ShapeKind::Cone;
      set_axis(cone->Position());
      shape.half_angle_rad = cone->SemiAngle();
      shape.radius_mm = cone->RefRadius() + std::tan(shape.half_angle_rad) * move_along_axis();
      const bool beyond_apex = shape.radius_mm < 0.0;
      if (beyond_apex) shape.radius_mm = -shape.radius_mm;
      if (beyond_apex != (shape.half_angle_rad < 0.0)) shape.axis = -shape.axis;
      shape.half_angle_rad = std::abs(shape.half_angle_rad);
      return shape;
    }
    case GeomAbs_Sphere: {
      const auto sphere = Handle(Geom_SphericalSurface)::DownCast(geometry);
      shape.kind = ShapeKind::Sphere;
      set_axis(sphere->Position());
      shape.radius_mm = sphere->Radius();
      return shape;
    }
    case GeomAbs_Torus: {
      const auto torus = Handle(Geom_ToroidalSurface)::DownCast(geometry);
      shape.kind = ShapeKind::Torus;
      set_axis(torus->Position());
      shape.radius_mm = torus->MajorRadius();
      shape.tube_radius_mm = torus->MinorRadius();
      return shape;
    }
    default:
      return std::nullopt;
  }
}

/// The nominal shape of a line or a circle swept along or about an axis, as IGES states them.
std::optional<Shape> swept_shape_of(const FootSurface& surface, const Vector3d& amid) {
  constexpr double kParallel = 1e-9;
  Shape shape;
  const auto extrusion = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface.surface());
  const auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(surface.surface());
  if (extrusion.IsNull() && revolution.IsNull()) return std::nullopt;
  Handle(Geom_Curve) curve =
      extrusion.IsNull() ? revolution->BasisCurve() : extrusion->BasisCurve();
  if (curve->IsKind(STANDARD_TYPE(Geom_TrimmedCurve)))
    curve = Handle(Geom_TrimmedCurve)::DownCast(curve)->BasisCurve();
  const auto circle = Handle(Geom_Circle)::DownCast(curve);
  const auto line = Handle(Geom_Line)::DownCast(curve);
  if (!extrusion.IsNull() && !circle.IsNull()) {
    shape.axis = vector_from(extrusion->Direction());
    shape.center_mm = vector_from(circle->Location());
    shape.radius_mm = circle->Radius();
    const Vector3d normal = vector_from(circle->Axis().Direction());
    if (shape.axis.cross(normal).norm() > kParallel) return std::nullopt;
  } else if (!revolution.IsNull() && !line.IsNull()) {
    shape.axis = vector_from(revolution->Direction());
    shape.center_mm = vector_from(revolution->Location());
    const Vector3d at = vector_from(line->Lin().Location()) - shape.center_mm;
    shape.radius_mm = (at - at.dot(shape.axis) * shape.axis).norm();
    const Vector3d direction = vector_from(line->Lin().Direction());
    if (shape.axis.cross(direction).norm() > kParallel) return std::nullopt;
  } else {
    return std::nullopt;
  }
  shape.kind = ShapeKind::Cylinder;
  shape.center_mm += (amid - shape.center_mm).dot(shape.axis) * shape.axis;
  return shape;
}

}  // namespace

std::optional<Shape> nominal_shape(const FootSurface& surface,
                                   double side,
                                   const Eigen::Vector3d& amid) {
  const auto shape = elementary_shape_of(surface, side, amid);
  return shape ? shape : swept_shape_of(surface, amid);
}

}  // namespace frangia
