#include "frangia/inspect/edit_picture.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/inspect/contact_sheet.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

struct Direction {
  double azimuth_rad, elevation_rad;

  [[nodiscard]] Vector3d unit() const {
    return {std::cos(elevation_rad) * std::cos(azimuth_rad),
            std::cos(elevation_rad) * std::sin(azimuth_rad),
            std::sin(elevation_rad)};
  }
};

/// Candidate view directions, the default first.
std::vector<Direction> directions(const RenderOptions& options) {
  constexpr int kAround = 12;
  std::vector<Direction> all{{options.azimuth_rad, options.elevation_rad}};
  for (const double elevation_deg : {20.0, 50.0, -30.0}) {
    for (int i = 0; i < kAround; ++i) {
      all.push_back(
          {options.azimuth_rad + rad_from_deg(360.0 * i / kAround), rad_from_deg(elevation_deg)});
    }
  }
  return all;
}

/// Adds the projected areas of the selected triangles for each view direction.
void add_visible_areas(const Mesh& mesh,
                       const Selection& selection,
                       const std::vector<Vector3d>& viewers,
                       std::vector<double>& seen) {
  for (std::size_t t = 0; t < selection.size(); ++t) {
    if (selection[t] == 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3d origin = mesh.vertices_mm[a].cast<double>();
    const Vector3d area = (mesh.vertices_mm[b].cast<double>() - origin)
                              .cross(mesh.vertices_mm[c].cast<double>() - origin);
    if (!area.allFinite()) continue;
    for (std::size_t i = 0; i < viewers.size(); ++i)
      seen[i] += std::max(0.0, area.dot(viewers[i]));
  }
}

RenderOptions choose_view_direction(const Mesh& before,
                                    const EditState& after,
                                    const EditPreview& preview,
                                    RenderOptions options) {
  const std::vector<Direction> all = directions(options);
  std::vector<Vector3d> viewers;
  viewers.reserve(all.size());
  for (const Direction& direction : all)
    viewers.push_back(direction.unit());
  std::vector<double> seen(all.size());
  add_visible_areas(before, preview.removed, viewers, seen);
  add_visible_areas(after.mesh, preview.added, viewers, seen);
  add_visible_areas(after.mesh, after.selection, viewers, seen);
  constexpr double kMinGain =
      1.05;  // keeps the default direction unless another shows clearly more
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (seen[i] > kMinGain * seen[best]) best = i;
  options.azimuth_rad = all[best].azimuth_rad;
  options.elevation_rad = all[best].elevation_rad;
  return options;
}

}  // namespace

Image<Rgb> edit_picture(const Mesh& before,
                        const EditState& after,
                        const EditPreview& preview,
                        RenderOptions options,
                        const Run& run) {
  options = choose_view_direction(before, after, preview, std::move(options));
  options.show_marks = true;
  options.fit_to_mm = before.vertices_mm;
  options.fit_to_mm.insert(
      options.fit_to_mm.end(), after.mesh.vertices_mm.begin(), after.mesh.vertices_mm.end());
  options.highlighted = preview.removed;
  options.highlight_label = "removed or moved";
  std::vector<Image<Rgb>> pictures{render_mesh(before, options, run)};
  options.highlighted = after.selection;
  options.highlight_label = "selected";
  if (!after.mesh.empty()) pictures.push_back(render_mesh(after.mesh, options, run));
  return contact_sheet({pictures}, options.height_px);
}

}  // namespace frangia
