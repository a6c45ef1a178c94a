#include "frangia/inspect/internal/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/core/srgb.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

using Eigen::Vector3d;

const std::array<Light, 3>& lights() {
  static const std::array<Light, 3> three{
      {{Vector3d(-0.72, 0.70, 0.50).normalized(), Vector3d(0.80, 0.765, 0.71), 0.12},
       {Vector3d(0.80, 0.22, 0.55).normalized(), Vector3d(0.11, 0.13, 0.17), 0.25},
       {Vector3d(0.45, 0.55, -0.75).normalized(), Vector3d(0.30, 0.32, 0.36), 0.15}}};
  return three;
}

Vector3d backdrop(double x, double y) {
  const double halo = std::exp(-0.55 * (x * x + (y - 0.15) * (y - 0.15)));
  const double height = std::clamp(0.5 + 0.5 * y, 0.0, 1.0);
  return Vector3d(0.44, 0.465, 0.50) + halo * Vector3d(0.40, 0.395, 0.38) +
         0.05 * height * Vector3d::Ones();
}

Eigen::Vector2d SampleSequence::point(std::size_t use, std::size_t i, std::size_t count) const {
  const auto index = static_cast<double>(sample * count + i + 1);
  const std::uint64_t stream = hash(pixel, use);
  const Eigen::Vector2d offset(uniform_from(hash(stream, 1)), uniform_from(hash(stream, 2)));
  const Eigen::Vector2d p =
      offset + index * Eigen::Vector2d(0.7548776662466927, 0.5698402909980532);
  return p - Eigen::Vector2d(p.array().floor());
}

Vector3d sky_direction(const Vector3d& n, const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const double out2 = point.y();
  const Vector3d u = n.unitOrthogonal();
  return std::sqrt(out2) * (std::cos(around) * u + std::sin(around) * n.cross(u)) +
         std::sqrt(1.0 - out2) * n;
}

Vector3d light_direction(const Viewpoint& viewpoint,
                         const Light& light,
                         const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const Vector3d u = light.direction.unitOrthogonal();
  const Vector3d off = std::cos(around) * u + std::sin(around) * light.direction.cross(u);
  return viewpoint.axes.transpose() *
         (light.direction + light.spread * std::sqrt(point.y()) * off).normalized();
}

Rgb screen_color(const Vector3d& light) {
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = light[static_cast<Eigen::Index>(i)];
    const double soft = value < 0.8 ? value : 1.0 - 0.2 * std::exp(-(value - 0.8) / 0.2);
    color[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(soft, 1.0 / 2.2)));
  }
  return color;
}

namespace {

using Eigen::Vector3d;

const Vector3d kInside(0.80, 0.06, 0.45);
const Vector3d kHighlighted(0.46, 0.13, 0.62);

Vector3d color_of_mark(Mark mark) {
  const auto& [red, green, blue] = mark_color(mark);
  return {red, green, blue};
}

/// A color of a map in linear light. Maps are defined for the screen, with gamma 2.2.
Vector3d mapped_color(ColorMap map, float share) {
  return color_of(map, share).cast<double>().array().pow(2.2);
}

/// The color of the corners in linear light, interpolated.
Vector3d vertex_color_at(const Mesh& mesh, const RayHit& hit) {
  Vector3d light = Vector3d::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto& [red, green, blue] = mesh.colors[mesh.triangles[hit.triangle].at(corner)];
    light += hit.barycentric[static_cast<Eigen::Index>(corner)] *
             Vector3d(linear_from_srgb(red), linear_from_srgb(green), linear_from_srgb(blue));
  }
  return light;
}

bool is_open(const Mesh& mesh) {
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (edges.is_boundary(edge)) return true;
  return false;
}

void add_marks(const Mesh& mesh, PictureLegend& legend) {
  std::array<bool, 3> has{};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    has.at(static_cast<std::size_t>(mark_of(mesh, i))) = true;
  const auto add = [&](Mark mark, const char* name) {
    if (has.at(static_cast<std::size_t>(mark)))
      legend.entries.push_back({screen_color(color_of_mark(mark)), name});
  };
  add(Mark::Measured, "measured");
  add(Mark::Displaced, "displaced");
  add(Mark::Synthesized, "synthesized");
}

}  // namespace

Vector3d inside_color() {
  return kInside;
}

Vector3d front_color(const Mesh& mesh, const RenderOptions& options, const RayHit& hit) {
  if (!options.highlighted.empty() && options.highlighted[hit.triangle] != 0) return kHighlighted;
  if (options.show_marks && mark_of(mesh, hit.triangle) != Mark::Measured)
    return color_of_mark(mark_of(mesh, hit.triangle));
  if (options.values.empty()) {
    return options.vertex_colors && !mesh.colors.empty() ? vertex_color_at(mesh, hit)
                                                         : color_of_mark(Mark::Measured);
  }
  float value = 0.0F;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    value += static_cast<float>(hit.barycentric[static_cast<Eigen::Index>(corner)]) *
             options.values[mesh.triangles[hit.triangle][corner]];
  }
  const float share = (value - options.value_min) / (options.value_max - options.value_min);
  return mapped_color(options.color_map, share);
}

PictureLegend surface_legend(const Mesh& mesh, const RenderOptions& options) {
  PictureLegend legend;
  const auto& values = options.values;
  if (!values.empty()) {
    legend.scales.push_back({options.color_map,
                             {options.value_min, options.value_max},
                             options.value_label,
                             options.whole_values,
                             options.histogram,
                             options.value_limits});
    if (std::any_of(values.begin(), values.end(), [](float value) { return std::isnan(value); }))
      legend.entries.push_back(
          {screen_color(mapped_color(options.color_map, kMissing)), "no value"});
  }
  if (options.show_marks) add_marks(mesh, legend);
  if (std::any_of(options.highlighted.begin(), options.highlighted.end(), [](auto one) {
        return one != 0;
      })) {
    legend.entries.push_back({screen_color(kHighlighted), options.highlight_label});
  }
  const bool has_colors = !legend.scales.empty() || !legend.entries.empty();
  if (has_colors && is_open(mesh)) legend.entries.push_back({screen_color(kInside), "inside"});
  return legend;
}

namespace {

using Eigen::Vector3d;

constexpr double kHalfField = 0.21;  ///< tangent of half the field of view along the shorter side
constexpr double kFill = 0.86;       ///< share of the picture that the part fills

}  // namespace

Viewpoint::Ray Viewpoint::ray(double x, double y) const {
  const Vector3d offset = axes.transpose() * Vector3d(x * scale, y * scale, 0.0);
  const Vector3d eye = target + distance * axes.row(2).transpose();
  if (!perspective) return {eye + offset, -axes.row(2).transpose()};
  return {eye, (target + offset - eye).normalized()};
}

Viewpoint fit_viewpoint(const Mesh& mesh, const RenderOptions& options) {
  Viewpoint viewpoint;
  viewpoint.perspective = options.perspective;
  const double ca = std::cos(options.azimuth_rad);
  const double sa = std::sin(options.azimuth_rad);
  const double ce = std::cos(options.elevation_rad);
  const double se = std::sin(options.elevation_rad);
  viewpoint.axes << -sa, ca, 0.0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  const auto& shown = options.fit_to_mm.empty() ? mesh.vertices_mm : options.fit_to_mm;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : shown)
    box.extend(viewpoint.axes * vertex.cast<double>());
  viewpoint.target = viewpoint.axes.transpose() * box.center();

  const double shorter = std::min(options.width_px, options.height_px);
  const Eigen::Vector2d half(options.width_px / shorter * kFill,
                             options.height_px / shorter * kFill);
  const Vector3d size = 0.5 * box.sizes();
  if (!options.perspective) {
    viewpoint.scale = std::max(size.x() / half.x(), size.y() / half.y());
    viewpoint.distance = 2.0 * box.sizes().norm() + 1.0;
    return viewpoint;
  }
  for (const auto& vertex : shown) {
    const Vector3d p = viewpoint.axes * vertex.cast<double>() - box.center();
    const double needed =
        std::max(std::abs(p.x()) / half.x(), std::abs(p.y()) / half.y()) / kHalfField + p.z();
    viewpoint.distance = std::max(viewpoint.distance, needed);
  }
  viewpoint.scale = kHalfField * viewpoint.distance;
  return viewpoint;
}

}  // namespace frangia
