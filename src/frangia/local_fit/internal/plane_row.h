#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/local_fit/choose_window.h"
#include "frangia/local_fit/internal/link_pixels.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {

/// The local planes of a row of pixels on their way: each quantity in a row of its own, so that
/// loops over them become vector code.
class PlaneRow {
 public:
  explicit PlaneRow(int width);

  /// Takes the window of each pixel of row `y`: the one about it where that fits, which is nearly
  /// everywhere, else what `choose_window` finds. Where a wider window leaves nothing over but
  /// noise, the pixel has what that has in its middle.
  ///
  /// shape    `windows` of 5 x 5 pixels; `wider` of 7 x 7, or null
  void choose(const LinkedPixels& grid,
              const WindowRows& windows,
              const WindowRows* wider,
              int y,
              float lateral_noise_px);
  /// The planes, from inverse depths and their slopes over the image.
  void fit(const Eigen::Vector2f* rays, const FastCameraModel& model);
  /// Hands them over, with the inverse depth that each pixel is taken to have.
  void write(LocalPlanes::Plane* planes, float* inverse_depth) const;

 private:
  using Row = std::vector<float>;
  void widen(const LinkedPixels& grid, const WindowRows& wider, int y, float lateral_noise_px);

  int width_;
  std::size_t begin_ = 0;  ///< of the pixels from the first that was seen to the last
  std::size_t end_ = 0;
  std::vector<WindowKind> kind_;
  std::vector<char> wide_;  ///< what a wider window has
  Row measured_, value_, variance_;
  Row mean_, slope_x_, slope_y_;
  Row normal_x_, normal_y_, normal_z_, distance_, tangent_distance_, weight_;
};

}  // namespace frangia
