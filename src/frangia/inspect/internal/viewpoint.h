#pragma once

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// Where the viewer stands and what each pixel looks at.
struct Viewpoint {
  Eigen::Matrix3d axes;  ///< rows: right, up, towards the viewer
  Eigen::Vector3d target;
  double distance = 0.0;
  double scale = 0.0;  ///< mm at the target for half the shorter side of the picture
  bool perspective = true;

  struct Ray {
    Eigen::Vector3d origin, direction;
  };
  /// The ray through a place of the picture, in halves of its shorter side from the middle.
  [[nodiscard]] Ray ray(double x, double y) const;
};

/// The viewer of these options, so far away that the whole mesh, or what
/// it is to fit to, is in the picture with a margin.
[[nodiscard]] Viewpoint fit_viewpoint(const Mesh& mesh, const RenderOptions& options);

}  // namespace frangia
