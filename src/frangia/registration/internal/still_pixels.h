#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A view at every few pixels.
struct ThinView {
  RangeGrid range;
  Eigen::Isometry3d rig_from_object;
  int setup = 0;
};

/// Views at different angles of the table, or of different setups, at the same pixels. All of a
/// long scan are not held: a few megabytes, whatever its size.
struct ThinViews {
  int step_px = 1;
  CameraModel camera;           ///< has the pixels that are kept
  Image<Eigen::Vector2f> rays;  ///< of its pixels
  std::vector<ThinView> views;  ///< at most 24

  /// The point of a pixel, rig frame.
  [[nodiscard]] Eigen::Vector3d point(int x, int y, float depth_mm) const {
    return static_cast<double>(depth_mm) * rays(x, y).cast<double>().homogeneous();
  }
};

[[nodiscard]] ThinViews thin_views(const ViewStore& views,
                                   const CameraModel& camera,
                                   std::span<const int> setups);

/// What the views saw at one pixel.
struct StillPixel {
  float depth_mm = kMissing;  ///< where the most views agree; the farthest of equal ones
  float sigma_mm = 0.0F;      ///< of the noisiest of them
  std::uint32_t views = 0;    ///< which agree, a bit each
  int agree = 0;              ///< how many
  int nearer = 0;             ///< that saw something in front of it
  bool stands = false;        ///< agrees in two views, and hardly any sees farther
  bool usual = false;         ///< ... and in half of those that see something
  // Where the table turns it to, by pairs of views.
  int through = 0;  ///< that see through its place
  int support = 0;  ///< that see something there
  int outside = 0;  ///< whose field of view does not reach it
  int turned = 0;   ///< all of them
};

/// Within which two depths are one, with the standard deviation of their difference.
[[nodiscard]] float equal_within_mm(float depth_mm, float sigma_mm);

/// Finds the depth on which most views agree at a pixel, and turns it into all views.
///
/// @missing  NaN where no view has a point
[[nodiscard]] StillPixel compare_views(const ThinViews& seen, int x, int y);

/// Turns the point of a pixel from the views that agree on it into all others, and counts what they
/// see there.
void turn_into_views(const ThinViews& seen, int x, int y, StillPixel& at);

}  // namespace frangia
