#include "frangia/inspect/internal/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "frangia/core/missing.h"
#include "frangia/core/srgb.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mark_colors.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/internal/lighting.h"

namespace frangia {
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

}  // namespace frangia
