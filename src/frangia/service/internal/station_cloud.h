#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/decode/decode_view.h"
#include "frangia/rig/rig.h"
#include "frangia/views/collect_points.h"

namespace frangia {

/// Triangulates decoded views of one rig, to be looked at while a scan grows.
class StationCloud {
 public:
  explicit StationCloud(const Rig& rig) : rig_(rig), rays_(rays_of(rig.reference().model)) {}

  /// The points of a view at a turntable angle; none when its phase does not fit the rig.
  ///
  /// @units    mm, object frame of the rig as calibrated
  [[nodiscard]] PointCloud of(const DecodedView& decoded, double angle_rad) const;

 private:
  Rig rig_;
  Image<Eigen::Vector2f> rays_;
};

}  // namespace frangia
