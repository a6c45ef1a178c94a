#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/local_fit/fit_windows.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A camera model and the ray of each pixel.
struct CameraRays {
  /// Computes the rays of all pixels of `camera`.
  explicit CameraRays(const CameraModel& camera)
      : CameraRays(camera, std::make_shared<const Image<Eigen::Vector2f>>(rays_of(camera))) {}
  /// Shares the rays that `views` keeps.
  CameraRays(const ViewStore& views, const CameraModel& camera)
      : CameraRays(camera, views.rays(camera)) {}

  CameraModel model;  ///< camera that the rays belong to

 private:
  std::shared_ptr<const Image<Eigen::Vector2f>> shared_;
  // NOLINTNEXTLINE(modernize-pass-by-value): moving a camera model copies it
  CameraRays(const CameraModel& camera, std::shared_ptr<const Image<Eigen::Vector2f>> shared)
      : model(camera), shared_(std::move(shared)), rays(*shared_) {}

 public:
  const Image<Eigen::Vector2f>& rays;  ///< `rays_of(model)`: normalized points (x/z, y/z)
};

/// The local planes of a view, from which the signed distance of a point to the measured surface
/// follows.
///
/// A plane `a x + b y + c z = 1` of the rig frame is linear in inverse depth over the undistorted
/// image: 1/z = a rx + b ry + c. Inverse depth q is therefore the fitted and interpolated quantity.
/// A point at depth z lies `(1 - z q) / |(a, b, c)|` in front of the plane at its pixel: the
/// distance along the ray times the cosine of incidence.
///
/// @shape    pixels w x h; quads (w-1) x (h-1), quad (x, y) between pixels (x, y) and (x+1, y+1)
/// @units    mm, rig frame
/// @missing  inverse depth NaN; a quad that lacks a corner or crosses a depth step is Extrapolated
///          where a neighbouring plane was extrapolated to it, else Unseen
struct LocalPlanes {
  /// The plane fitted around a pixel, in the rig frame.
  struct Plane {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the camera
    float distance_mm = 0.0F;                          ///< from the camera's center
    /// The distance of the parallel plane through the pixel's own point.
    float tangent_distance_mm = 0.0F;
    float weight = 0.0F;  ///< cos(incidence)^2 / sigma^2, in 1/mm^2; 0 when extrapolated
    WindowKind window = WindowKind::None;  ///< window that the plane was fitted over

    /// Returns the distance of a point in front of the plane; negative behind it.
    [[nodiscard]] float in_front_mm(const Eigen::Vector3f& point) const {
      return normal.dot(point) + distance_mm;
    }
  };
  /// What is known about the surface of a quad. 32 bits wide like the other members of `Quad`, so
  /// that loops over quads vectorize.
  enum class Kind : std::int32_t {
    Unseen,        ///< a corner is missing, or a depth step crosses the quad
    Extrapolated,  ///< not measured; a neighbouring plane was extrapolated to it
    Smooth,        ///< the planes of the corners belong to one face
    Ridge,         ///< the planes of the corners meet in a convex edge
    Valley         ///< the planes of the corners meet in a concave edge
  };
  /// The surface between four neighbouring pixels.
  struct Quad {
    float distance_mm = 0.0F;  ///< distance of its plane from the camera's center
    float weight = 0.0F;       ///< mean weight of the corners
    Kind kind = Kind::Unseen;  ///< what is known about the surface
  };

  Image<float> inverse_depth;  ///< q, 1/mm
  Image<Plane> planes;         ///< one for each pixel; `distance_mm` 0 where no plane was fitted
  Image<Quad> quads;           ///< one between each four neighbouring pixels
  /// Pixels outside of this box have no plane, and quads whose upper left pixel lies outside of it
  /// are Unseen.
  PixelBox box;
  /// Pose of the object when it was measured.
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();

  /// Whether (x, y) is a pixel with a plane.
  [[nodiscard]] bool has_plane(int x, int y) const {
    return x >= 0 && y >= 0 && x < planes.width() && y < planes.height() &&
           planes(x, y).distance_mm > 0.0F;
  }

  /// The quad that contains the image point (u, v), measured or extrapolated. Null where there is
  /// neither, outside of the image, and for NaN.
  [[nodiscard]] const Quad* quad_or_extrapolated(float u, float v) const {
    const bool within = u >= 0.0F && v >= 0.0F && u < static_cast<float>(quads.width()) &&
                        v < static_cast<float>(quads.height());
    if (!within) return nullptr;
    const Quad& quad = quads(static_cast<int>(u), static_cast<int>(v));
    return quad.kind == Kind::Unseen ? nullptr : &quad;
  }
  /// The measured quad that contains the image point (u, v), or null.
  [[nodiscard]] const Quad* quad_at(float u, float v) const {
    const Quad* quad = quad_or_extrapolated(u, v);
    return quad != nullptr && quad->kind == Kind::Extrapolated ? nullptr : quad;
  }

  /// The plane of the pixel nearest to the image point (u, v), which lies inside of the image.
  [[nodiscard]] const Plane& nearest(float u, float v) const {
    const float right = u + 0.5F;
    const float down = v + 0.5F;
    return planes(static_cast<int>(right), static_cast<int>(down));
  }
  /// The measured plane of the pixel nearest to (u, v), or null. Reaches half a pixel beyond the
  /// outermost quads.
  [[nodiscard]] const Plane* pixel_at(float u, float v) const {
    const float right = u + 0.5F;
    const float down = v + 0.5F;
    const bool within = right > 0.0F && down > 0.0F && right < static_cast<float>(planes.width()) &&
                        down < static_cast<float>(planes.height());
    if (!within) return nullptr;
    const Plane& plane = nearest(u, v);
    return plane.weight > 0.0F ? &plane : nullptr;
  }

  /// The inverse depth at (u, v), interpolated bilinearly between the corners of its quad.
  [[nodiscard]] float inverse_depth_at(float u, float v) const {
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const float right = u - static_cast<float>(x);
    const float down = v - static_cast<float>(y);
    const Image<float>& q = inverse_depth;
    const float upper = q(x, y) + right * (q(x + 1, y) - q(x, y));
    const float lower = q(x, y + 1) + right * (q(x + 1, y + 1) - q(x, y + 1));
    return upper + down * (lower - upper);
  }

  /// A point's signed distance to the surface of a smooth quad, accurate to second order: the mean
  /// of the distances to the bilinear interpolation of the corners and to their tangent planes. A
  /// curved surface lies between both, equally far from each.
  [[nodiscard]] float smooth_mm(float u, float v, const Eigen::Vector3f& point) const {
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const float right = u - static_cast<float>(x);
    const float down = v - static_cast<float>(y);
    const auto tangent = [&](const Plane& plane) {
      return plane.normal.dot(point) + plane.tangent_distance_mm;
    };
    const float upper = (1.0F - right) * tangent(planes(x, y)) + right * tangent(planes(x + 1, y));
    const float lower =
        (1.0F - right) * tangent(planes(x, y + 1)) + right * tangent(planes(x + 1, y + 1));
    const float tangents = upper + down * (lower - upper);
    const float chords = (1.0F - point.z() * inverse_depth_at(u, v)) * quads(x, y).distance_mm;
    return 0.5F * (tangents + chords);
  }

  /// The face that determines a point's distance at a quad whose corners lie on several faces. The
  /// object is the intersection of the half spaces behind the faces of a ridge, and the union of
  /// those behind the faces of a valley.
  [[nodiscard]] const Plane& nearest_face(float u, float v, const Eigen::Vector3f& point) const {
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const bool ridge = quads(x, y).kind == Kind::Ridge;
    const Plane* found = &planes(x, y);
    for (const Plane* other : {&planes(x + 1, y), &planes(x, y + 1), &planes(x + 1, y + 1)}) {
      if ((other->in_front_mm(point) > found->in_front_mm(point)) == ridge) found = other;
    }
    return *found;
  }

  /// A point's signed distance to the nearest plane at the corners of an extrapolated quad.
  [[nodiscard]] float extrapolated_mm(float u, float v, const Eigen::Vector3f& point) const {
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    float least = std::numeric_limits<float>::infinity();
    for (const Plane* plane :
         {&planes(x, y), &planes(x + 1, y), &planes(x, y + 1), &planes(x + 1, y + 1)}) {
      const float distance = plane->in_front_mm(point);
      if (plane->distance_mm > 0.0F && std::abs(distance) < std::abs(least)) least = distance;
    }
    return least;
  }
};

/// Thresholds of the smoothing over 7 x 7 pixels. Half or double of one changes the RMS deviation
/// of the demo's shaft by less than 1 %, see `WindowChoiceOptions`.
struct WideningOptions {
  /// Maximum residual variance of the wide quadratic, per pixel variance: pixels differ in noise.
  float max_residual_ratio = 2.5F;
  float max_autocorrelation = 0.05F;  ///< of the residuals; that of noise is negative
};

/// Window radius, crease angle and smoothing of the local planes.
struct LocalPlanesOptions {
  int radius = 2;           ///< radius of the windows, px
  double crease_rad = 0.3;  ///< neighbouring planes at a larger angle belong to different faces
  int extrapolate_px = 0;   ///< distance that planes are extrapolated beyond measured pixels
  int every = 1;  ///< pixel step; only planes and quads at multiples of it, in x and y, are needed
  bool widen = false;           ///< smooth over 7 x 7 pixels where the residuals are noise
  WideningOptions widening;     ///< criteria for `widen`
  WindowChoiceOptions windows;  ///< choice of the window around a pixel
};

/// Fits the local plane at each pixel by least squares over a square window.
///
/// A window across an edge of the object would round the edge off. There a window is used that
/// holds the pixel and lies to one side of the edge, see `choose_window`. Neighbouring pixels are
/// on one surface unless the line that joins them is within 8 degrees of the viewing ray by more
/// than their noise. `reuse`, an earlier result, lends its memory to the new one.
///
/// @shape    w x h of the camera
/// @missing  with `every` above 1, what is not needed is unspecified: missing, or left over from
///          `reuse`
/// @units    mm, rig frame
/// @errors   Error(Input) when the grid and the camera differ in size
/// @source   the choice among windows: Kuwahara et al. 1976
[[nodiscard]] LocalPlanes local_planes(const View& view,
                                       const CameraRays& camera,
                                       const LocalPlanesOptions& options = {},
                                       LocalPlanes reuse = {});

}  // namespace frangia
