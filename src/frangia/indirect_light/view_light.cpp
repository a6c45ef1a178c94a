#include "frangia/indirect_light/view_light.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"

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
                     LightUse use,
                     const SurfaceLight* collected)
    : surface_(surface),
      collected_(collected),
      pose_(collected != nullptr ? collected->pose_of(view.rig_from_object) : std::nullopt),
      rig_from_object_(view.rig_from_object),
      object_from_rig_(view.rig_from_object.inverse()),
      rays_(rays),
      most_difference_(use == LightUse::Uncertainty ? 0.03 : 0.005),
      relative_(use == LightUse::Uncertainty ? 0.25 : 0.1) {
  constexpr double kSteepest = 3.7;  // tangent of 75 degrees
  const double px = rays.width() > 1 ? static_cast<double>((rays(1, 0) - rays(0, 0)).norm()) : 0.0;
  slope_per_px_ = kSteepest * px;
  if (use == LightUse::FewPixels) return;
  for (const int step_px : {8, 4, 2})
    grids_.push_back(grid(step_px, view));
}

/// The nodes of a grid in the cells where the coarser grid varies.
ViewLight::Grid ViewLight::grid(int step_px, const View& view) const {
  Grid out{step_px, (rays_.width() - 1) / step_px + 2, (rays_.height() - 1) / step_px + 2, {}, {}};
  const std::size_t count =
      static_cast<std::size_t>(out.rows) * static_cast<std::size_t>(out.columns);
  out.nodes.resize(count);
  out.varies.resize(count);
  parallel_rows(out.rows, [&](int row) {
    for (int column = 0; column < out.columns; ++column) {
      const int x = std::min(column * step_px, rays_.width() - 1);
      const int y = std::min(row * step_px, rays_.height() - 1);
      if (!grids_.empty() && !grids_.back().touches_varying(x, y)) continue;
      if (!is_measured_near(view.range.depth_mm, x, y, step_px)) continue;
      const int node = row * out.columns + column;
      out.nodes[static_cast<std::size_t>(node)] = trace(x, y);
    }
  });
  parallel_rows(out.rows - 1, [&](int row) {
    for (int column = 0; column + 1 < out.columns; ++column) {
      const int number = row * out.columns + column;
      const auto cell = static_cast<std::size_t>(number);
      const bool within_smooth =
          !grids_.empty() &&
          grids_.back().varies[grids_.back().cell_of(column * step_px, row * step_px)] == 0;
      out.varies[cell] = !within_smooth && differ(out, cell) ? 1 : 0;
    }
  });
  return out;
}

std::size_t ViewLight::Grid::cell_of(int x, int y) const {
  const int cell = y / step_px * columns + x / step_px;
  return static_cast<std::size_t>(cell);
}

const ViewLight::Node& ViewLight::Grid::corner(std::size_t cell, int number) const {
  return nodes[cell + static_cast<std::size_t>((number / 2) * columns + number % 2)];
}

/// Whether a cell varies that contains a pixel or meets another one there.
bool ViewLight::Grid::touches_varying(int x, int y) const {
  for (const int v : {y - 1, y}) {
    for (const int u : {x - 1, x}) {
      if (u >= 0 && v >= 0 && varies[cell_of(u, v)] != 0) return true;
    }
  }
  return false;
}

ViewLight::Node ViewLight::trace(int x, int y) const {
  const Eigen::Vector2d ray = rays_(x, y).cast<double>();
  const Eigen::Vector3d origin_mm = object_from_rig_.translation();
  const Eigen::Vector3d direction = object_from_rig_.linear() * ray.homogeneous();
  Node node;
  node.light = pose_ ? collected_->light_along(*pose_, origin_mm, direction, node.depth_mm)
                     : surface_.light_along(rig_from_object_, origin_mm, direction, node.depth_mm);
  return node;
}

ViewLight::Node ViewLight::interpolate(int x, int y, double depth_mm) const {
  const auto smooth = std::find_if(grids_.begin(), grids_.end(), [&](const Grid& grid) {
    return grid.varies[grid.cell_of(x, y)] == 0;
  });
  if (smooth == grids_.end()) return trace(x, y);
  const std::size_t cell = smooth->cell_of(x, y);
  const double s = static_cast<double>(x % smooth->step_px) / smooth->step_px;
  const double t = static_cast<double>(y % smooth->step_px) / smooth->step_px;
  // A node on another surface is farther away than the steepest slope that is measured.
  const double near_mm = slope_per_px_ * 1.5 * smooth->step_px * depth_mm;
  Node sum;
  sum.light.fringes.assign(surface_.patterns().size(), 0.0);
  double weights = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const Node& node = smooth->corner(cell, corner);
    const double weight = (corner % 2 == 1 ? s : 1.0 - s) * (corner / 2 == 1 ? t : 1.0 - t);
    if (!node.is_lit() || std::abs(node.depth_mm - depth_mm) >= near_mm || weight <= 0.0) continue;
    weights += weight;
    sum.light.direct += weight * node.light.direct;
    sum.light.indirect += weight * node.light.indirect;
    sum.light.unknown += weight * node.light.unknown;
    for (std::size_t m = 0; m < sum.light.fringes.size(); ++m)
      sum.light.fringes[m] += weight * node.light.fringes[m];
  }
  if (weights <= 0.0) return trace(x, y);
  return sum;
}

/// Of the nearest lit pixels to the left, right, above and below, the one with the most indirect
/// light.
ViewLight::Node ViewLight::nearest_lit(int x, int y, double depth_mm) const {
  constexpr int kReach_px = 8;
  Node most;
  double most_share = -1.0;
  for (int reach = 1; reach <= kReach_px && most_share < 0.0; ++reach) {
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int u = x + reach * dx;
      const int v = y + reach * dy;
      if (u < 0 || v < 0 || u >= rays_.width() || v >= rays_.height()) continue;
      Node node = trace(u, v);
      const double near_mm = slope_per_px_ * 1.5 * reach * depth_mm;
      if (!node.is_lit() || std::abs(node.depth_mm - depth_mm) >= near_mm) continue;
      const double share = node.light.indirect / node.light.direct;
      if (share <= most_share) continue;
      most_share = share;
      most = std::move(node);
    }
  }
  return most;
}

/// Whether the light at the corners of a cell differs too much to be interpolated, or is unknown.
/// At a crease it changes from node to node. Corners in shadow or in gaps of the surface say
/// nothing.
bool ViewLight::differ(const Grid& grid, std::size_t cell) const {
  const std::size_t patterns = surface_.patterns().size();
  std::vector<const PointLight*> lit;
  std::vector<std::complex<double>> mean(patterns, 0.0);
  double direct = 0.0;
  for (int number = 0; number < 4; ++number) {
    const Node& node = grid.corner(cell, number);
    if (!node.is_lit()) continue;
    lit.push_back(&node.light);
    direct += node.light.direct;
    for (std::size_t m = 0; m < patterns; ++m)
      mean[m] += node.light.fringes[m] / node.light.direct;
  }
  const auto count = static_cast<double>(lit.size());
  for (const PointLight* light : lit) {
    if (std::abs(light->direct * count / direct - 1.0) > 0.5) return true;
    for (std::size_t m = 0; m < patterns; ++m) {
      const std::complex<double> usual = mean[m] / count;
      const double allowed = std::max(most_difference_, relative_ * std::abs(usual));
      if (std::abs(light->fringes[m] / light->direct - usual) > allowed) return true;
    }
  }
  return lit.empty();
}

IndirectShare ViewLight::at(int x, int y, double depth_mm) const {
  return share_of(interpolate(x, y, depth_mm).light, x, y, depth_mm);
}

IndirectShare ViewLight::near(int x, int y, double depth_mm) const {
  const Node node = interpolate(x, y, depth_mm);
  const bool is_known = node.light.direct > 0.0;
  return share_of(is_known ? node.light : nearest_lit(x, y, depth_mm).light, x, y, depth_mm);
}

IndirectShare ViewLight::share_of(const PointLight& light, int x, int y, double depth_mm) const {
  IndirectShare out;
  out.fringes.assign(surface_.patterns().size(), 0.0);
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
