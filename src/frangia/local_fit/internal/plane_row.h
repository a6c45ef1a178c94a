#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/local_fit/fit_windows.h"
#include "frangia/local_fit/internal/link_pixels.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Whether the pixels in a row or column are corners of the quads at multiples of `every`.
[[nodiscard]] constexpr bool is_corner_of_needed_quad(int position, int every) {
  return position % every <= 1;
}

/// Computes the local planes of a row of pixels. Each quantity is stored in a row of its own, so
/// that loops vectorize.
class PlaneRow {
 public:
  /// A row of `width` pixels from column `left` of the image on. The options must outlive the row.
  PlaneRow(int left, int width, const LocalPlanesOptions& options);

  /// Chooses the window of each pixel of row `y`: the centered one where it is flat to within the
  /// noise, which is nearly everywhere, else the result of `choose_window`. Where the residuals of
  /// the wider window are noise, the pixel gets the value of the wider quadratic.
  ///
  /// @shape    `windows` of 5 x 5 pixels; `wider` of 7 x 7, or null
  void choose(const LinkedPixels& grid,
              const WindowRows& windows,
              const WindowRows* wider,
              int y,
              float lateral_noise_px);
  /// Computes the planes from inverse depths and their slopes over the image.
  void fit(const Eigen::Vector2f* rays, const FastCameraModel& model);
  /// Writes the planes and the smoothed inverse depths.
  void write(LocalPlanes::Plane* planes, float* inverse_depth) const;

 private:
  using Row = std::vector<float>;
  void widen(const LinkedPixels& grid, const WindowRows& wider, int y, float lateral_noise_px);

  const LocalPlanesOptions& options_;
  int left_;
  int width_;
  std::size_t begin_ = 0;  ///< measured pixels lie in [begin_, end_)
  std::size_t end_ = 0;
  std::vector<WindowKind> kind_;
  std::vector<char> wide_;  ///< 1 where the wider window is used
  Row measured_, value_, variance_;
  Row mean_, slope_x_, slope_y_;
  Row normal_x_, normal_y_, normal_z_, distance_, tangent_distance_, weight_;
};

}  // namespace frangia
