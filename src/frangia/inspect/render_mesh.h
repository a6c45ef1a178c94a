#pragma once

#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/frames/color_map.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

struct RenderOptions {
  int width_px = 1200;
  int height_px = 900;
  int samples_across = 4;                     ///< rays a pixel are its square
  double azimuth_rad = rad_from_deg(35.0);    ///< of the viewer about z, from x towards y
  double elevation_rad = rad_from_deg(20.0);  ///< of the viewer above the ground
  bool perspective = true;                    ///< false: parallel projection
  bool ground = true;                         ///< the part's shadow on what it stands on
  double crease_rad = rad_from_deg(40.0);     ///< sharper edges stay sharp

  bool show_edges = false;  ///< of the triangles, as thin lines
  bool show_marks = false;  ///< what was moved in yellow, what was invented in blue

  Selection highlighted;  ///< triangles shown in violet; empty: none
  /// What the picture must hold, so that two meshes are seen from one place; empty: the mesh.
  std::vector<Eigen::Vector3f> fit_to_mm;

  std::vector<float> values;  ///< one a vertex, shown as colours; empty for plain plaster
  float value_min = 0.0F;     ///< the colour map's two ends
  float value_max = 1.0F;
  ColorMap color_map = ColorMap::Viridis;
};

/// A picture of a mesh, fitted to its bounds, as a product photograph shows it.
///
/// Gouraud shading with two lights, a rim and a soft sky; the inside shows in red where a hole lets
/// one see it.
/// missing  vertices whose value is NaN are grey
/// errors   Error(Input) for an empty mesh, values that are not one a vertex, highlights that are
/// not
///          one a triangle, or an empty picture
[[nodiscard]] Image<Rgb> render_mesh(const Mesh& mesh,
                                     const RenderOptions& options = {},
                                     const Run& run = {});

}  // namespace frangia
