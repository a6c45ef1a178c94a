#pragma once

#include <Eigen/Core>

#include "frangia/inspect/shade_mesh.h"
#include "frangia/surface/mesh.h"

namespace frangia {

/// Where the viewer stands and what each pixel looks at.
struct PictureViewer {
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
[[nodiscard]] PictureViewer fitted_viewer(const Mesh& mesh, const ShadeOptions& options);

}  // namespace frangia
