#include "frangia/local_fit/local_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/local_fit/fit_windows.h"
#include "frangia/local_fit/internal/estimate_lateral_noise.h"
#include "frangia/local_fit/internal/extrapolate_planes.h"
#include "frangia/local_fit/internal/link_pixels.h"
#include "frangia/local_fit/internal/plane_row.h"
#include "frangia/range/measured_volume.h"
#include "frangia/rig/camera_model.h"

namespace frangia {
namespace {

/// The radius of the widest window, and one more pixel for the links.
constexpr int kMargin = 4;

/// Fills the pixels of `before` that lie outside of `now`.
template <typename T>
void clear_outside(const PixelBox& before, const PixelBox& now, const T& empty, Image<T>& image) {
  const PixelBox from = before.within(image.width(), image.height());
  if (from.empty()) return;
  for (int y = from.top; y < from.bottom; ++y) {
    T* row = &image(0, y);
    const bool within = y >= now.top && y < now.bottom;
    std::fill(row + from.left, row + (within ? std::max(from.left, now.left) : from.right), empty);
    if (within) std::fill(row + std::min(from.right, now.right), row + from.right, empty);
  }
}

/// Prepares images that are empty outside of `box`. Their pixels inside of it are left as they are.
void prepare(LocalPlanes& view, int width, int height, const PixelBox& box) {
  if (view.planes.width() != width || view.planes.height() != height) {
    view.planes = Image<LocalPlanes::Plane>(width, height);
    view.quads = Image<LocalPlanes::Quad>(std::max(0, width - 1), std::max(0, height - 1));
    view.inverse_depth = Image<float>(width, height, kMissing);
  } else {
    clear_outside(view.box, box, LocalPlanes::Plane{}, view.planes);
    clear_outside(view.box, box, LocalPlanes::Quad{}, view.quads);
    clear_outside(view.box, box, kMissing, view.inverse_depth);
  }
  view.box = box;
}

using Corners = std::array<Eigen::Vector2i, 4>;
Corners corners_of(int x, int y) {
  return {Eigen::Vector2i(x, y),
          Eigen::Vector2i(x + 1, y),
          Eigen::Vector2i(x, y + 1),
          Eigen::Vector2i(x + 1, y + 1)};
}

/// Whether the corners of a quad lie on one face.
bool is_smooth(const std::array<const LocalPlanes::Plane*, 4>& corners, float crease_cosine) {
  float least = 1.0F;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, corners[i]->normal.dot(corners[j]->normal));
  }
  return least > crease_cosine;
}

/// Classifies a crease: the corners of a ridge lie behind one another's planes, those of a valley
/// in front.
LocalPlanes::Kind crease_of(const LocalPlanes& view,
                            const Image<Eigen::Vector2f>& rays,
                            int x,
                            int y) {
  float in_front = 0.0F;
  for (const auto& a : corners_of(x, y)) {
    for (const auto& b : corners_of(x, y)) {
      const float depth = 1.0F / view.inverse_depth(b.x(), b.y());
      in_front += view.planes(a.x(), a.y()).in_front_mm(depth * rays(b.x(), b.y()).homogeneous());
    }
  }
  return in_front < 0.0F ? LocalPlanes::Kind::Ridge : LocalPlanes::Kind::Valley;
}

/// Whether the four pixels from (x, y) of the grid on are linked.
bool are_linked(const LinkedPixels& grid, int x, int y) {
  constexpr auto kRight = LinkedPixels::Right;
  constexpr auto kDown = LinkedPixels::Down;
  return grid.has(x, y, kRight) && grid.has(x, y, kDown) && grid.has(x, y + 1, kRight) &&
         grid.has(x + 1, y, kDown);
}

/// The quad of four linked pixels.
LocalPlanes::Quad quad_of(const LocalPlanes& view,
                          const Image<Eigen::Vector2f>& rays,
                          const Eigen::Vector2i& at,
                          float crease_cosine) {
  const int x = at.x();
  const int y = at.y();
  const std::array<const LocalPlanes::Plane*, 4> corners{&view.planes(x, y),
                                                         &view.planes(x + 1, y),
                                                         &view.planes(x, y + 1),
                                                         &view.planes(x + 1, y + 1)};
  LocalPlanes::Quad quad;
  for (const LocalPlanes::Plane* corner : corners) {
    if (!(corner->distance_mm > 0.0F)) return {};
    quad.distance_mm += 0.25F * corner->distance_mm;
    quad.weight += 0.25F * corner->weight;
  }
  quad.kind =
      is_smooth(corners, crease_cosine) ? LocalPlanes::Kind::Smooth : crease_of(view, rays, x, y);
  return quad;
}

}  // namespace

LocalPlanes local_planes(const View& view,
                         const CameraRays& camera,
                         const LocalPlanesOptions& options,
                         LocalPlanes reuse) {
  const Image<Eigen::Vector2f>& rays = camera.rays;
  require(same_size(view.range.depth_mm, rays) && same_size(view.range.sigma_mm, rays),
          "local_planes: the range grid and the camera differ in size");
  const int width = rays.width();
  const int height = rays.height();
  require(options.every >= 1,
          "local_planes: planes are needed at every pixel or at a multiple of 1 pixel");
  LocalPlanes out = std::move(reuse);
  out.rig_from_object = view.rig_from_object;
  const PixelBox box = grow(measured_box(view.range.depth_mm),
                            std::max(kMargin, options.extrapolate_px + 1),
                            width,
                            height);
  prepare(out, width, height, box);
  if (box.empty()) return out;
  const LinkedPixels grid = link_pixels(view.range, camera.model, box);
  const FastCameraModel model(camera.model);
  const float lateral_noise_px =
      estimate_lateral_noise(grid.q, grid.noise, ImageStrip{box.top, height});
  constexpr std::size_t kRows = 32;
  const auto rows = static_cast<std::size_t>(box.height());
  parallel_chunks(rows, kRows, [&](std::size_t begin, std::size_t end) {
    const WindowRows fits(
        grid.q, options.radius, static_cast<int>(begin), static_cast<int>(end - begin));
    std::optional<WindowRows> wider;
    if (options.widen) {
      constexpr int kWide = 3;
      wider.emplace(grid.q, kWide, static_cast<int>(begin), static_cast<int>(end - begin));
    }
    PlaneRow row(box.left, box.width(), options);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      if (!is_corner_of_needed_quad(box.top + y, options.every)) continue;
      row.choose(grid, fits, wider ? &*wider : nullptr, y, lateral_noise_px);
      row.fit(&rays(box.left, box.top + y), model);
      row.write(&out.planes(box.left, box.top + y), &out.inverse_depth(box.left, box.top + y));
    }
  });
  const auto crease_cosine = static_cast<float>(std::cos(options.crease_rad));
  const PixelBox quads = box.within(out.quads.width(), out.quads.height());
  parallel_rows(quads.height(), [&](int row) {
    const int y = quads.top + row;
    if (y % options.every != 0) return;
    const int first = (quads.left + options.every - 1) / options.every * options.every;
    for (int x = first; x < quads.right; x += options.every) {
      out.quads(x, y) = are_linked(grid, x - box.left, row)
                            ? quad_of(out, rays, {x, y}, crease_cosine)
                            : LocalPlanes::Quad{};
    }
  });
  if (options.extrapolate_px > 0) extrapolate_planes(out, options.extrapolate_px);
  return out;
}

}  // namespace frangia
