#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/local_fit/local_planes.h"

namespace frangia {

/// A view in little: the planes at every `stride`-th pixel, where the surface is smooth. Small
/// enough that all views are in memory together.
///
/// units    mm, rig frame
/// missing  sigma 0
struct SurfelMap {
  struct Surfel {
    Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();  ///< the pixel's own: a window's mean is
                                                         ///< off where the surface is curved
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit, towards the camera
    float sigma_mm = 0.0F;                               ///< along the normal
  };

  int stride = 1;
  Image<Surfel> surfels;  ///< surfel (x, y) is pixel (x stride, y stride)
};

/// A plane map of at most about `pixels` surfels.
[[nodiscard]] SurfelMap make_surfel_map(const LocalPlanes& view,
                                        const CameraRays& camera,
                                        std::size_t pixels);

/// About `count` surfels, spread evenly over the picture; fewer when there are no more.
[[nodiscard]] std::vector<SurfelMap::Surfel> pick_surfels(const SurfelMap& map, std::size_t count);

}  // namespace frangia
