#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "frangia/frames/picture_legend.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// The viewer's position and projection.
struct Viewpoint {
  Eigen::Matrix3d axes;  ///< rows: right, up, towards the viewer
  Eigen::Vector3d target;
  double distance = 0.0;
  double scale = 0.0;  ///< mm at the target for half the shorter side of the picture
  bool perspective = true;

  struct Ray {
    Eigen::Vector3d origin, direction;
  };
  /// The ray through a position in the picture, in halves of its shorter side from the centre.
  [[nodiscard]] Ray ray(double x, double y) const;
};

/// The viewpoint of the options, at a distance where the whole mesh (or `fit_to_mm`) fits with a
/// margin.
[[nodiscard]] Viewpoint fit_viewpoint(const Mesh& mesh, const RenderOptions& options);

/// A disc-shaped light at infinity.
struct Light {
  Eigen::Vector3d
      direction;          ///< to the light, in the viewer's frame: x right, y up, z to the viewer
  Eigen::Vector3d color;  ///< linear red, green, blue
  double spread;          ///< tangent of the half-angle of the disc, which softens its shadow
};

/// Key, fill and back light.
[[nodiscard]] const std::array<Light, 3>& lights();

/// The linear color of the background at a position in the picture: a gradient, brighter behind the
/// part. x and y in halves of the shorter side from the centre.
[[nodiscard]] Eigen::Vector3d backdrop(double x, double y);

/// Low-discrepancy points of the unit square with a random offset for each pixel.
///
/// @source   the R2 sequence, Roberts 2018
struct SampleSequence {
  std::uint64_t pixel;
  std::size_t sample;  ///< of the pixel

  /// Point `i` of the `count` that each sample needs for a use, such as one light.
  [[nodiscard]] Eigen::Vector2d point(std::size_t use, std::size_t i, std::size_t count) const;
};

/// A cosine-weighted direction of the hemisphere about a unit normal, from a point of the unit
/// square.
[[nodiscard]] Eigen::Vector3d sky_direction(const Eigen::Vector3d& normal,
                                            const Eigen::Vector2d& point);

/// A direction to a point of a light's disc, in the mesh's frame, from a point of the unit square.
[[nodiscard]] Eigen::Vector3d light_direction(const Viewpoint& viewpoint,
                                              const Light& light,
                                              const Eigen::Vector2d& point);

/// Converts linear light to screen values with gamma 2.2; highlights are compressed instead of
/// clipped.
[[nodiscard]] Rgb screen_color(const Eigen::Vector3d& light);

/// Linear color of the back side of triangles: a magenta at least 20 degrees of chromaticity away
/// from every color of the maps, so that it cannot be mistaken for a value.
[[nodiscard]] Eigen::Vector3d inside_color();

/// Linear color of a surface before lighting: highlighted, marked, mapped from its value, or plain.
[[nodiscard]] Eigen::Vector3d front_color(const Mesh& mesh,
                                          const RenderOptions& options,
                                          const RayHit& hit);

/// The legend of the colors in a picture: the scale of the values, and those of highlights, marks,
/// missing values and the inside that the mesh has. Empty for a plain picture.
[[nodiscard]] PictureLegend surface_legend(const Mesh& mesh, const RenderOptions& options);

}  // namespace frangia
