#include "frangia/indirect_light/view_light.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

/// Whether a depth was measured within `radius` pixels.
bool is_measured_near(const Image<float>& depth_mm, int x, int y, int radius) {
  const int every = std::max(1, radius / 3);
  for (int dy = -radius; dy <= radius; dy += every) {
    for (int dx = -radius; dx <= radius; dx += every) {
      const int u = x + dx;
      const int v = y + dy;
      if (u >= 0 && v >= 0 && u < depth_mm.width() && v < depth_mm.height() &&
          !std::isnan(depth_mm(u, v)))
        return true;
    }
  }
  return false;
}

}  // namespace

ViewLight::ViewLight(const LitSurface& surface,
                     const View& view,
                     const Image<Eigen::Vector2f>& rays,
                     int step_px)
    : surface_(surface),
      rig_from_object_(view.rig_from_object),
      object_from_rig_(view.rig_from_object.inverse()),
      rays_(rays),
      step_px_(step_px),
      columns_((rays.width() - 1) / step_px + 2) {
  constexpr double kSteepest = 3.7;  // tangent of 75 degrees
  const double px = rays.width() > 1 ? static_cast<double>((rays(1, 0) - rays(0, 0)).norm()) : 0.0;
  slope_per_px_ = kSteepest * px;
  const int rows = (rays.height() - 1) / step_px + 2;
  nodes_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns_));
  parallel_rows(rows, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      const int x = std::min(column * step_px_, rays.width() - 1);
      const int y = std::min(row * step_px_, rays.height() - 1);
      if (is_measured_near(view.range.depth_mm, x, y, step_px_))
        nodes_[static_cast<std::size_t>(row * columns_ + column)] = trace(x, y);
    }
  });
}

ViewLight::Node ViewLight::trace(int x, int y) const {
  const Eigen::Vector2d ray = rays_(x, y).cast<double>();
  Node node;
  node.light = surface_.light_along(rig_from_object_,
                                    object_from_rig_.translation(),
                                    object_from_rig_.linear() * ray.homogeneous(),
                                    node.depth_mm);
  return node;
}

ViewLight::Node ViewLight::interpolate(int x, int y, double depth_mm) const {
  const int column = x / step_px_;
  const int row = y / step_px_;
  const double s = static_cast<double>(x - column * step_px_) / step_px_;
  const double t = static_cast<double>(y - row * step_px_) / step_px_;
  // A node on another surface is farther away than the steepest slope that is measured.
  const double near_mm = slope_per_px_ * 1.5 * step_px_ * depth_mm;
  Node sum;
  sum.light.fringes.assign(surface_.patterns().size(), 0.0);
  double weights = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner % 2;
    const int down = corner / 2;
    const Node& node = nodes_[static_cast<std::size_t>((row + down) * columns_ + column + right)];
    const double weight = (right == 1 ? s : 1.0 - s) * (down == 1 ? t : 1.0 - t);
    const bool same = node.depth_mm > 0.0 && node.light.direct > 0.0 &&
                      std::abs(node.depth_mm - depth_mm) < near_mm;
    if (!same || weight <= 0.0) continue;
    weights += weight;
    sum.light.direct += weight * node.light.direct;
    sum.light.indirect += weight * node.light.indirect;
    sum.light.unknown += weight * node.light.unknown;
    for (std::size_t m = 0; m < sum.light.fringes.size(); ++m)
      sum.light.fringes[m] += weight * node.light.fringes[m];
  }
  if (weights <= 0.0 || !varies_little(sum.light, weights, column, row)) return trace(x, y);
  return sum;
}

/// Whether the four nodes around a pixel have nearly the same light as their mean, `sum` over
/// `weights`. At a crease it changes from node to node.
bool ViewLight::varies_little(const PointLight& sum, double weights, int column, int row) const {
  constexpr double kMostDifference = 0.02;  // of the direct light
  for (int corner = 0; corner < 4; ++corner) {
    const Node& node =
        nodes_[static_cast<std::size_t>((row + corner / 2) * columns_ + column + corner % 2)];
    if (!(node.depth_mm > 0.0 && node.light.direct > 0.0)) return false;
    for (std::size_t m = 0; m < sum.fringes.size(); ++m) {
      if (std::abs(node.light.fringes[m] / node.light.direct - sum.fringes[m] / sum.direct) >
          kMostDifference)
        return false;
    }
    if (std::abs(node.light.direct * weights / sum.direct - 1.0) > 0.5) return false;
  }
  return true;
}

IndirectShare ViewLight::at(int x, int y, double depth_mm) const {
  const PointLight light = interpolate(x, y, depth_mm).light;
  IndirectShare out;
  out.fringes.assign(light.fringes.size(), 0.0);
  if (!(light.direct > 0.0)) return out;
  const Eigen::Vector3d point = depth_mm * rays_(x, y).cast<double>().homogeneous();
  const double phase = phase_at(point, surface_.patterns().back(), surface_.projector());
  out.mean = light.indirect / light.direct;
  out.unknown = light.unknown / light.direct;
  for (std::size_t m = 0; m < out.fringes.size(); ++m) {
    const double ratio =
        surface_.patterns()[m].fringes_per_unit() / surface_.patterns().back().fringes_per_unit();
    out.fringes[m] = light.fringes[m] / light.direct * std::polar(1.0, -ratio * phase);
  }
  return out;
}

}  // namespace frangia
