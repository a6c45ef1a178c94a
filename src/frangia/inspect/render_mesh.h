#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/frames/map_picture.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Size, viewpoint, colors and legend of a rendered mesh.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding) in the order of their subjects
struct RenderOptions {
  int width_px = 1200;                        ///< width of the picture without its legend
  int height_px = 900;                        ///< height of the picture
  int samples_across = 4;                     ///< a pixel has the square of this many rays
  double azimuth_rad = rad_from_deg(35.0);    ///< of the viewer about z, from x towards y
  double elevation_rad = rad_from_deg(20.0);  ///< of the viewer above the ground
  bool perspective = true;                    ///< false: parallel projection
  bool ground = true;                         ///< draw the shadow of the part on the ground
  double crease_rad = rad_from_deg(40.0);     ///< edges with a larger angle are shaded sharp

  bool show_edges = false;  ///< draw the edges of the triangles
  bool show_marks = false;  ///< displaced triangles in yellow, synthesized ones in blue
  /// Shows the colors of the vertices, where the mesh has them, instead of light grey.
  bool vertex_colors = false;

  Selection highlighted;                     ///< triangles shown in violet; empty: none
  std::string highlight_label = "selected";  ///< in the legend
  /// Points that the picture must contain, to give two meshes the same view; empty: the mesh.
  std::vector<Eigen::Vector3f> fit_to_mm;

  std::vector<float> values;               ///< one per vertex, shown as colors; empty: plain
  float value_min = 0.0F;                  ///< values at the ends of the color map
  float value_max = 1.0F;                  ///< values above it have the last color
  ColorMap color_map = ColorMap::Viridis;  ///< colors of `values`
  std::string value_label;       ///< quantity and unit of the values for the scale: "deviation, mm"
  bool whole_values = false;     ///< the values are counts
  std::vector<float> histogram;  ///< of the values, in the legend; see `ColorScale::histogram`
  std::vector<double> value_limits;  ///< marked in the legend, such as a tolerance band
  bool legend = true;  ///< add the color scale and the meaning of other colors at the right
};

/// Renders a mesh, fitted to the picture, with soft shadows and, where it shows values, marks or
/// highlights, a legend at the right.
///
/// Smooth shading with a key, a fill and a back light and ambient light from the sky. The inside of
/// the surface is magenta, a color that is on no scale.
///
/// @shape    height_px high; the legend adds to width_px
/// @missing  vertices whose value is NaN are grey
/// @errors   Error(Input) for a mesh without triangles, a wrong number of values or highlights, or
///          an empty picture
[[nodiscard]] Image<Rgb> render_mesh(const Mesh& mesh,
                                     const RenderOptions& options = {},
                                     const Run& run = {});

/// A place on a surface.
struct PicturedPlace {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< its position
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, outward
};

/// Where `render_mesh` with the same options draws places of a mesh, without its legend.
///
/// @shape    one for each place
/// @units    pixels from the upper left corner
/// @missing  none for a place that faces away, is hidden by the mesh or lies outside of the picture
[[nodiscard]] std::vector<std::optional<Eigen::Vector2d>> picture_positions(
    const RayScene& mesh, const RenderOptions& options, const std::vector<PicturedPlace>& places);

}  // namespace frangia
