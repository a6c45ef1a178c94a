#pragma once

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/rig/lens.h"
#include "frangia/views/view.h"

namespace frangia {

/// A camera and the ray of each of its pixels.
struct CameraRays {
  explicit CameraRays(const Lens& camera) : lens(camera), rays(rays_of(camera)) {}

  Lens lens;
  Image<Eigen::Vector2f> rays;
};

/// One view made ready to be asked how far a point lies from the surface it saw.
///
/// A plane `a x + b y + c z = 1` of the rig frame is linear in inverse depth over the undistorted
/// image: 1/z = a rx + b ry + c. So inverse depth q is what is interpolated and fitted, and a point
/// at depth z lies `(1 - z q) / |(a, b, c)|` in front of the plane seen at its pixel, which is the
/// distance along the ray times the cosine of incidence.
///
/// shape    pixels w x h; quads (w-1) x (h-1), quad (x, y) between pixels (x, y) and (x+1, y+1)
/// units    mm, rig frame
/// missing  inverse depth 0; a quad that lacks a corner or crosses a depth step has weight 0
struct LocalPlanes {
  struct Quad {
    float distance_mm = 0.0F;  ///< of the plane from the camera's centre, 1 / |(a, b, c)|
    float weight = 0.0F;       ///< cos(incidence)^2 / sigma^2, in 1/mm^2
  };

  Image<float> inverse_depth;           ///< q, 1/mm
  Image<Eigen::Vector3f> plane_per_mm;  ///< (a, b, c): points away from the camera
  Image<Quad> quads;
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();
};

/// The local plane at each pixel, by least squares over those of its 3 x 3 neighbours that lie on
/// the same surface: a pair of pixels does not when the line that joins it is within 8 degrees of
/// the viewing ray, by more than its noise.
///
/// errors   Error(Input) when the grid and the camera differ in size
[[nodiscard]] LocalPlanes local_planes(const View& view, const CameraRays& camera);

}  // namespace frangia
