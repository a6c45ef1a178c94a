#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// 80 x 60 pixels of 0.5 mm that see a plane at 500 mm.
struct FlatView {
  CameraModel model{.width_px = 80,
                    .height_px = 60,
                    .focal_px = {1000.0, 1000.0},
                    .principal_point_px = {39.5, 29.5}};
  Image<Eigen::Vector2f> rays = rays_of(model);
  RangeGrid range{Image<float>(80, 60, 500.0F), Image<float>(80, 60, 0.02F)};
  Image<PixelStatus> status{80, 60, PixelStatus::Measured};

  void set_columns(int from, int to, float depth_mm) {
    for (int y = 0; y < 60; ++y) {
      for (int x = from; x < to; ++x)
        range.depth_mm(x, y) = depth_mm;
    }
  }
};

}  // namespace frangia
