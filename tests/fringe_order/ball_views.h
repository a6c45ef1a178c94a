#pragma once

#include <cmath>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/paper_rig.h"

namespace frangia::testing {

inline const Pattern kBallPattern{.name = "fringe", .fringes_per_degree = 1.0};

/// A ball on the turntable's axis, measured from several angles; a view can be made unresolved.
struct Ball {
  Rig rig = make_paper_rig({.columns = 160, .rows = 160});
  Image<Eigen::Vector2f> rays;
  double radius_mm = 45.0;

  Ball() {
    rig.reference().model.focal_px.setConstant(600.0);
    rig.reference().model.principal_point_px = {80.0, 80.0};
    rig.turntable = Turntable{.point_mm = {0.0, 0.0, 490.0}, .axis = {0.0, -1.0, 0.0}};
    rays = rays_of(rig.reference().model);
  }
  [[nodiscard]] View view(double angle_rad) const {
    View out;
    out.rig_from_object = rig.rig_from_object(angle_rad);
    const Image<float> missing(160, 160, kMissing);
    out.range = {missing, missing, missing};
    const Eigen::Vector3d center = rig.turntable->point_mm;
    for (std::size_t i = 0; i < rays.pixels().size(); ++i) {
      const Eigen::Vector3d d(rays.pixels()[i].x(), rays.pixels()[i].y(), 1.0);
      const double b = d.dot(center) / d.squaredNorm();
      const double c = (center.squaredNorm() - radius_mm * radius_mm) / d.squaredNorm();
      if (b * b < c * 1.0005) continue;
      const double depth = b - std::sqrt(b * b - c);
      const auto phase = static_cast<float>(phase_at(depth * d, kBallPattern, rig.projector));
      out.range.depth_mm.pixels()[i] = depth_at(i, phase);
      out.range.sigma_mm.pixels()[i] = 0.05F;
      out.range.phase_rad.pixels()[i] = phase;
    }
    return out;
  }
  /// The depth that triangulation gives a pixel with this phase.
  [[nodiscard]] float depth_at(std::size_t pixel, float phase_rad) const {
    const Eigen::Vector2d ray = rays.pixels()[pixel].cast<double>();
    return static_cast<float>(
        intersect_fringe(ray, phase_rad, kBallPattern, rig.projector).depth_mm);
  }
  /// Removes all points of a view and returns them as a region whose order is `fringes` too low.
  UnresolvedViewRegion make_unresolved(View& view, std::size_t index, int fringes) const {
    UnresolvedViewRegion part{.view = index};
    for (std::size_t i = 0; i < rays.pixels().size(); ++i) {
      const float phase = view.range.phase_rad.pixels()[i];
      if (std::isnan(phase)) continue;
      part.region.pixel.push_back(static_cast<std::uint32_t>(i));
      part.region.phase_rad.push_back(static_cast<float>(phase - kTwoPi * fringes));
      part.region.sigma_rad.push_back(0.02F);
      view.range.remove(static_cast<int>(i) % 160, static_cast<int>(i) / 160);
    }
    return part;
  }
};

}  // namespace frangia::testing
