#include <cmath>

#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <fmt/format.h>

#include "frangia/cad/internal/shape_checks.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void refuse_shape(const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("its shape is damaged: {}; export it again", what));
}

bool is_finite(const gp_Pnt& at) {
  return std::isfinite(at.X()) && std::isfinite(at.Y()) && std::isfinite(at.Z());
}

bool is_finite(const gp_Pnt2d& at) {
  return std::isfinite(at.X()) && std::isfinite(at.Y());
}

/// Of splines every pole, since a curve depends on each only near it.
template <typename Spline>
bool has_finite_poles(const Spline& spline) {
  for (int i = 1; i <= spline.NbPoles(); ++i)
    if (!is_finite(spline.Pole(i)) || !std::isfinite(spline.Weight(i))) return false;
  return true;
}

template <typename Spline>
bool has_finite_pole_grid(const Spline& spline) {
  for (int u = 1; u <= spline.NbUPoles(); ++u) {
    for (int v = 1; v <= spline.NbVPoles(); ++v)
      if (!is_finite(spline.Pole(u, v)) || !std::isfinite(spline.Weight(u, v))) return false;
  }
  return true;
}

/// Whether values are finite. Offset curves and surfaces have none at some parameters.
template <typename Test>
bool holds_where_defined(const Test& test) {
  try {
    return test();
  } catch (const Standard_Failure&) {
    return true;
  }
}

bool is_curve_finite(const Geom_Curve& curve, double first, double last) {
  if (const auto* spline = dynamic_cast<const Geom_BSplineCurve*>(&curve))
    return has_finite_poles(*spline);
  if (const auto* spline = dynamic_cast<const Geom_BezierCurve*>(&curve))
    return has_finite_poles(*spline);
  return holds_where_defined([&] {
    return is_finite(curve.Value(first)) && is_finite(curve.Value(0.5 * (first + last))) &&
           is_finite(curve.Value(last));
  });
}

bool is_curve_finite(const Geom2d_Curve& curve, double first, double last) {
  if (const auto* spline = dynamic_cast<const Geom2d_BSplineCurve*>(&curve))
    return has_finite_poles(*spline);
  if (const auto* spline = dynamic_cast<const Geom2d_BezierCurve*>(&curve))
    return has_finite_poles(*spline);
  return holds_where_defined([&] {
    return is_finite(curve.Value(first)) && is_finite(curve.Value(0.5 * (first + last))) &&
           is_finite(curve.Value(last));
  });
}

bool is_surface_finite(const Geom_Surface& surface) {
  if (const auto* spline = dynamic_cast<const Geom_BSplineSurface*>(&surface))
    return has_finite_pole_grid(*spline);
  if (const auto* spline = dynamic_cast<const Geom_BezierSurface*>(&surface))
    return has_finite_pole_grid(*spline);
  double u1 = 0.0;
  double u2 = 0.0;
  double v1 = 0.0;
  double v2 = 0.0;
  surface.Bounds(u1, u2, v1, v2);
  // An unbounded surface is evaluated at its origin and beside it.
  const auto inside = [](double low, double high) {
    const bool bounded = !Precision::IsInfinite(low) && !Precision::IsInfinite(high);
    return bounded ? 0.5 * (low + high) : Precision::IsInfinite(low) ? 1.0 : low + 1.0;
  };
  const double u = inside(u1, u2);
  const double v = inside(v1, v2);
  if (!std::isfinite(u) || !std::isfinite(v)) return false;
  return holds_where_defined([&] {
    return is_finite(surface.Value(u, v)) && is_finite(surface.Value(u + 1e-3, v + 1e-3));
  });
}

/// Whether parameters are in order and an edge between them has two ends.
bool is_range(double first, double last) {
  return std::isfinite(first) && std::isfinite(last) && first <= last &&
         !Precision::IsInfinite(first) && !Precision::IsInfinite(last);
}

void check_edge(const TopoDS_Edge& edge, int number) {
  double first = 0.0;
  double last = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return;
  if (!is_range(first, last))
    refuse_shape(fmt::format("its edge {} does not end at two finite parameters", number));
  if (!is_curve_finite(*curve, first, last))
    refuse_shape(
        fmt::format("the curve of its edge {} has a coordinate that is no number", number));
}

void check_face(const TopoDS_Face& face, int number) {
  TopLoc_Location place;
  const Handle(Geom_Surface)& surface = BRep_Tool::Surface(face, place);
  if (surface.IsNull()) refuse_shape(fmt::format("its face {} has no surface", number));
  if (!is_surface_finite(*surface)) {
    refuse_shape(
        fmt::format("the surface of its face {} has a coordinate that is no number", number));
  }
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(face, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(edges(i)), face, first, last);
    if (curve.IsNull()) continue;
    if (!is_range(first, last) || !is_curve_finite(*curve, first, last)) {
      refuse_shape(
          fmt::format("an edge of its face {} has a coordinate that is no number", number));
    }
  }
}

}  // namespace

void check_geometry(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(shape, TopAbs_VERTEX, parts);
  for (int i = 1; i <= parts.Extent(); ++i) {
    const TopoDS_Vertex& vertex = TopoDS::Vertex(parts(i));
    if (!is_finite(BRep_Tool::Pnt(vertex)) || !std::isfinite(BRep_Tool::Tolerance(vertex)))
      refuse_shape(fmt::format("its vertex {} has a coordinate that is no number", i));
  }
  parts.Clear();
  TopExp::MapShapes(shape, TopAbs_EDGE, parts);
  for (int i = 1; i <= parts.Extent(); ++i)
    check_edge(TopoDS::Edge(parts(i)), i);
  parts.Clear();
  TopExp::MapShapes(shape, TopAbs_FACE, parts);
  for (int i = 1; i <= parts.Extent(); ++i)
    check_face(TopoDS::Face(parts(i)), i);
}

void check_triangles(const Poly_Triangulation& triangles, std::uint32_t face) {
  if (!std::isfinite(triangles.Deflection()) || triangles.Deflection() < 0.0)
    refuse_shape(fmt::format("its face {} states no accuracy of its triangles", face));
  const int nodes = triangles.NbNodes();
  for (int i = 1; i <= nodes; ++i) {
    if (!is_finite(triangles.Node(i)) ||
        (triangles.HasUVNodes() && !is_finite(triangles.UVNode(i))))
      refuse_shape(fmt::format("point {} of its face {} is no number", i, face));
  }
  for (int i = 1; i <= triangles.NbTriangles(); ++i) {
    int a = 0;
    int b = 0;
    int c = 0;
    triangles.Triangle(i).Get(a, b, c);
    for (const int node : {a, b, c}) {
      if (node >= 1 && node <= nodes) continue;
      refuse_shape(
          fmt::format("a triangle of its face {} names point {} of {}", face, node, nodes));
    }
  }
}

void check_polygon(const Poly_PolygonOnTriangulation& polygon,
                   const Poly_Triangulation& triangles,
                   std::uint32_t face) {
  const int nodes = triangles.NbNodes();
  for (int i = 1; i <= polygon.NbNodes(); ++i) {
    const int node = polygon.Node(i);
    if (node >= 1 && node <= nodes) continue;
    refuse_shape(fmt::format("an edge of its face {} names point {} of {}", face, node, nodes));
  }
}

}  // namespace frangia
