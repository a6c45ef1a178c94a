#pragma once

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
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

}  // namespace frangia
