#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>
#include <GeomAbs_SurfaceType.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Pnt.hxx>

namespace frangia {

/// OpenCASCADE's point or vector as Eigen's.
template <typename Triple>
Eigen::Vector3d vector_from(const Triple& triple) {
  return {triple.X(), triple.Y(), triple.Z()};
}

/// A foot point on a surface without its edges.
struct SurfaceFoot {
  Eigen::Vector2d uv;
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;  ///< unit, by the parametrization
  bool inside = true;      ///< false: held at the end of the parameters
};

/// An unbounded surface, as its face states it.
class FootSurface {
 public:
  explicit FootSurface(Handle(Geom_Surface) surface);

  /// Whether the foot follows in closed form, without a start.
  [[nodiscard]] bool is_elementary() const { return type_ != GeomAbs_OtherSurface; }
  /// Plane, cylinder, cone, sphere or torus; GeomAbs_OtherSurface: another one.
  [[nodiscard]] GeomAbs_SurfaceType type() const { return type_; }
  [[nodiscard]] const Handle(Geom_Surface) & surface() const { return surface_; }

  /// The foot of a point: the nearest one, or the one that Newton's method reaches from a start.
  [[nodiscard]] SurfaceFoot foot(const Eigen::Vector3d& point, const Eigen::Vector2d& start) const;

 private:
  [[nodiscard]] Eigen::Vector2d elementary_uv(const gp_Pnt& point) const;
  [[nodiscard]] Eigen::Vector2d newton_uv(const Eigen::Vector3d& point,
                                          const Eigen::Vector2d& start) const;
  [[nodiscard]] Eigen::Vector2d clamped(const Eigen::Vector2d& uv) const;

  Handle(Geom_Surface) surface_;
  GeomAbs_SurfaceType type_ = GeomAbs_OtherSurface;
  Eigen::AlignedBox2d range_;     ///< infinite where periodic
  Eigen::Vector2d start_{0, 0};   ///< of the parameters
  Eigen::Vector2d period_{0, 0};  ///< 0: not periodic
};

/// The edge of one or more faces.
struct FootEdge {
  Handle(Geom_Curve) curve;
  double first = 0.0;
  double last = 0.0;
  std::vector<double> parameters;  ///< of the samples; none for lines and circles
  std::vector<Eigen::Vector3d> samples;
  Eigen::AlignedBox3d box;
  std::vector<std::uint32_t> faces;
  bool is_free = false;  ///< it has a single face
};

/// Completes an edge whose curve and range are set.
void sample_edge(FootEdge& edge, double deflection_mm);

/// The point of an edge nearest to a point.
[[nodiscard]] Eigen::Vector3d foot_on_edge(const FootEdge& edge, const Eigen::Vector3d& point);

}  // namespace frangia
