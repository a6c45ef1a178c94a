#include "frangia/cad/internal/occt_foot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <ElCLib.hxx>
#include <ElSLib.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>

namespace frangia {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

GeomAbs_SurfaceType type_of(const Handle(Geom_Surface) & surface) {
  const auto is = [&](const auto& type) { return surface->IsKind(type); };
  if (is(STANDARD_TYPE(Geom_Plane))) return GeomAbs_Plane;
  if (is(STANDARD_TYPE(Geom_CylindricalSurface))) return GeomAbs_Cylinder;
  if (is(STANDARD_TYPE(Geom_ConicalSurface))) return GeomAbs_Cone;
  if (is(STANDARD_TYPE(Geom_SphericalSurface))) return GeomAbs_Sphere;
  if (is(STANDARD_TYPE(Geom_ToroidalSurface))) return GeomAbs_Torus;
  return GeomAbs_OtherSurface;
}

/// Squared distance to a place on a surface, halved, with derivatives.
struct Approach {
  Vector3d du, dv;
  double value = 0.0;
  Vector2d gradient;
  Matrix2d hessian;

  Approach(const Geom_Surface& surface, const Vector3d& point, const Vector2d& uv) {
    gp_Pnt at;
    gp_Vec u;
    gp_Vec v;
    gp_Vec uu;
    gp_Vec vv;
    gp_Vec cross;
    surface.D2(uv.x(), uv.y(), at, u, v, uu, vv, cross);
    const Vector3d way = vector_from(at) - point;
    du = vector_from(u);
    dv = vector_from(v);
    value = 0.5 * way.squaredNorm();
    gradient = {way.dot(du), way.dot(dv)};
    const double mixed = du.dot(dv) + way.dot(vector_from(cross));
    hessian << du.squaredNorm() + way.dot(vector_from(uu)), mixed, mixed,
        dv.squaredNorm() + way.dot(vector_from(vv));
    const bool convex = hessian(0, 0) > 0.0 && hessian.determinant() > 0.0;
    if (!convex) {  // the step of Gauss and Newton, which descends
      hessian << du.squaredNorm(), du.dot(dv), du.dot(dv), dv.squaredNorm();
      hessian.diagonal() *= 1.0 + 1e-9;
    }
  }

  /// The step to the minimum; parameters that are held do not move.
  [[nodiscard]] Vector2d step(const std::array<bool, 2>& held) const {
    if (held[0] && held[1]) return Vector2d::Zero();
    if (held[0]) return {0.0, hessian(1, 1) > 0.0 ? -gradient.y() / hessian(1, 1) : 0.0};
    if (held[1]) return {hessian(0, 0) > 0.0 ? -gradient.x() / hessian(0, 0) : 0.0, 0.0};
    const double det = hessian.determinant();
    if (!(det > 0.0))
      return step({du.squaredNorm() < dv.squaredNorm(), !(du.squaredNorm() < dv.squaredNorm())});
    return -Vector2d(hessian(1, 1) * gradient.x() - hessian(0, 1) * gradient.y(),
                     hessian(0, 0) * gradient.y() - hessian(0, 1) * gradient.x()) /
           det;
  }
};

double squared_distance_to(const Geom_Surface& surface, const Vector3d& point, const Vector2d& uv) {
  return 0.5 * (vector_from(surface.Value(uv.x(), uv.y())) - point).squaredNorm();
}

constexpr int kMostSteps = 40;
constexpr double kStillMm = 1e-9;  // a step this short ends the search

double parameter_by_newton(const FootEdge& edge, const Vector3d& point, double start) {
  double t = start;
  for (int i = 0; i < kMostSteps; ++i) {
    gp_Pnt at;
    gp_Vec tangent;
    gp_Vec bend;
    edge.curve->D2(t, at, tangent, bend);
    const Vector3d way = vector_from(at) - point;
    const Vector3d d = vector_from(tangent);
    double curvature = d.squaredNorm() + way.dot(vector_from(bend));
    if (!(curvature > 0.0)) curvature = d.squaredNorm();
    if (!(curvature > 0.0)) break;
    const double next = std::clamp(t - way.dot(d) / curvature, edge.first, edge.last);
    const double moved = std::abs(next - t) * d.norm();
    t = next;
    if (moved < kStillMm) break;
  }
  return t;
}

/// A parameter that Newton's method has led many periods away: what asks whether a face contains it
/// would step through them one by one.
double within_periods(double value, double low, double period) {
  constexpr double kMostPeriods = 16.0;
  if (!(period > 0.0) || !(std::abs(value - low) > kMostPeriods * period)) return value;
  return value - period * std::floor((value - low) / period);
}

}  // namespace

FootSurface::FootSurface(Handle(Geom_Surface) surface) : surface_(std::move(surface)) {
  while (surface_->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
    surface_ = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface_)->BasisSurface();
  type_ = type_of(surface_);
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  Vector2d low;
  Vector2d high;
  surface_->Bounds(low.x(), high.x(), low.y(), high.y());
  start_ = low;
  if (surface_->IsUPeriodic()) period_.x() = surface_->UPeriod();
  if (surface_->IsVPeriodic()) period_.y() = surface_->VPeriod();
  if (surface_->IsUPeriodic()) std::tie(low.x(), high.x()) = std::pair(-kNoEnd, kNoEnd);
  if (surface_->IsVPeriodic()) std::tie(low.y(), high.y()) = std::pair(-kNoEnd, kNoEnd);
  range_ = {low, high};
}

Vector2d FootSurface::clamped(const Vector2d& uv) const {
  return uv.cwiseMax(range_.min()).cwiseMin(range_.max());
}

Vector2d FootSurface::elementary_uv(const gp_Pnt& point) const {
  Vector2d uv;
  switch (type_) {
    case GeomAbs_Plane:
      ElSLib::Parameters(Handle(Geom_Plane)::DownCast(surface_)->Pln(), point, uv.x(), uv.y());
      break;
    case GeomAbs_Cylinder:
      ElSLib::Parameters(
          Handle(Geom_CylindricalSurface)::DownCast(surface_)->Cylinder(), point, uv.x(), uv.y());
      break;
    case GeomAbs_Cone:
      ElSLib::Parameters(
          Handle(Geom_ConicalSurface)::DownCast(surface_)->Cone(), point, uv.x(), uv.y());
      break;
    case GeomAbs_Sphere:
      ElSLib::Parameters(
          Handle(Geom_SphericalSurface)::DownCast(surface_)->Sphere(), point, uv.x(), uv.y());
      break;
    default:
      ElSLib::Parameters(
          Handle(Geom_ToroidalSurface)::DownCast(surface_)->Torus(), point, uv.x(), uv.y());
  }
  return uv;
}

Vector2d FootSurface::newton_uv(const Vector3d& point, const Vector2d& start) const {
  Vector2d uv = clamped(start);
  for (int i = 0; i < kMostSteps; ++i) {
    const Approach at(*surface_, point, uv);
    std::array<bool, 2> held{};
    for (const Eigen::Index k : {0, 1}) {
      const bool outwards = (uv[k] <= range_.min()[k] && at.gradient[k] > 0.0) ||
                            (uv[k] >= range_.max()[k] && at.gradient[k] < 0.0);
      held.at(static_cast<std::size_t>(k)) = outwards;
    }
    Vector2d step = at.step(held);
    Vector2d next = clamped(uv + step);
    constexpr int kHalvings = 12;
    int halvings = 0;
    while (squared_distance_to(*surface_, point, next) > at.value && halvings < kHalvings) {
      step *= 0.5;
      next = clamped(uv + step);
      ++halvings;
    }
    if (halvings == kHalvings) return uv;
    const Vector2d moved = next - uv;
    uv = next;
    if ((moved.x() * at.du + moved.y() * at.dv).norm() < kStillMm) return uv;
  }
  return uv;
}

SurfaceFoot FootSurface::foot(const Vector3d& point, const Vector2d& start) const {
  SurfaceFoot foot;
  foot.uv = is_elementary() ? elementary_uv(gp_Pnt(point.x(), point.y(), point.z()))
                            : newton_uv(point, start);
  if (period_.x() > 0.0) foot.uv.x() = within_periods(foot.uv.x(), start_.x(), period_.x());
  if (period_.y() > 0.0) foot.uv.y() = within_periods(foot.uv.y(), start_.y(), period_.y());
  gp_Pnt at;
  gp_Vec u;
  gp_Vec v;
  surface_->D1(foot.uv.x(), foot.uv.y(), at, u, v);
  foot.point_mm = vector_from(at);
  foot.normal = vector_from(u).cross(vector_from(v));
  const double size = foot.normal.norm();
  constexpr double kPole = 1e-12;
  if (size > kPole * (u.SquareMagnitude() + v.SquareMagnitude())) {
    foot.normal /= size;
  } else {  // beside a pole, where the parametrization has a direction
    const Vector2d middle = is_elementary() ? Vector2d(0.0, 0.0) : range_.center();
    const Vector2d beside =
        foot.uv + 1e-6 * (middle.allFinite() ? Vector2d(middle - foot.uv) : -foot.uv);
    surface_->D1(beside.x(), beside.y(), at, u, v);
    foot.normal = vector_from(u).cross(vector_from(v)).normalized();
  }
  if (!is_elementary()) {
    foot.inside = (foot.uv.array() > range_.min().array()).all() &&
                  (foot.uv.array() < range_.max().array()).all();
  }
  return foot;
}

void sample_edge(FootEdge& edge, double deflection_mm) {
  while (edge.curve->IsKind(STANDARD_TYPE(Geom_TrimmedCurve)))
    edge.curve = Handle(Geom_TrimmedCurve)::DownCast(edge.curve)->BasisCurve();
  constexpr double kAngleRad = 0.1;
  const GeomAdaptor_Curve adaptor(edge.curve, edge.first, edge.last);
  const GCPnts_TangentialDeflection samples(adaptor, kAngleRad, deflection_mm, 3);
  for (int i = 1; i <= samples.NbPoints(); ++i) {
    edge.parameters.push_back(samples.Parameter(i));
    edge.samples.push_back(vector_from(samples.Value(i)));
    edge.box.extend(edge.samples.back());
  }
  edge.box.min().array() -= 2.0 * deflection_mm;
  edge.box.max().array() += 2.0 * deflection_mm;
}

Vector3d foot_on_edge(const FootEdge& edge, const Vector3d& point) {
  const gp_Pnt at(point.x(), point.y(), point.z());
  const auto value = [&](double t) { return vector_from(edge.curve->Value(t)); };
  if (edge.curve->IsKind(STANDARD_TYPE(Geom_Line))) {
    const double t = ElCLib::Parameter(Handle(Geom_Line)::DownCast(edge.curve)->Lin(), at);
    return value(std::clamp(t, edge.first, edge.last));
  }
  if (edge.curve->IsKind(STANDARD_TYPE(Geom_Circle))) {
    double t = ElCLib::Parameter(Handle(Geom_Circle)::DownCast(edge.curve)->Circ(), at);
    t = ElCLib::InPeriod(t, edge.first, edge.first + 2.0 * std::numbers::pi);
    if (t <= edge.last) return value(t);
    const Vector3d first = value(edge.first);
    const Vector3d last = value(edge.last);
    return (first - point).squaredNorm() < (last - point).squaredNorm() ? first : last;
  }
  double least = std::numeric_limits<double>::infinity();
  double start = edge.first;
  for (std::size_t i = 0; i + 1 < edge.samples.size(); ++i) {
    const Vector3d way = edge.samples[i + 1] - edge.samples[i];
    const double length2 = way.squaredNorm();
    const double along =
        length2 > 0.0 ? std::clamp((point - edge.samples[i]).dot(way) / length2, 0.0, 1.0) : 0.0;
    const double distance2 = (point - edge.samples[i] - along * way).squaredNorm();
    if (distance2 >= least) continue;
    least = distance2;
    start = edge.parameters[i] + along * (edge.parameters[i + 1] - edge.parameters[i]);
  }
  return value(parameter_by_newton(edge, point, start));
}

}  // namespace frangia
