#include "frangia/views/local_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/views/carry_planes.h"
#include "frangia/views/choose_window.h"
#include "frangia/views/estimate_jitter.h"
#include "frangia/views/fast_lens.h"

namespace frangia {
namespace {

constexpr float kSteepest = 7.1F;     // tan(82 degrees): steeper than that is a step, not a slope
constexpr float kNoiseSigmas = 4.0F;  // and a step must rise out of the noise
constexpr float kSmallestSigma = 1e-6F;  // of the depth: keeps the weight of perfect data finite

/// Which neighbours of a pixel lie on its surface.
enum Link : std::uint8_t { kRight = 1, kDown = 2 };

struct Grid {
  Image<float> q;      ///< inverse depth, as measured
  Image<float> noise;  ///< its standard deviation
  Image<std::uint8_t> links;
};

template <typename T>
void fit_size(Image<T>& image, int width, int height) {
  if (image.width() != width || image.height() != height) image = Image<T>(width, height);
}

Grid link_pixels(const RangeGrid& range, const Lens& camera) {
  const int width = range.depth_mm.width();
  const int height = range.depth_mm.height();
  Grid grid{
      Image<float>(width, height), Image<float>(width, height), Image<std::uint8_t>(width, height)};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float depth = range.depth_mm(x, y);
      const float sigma = std::max(range.sigma_mm(x, y), kSmallestSigma * depth);
      const bool seen = depth > 0.0F && sigma >= 0.0F;
      grid.q(x, y) = seen ? 1.0F / depth : kMissing;
      grid.noise(x, y) = sigma / (depth * depth);
    }
  });
  const auto steepest = static_cast<float>(kSteepest / camera.focal_px.mean());
  const auto linked = [&](int x, int y, int to_x, int to_y) {
    const float here = grid.q(x, y);
    const float there = grid.q(to_x, to_y);
    const float slope = std::max(here, there) * steepest;
    const float noise = kNoiseSigmas * std::max(grid.noise(x, y), grid.noise(to_x, to_y));
    return std::abs(here - there) < slope + noise;  // false for NaN
  };
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const bool right = x + 1 < width && linked(x, y, x + 1, y);
      const bool down = y + 1 < height && linked(x, y, x, y + 1);
      grid.links(x, y) = static_cast<std::uint8_t>((right ? kRight : 0) | (down ? kDown : 0));
    }
  });
  return grid;
}

bool has(const Grid& grid, int x, int y, Link link) {
  return x >= 0 && y >= 0 && (grid.links(x, y) & link) != 0;
}

/// Inverse depth and its standard deviation.
struct Pixel {
  float q;
  float noise;
};

/// A pixel where its window is centred on it and follows the surface: that of the best paraboloid,
/// which keeps the curvature and has little of the noise.
Pixel settled(const ChosenWindow& chosen, const Pixel& measured) {
  if (chosen.kind == WindowKind::Beside)
    return {chosen.fit.mean, measured.noise * std::sqrt(chosen.variance)};
  if (!is_about_pixel(chosen.kind)) return measured;
  return {chosen.fit.middle, measured.noise * std::sqrt(chosen.variance)};
}

/// The plane through a pixel's point, from q and its slope over the image.
LocalPlanes::Plane plane_of(const ChosenWindow& chosen,
                            const Pixel& pixel,
                            const FastLens& lens,
                            const Eigen::Vector2f& ray) {
  const WindowFit& fit = chosen.fit;
  const Eigen::Vector2f ab =
      lens.jacobian(ray).transpose() * Eigen::Vector2f(fit.slope_x, fit.slope_y);
  const Eigen::Vector3f abc(ab.x(), ab.y(), fit.mean - ab.dot(ray));
  const float distance = 1.0F / abc.norm();
  const float cosine = distance * pixel.q;
  // Beside a rim or an edge neither slope nor pixel is what it is in the middle of a face.
  constexpr float kDoubt = 3.0F;
  const float doubt = is_about_pixel(chosen.kind) ? 1.0F : kDoubt;
  const float sigma_mm = doubt * pixel.noise / (pixel.q * pixel.q);
  return {-distance * abc,
          distance,
          distance * (fit.mean / pixel.q),
          cosine * cosine / (sigma_mm * sigma_mm),
          chosen.kind};
}

/// The corners of quad (x, y).
using Corners = std::array<Eigen::Vector2i, 4>;
Corners corners_of(int x, int y) {
  return {Eigen::Vector2i(x, y),
          Eigen::Vector2i(x + 1, y),
          Eigen::Vector2i(x, y + 1),
          Eigen::Vector2i(x + 1, y + 1)};
}

/// Whether the corners of a quad lie on one face.
bool is_smooth(const Image<LocalPlanes::Plane>& planes, int x, int y, float crease_cosine) {
  const Eigen::Vector3f& a = planes(x, y).normal;
  const Eigen::Vector3f& b = planes(x + 1, y).normal;
  const Eigen::Vector3f& c = planes(x, y + 1).normal;
  const Eigen::Vector3f& d = planes(x + 1, y + 1).normal;
  return std::min({a.dot(b), a.dot(c), a.dot(d), b.dot(c), b.dot(d), c.dot(d)}) > crease_cosine;
}

/// Whether the faces of a quad bulge or gape: whether its corners lie behind one another's planes.
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

LocalPlanes::Quad quad_of(const Grid& grid,
                          const LocalPlanes& view,
                          const Image<Eigen::Vector2f>& rays,
                          const Eigen::Vector2i& at,
                          float crease_cosine) {
  const int x = at.x();
  const int y = at.y();
  if (!has(grid, x, y, kRight) || !has(grid, x, y, kDown) || !has(grid, x, y + 1, kRight) ||
      !has(grid, x + 1, y, kDown)) {
    return {};
  }
  const auto corners = corners_of(x, y);
  const bool whole = std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
    return view.has_plane(corner.x(), corner.y());
  });
  if (!whole) return {};
  LocalPlanes::Quad quad;
  for (const auto& corner : corners) {
    quad.distance_mm += 0.25F * view.planes(corner.x(), corner.y()).distance_mm;
    quad.weight += 0.25F * view.planes(corner.x(), corner.y()).weight;
  }
  quad.kind = is_smooth(view.planes, x, y, crease_cosine) ? LocalPlanes::Kind::Smooth
                                                          : crease_of(view, rays, x, y);
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
  LocalPlanes out = std::move(reuse);
  out.rig_from_object = view.rig_from_object;
  fit_size(out.planes, width, height);
  fit_size(out.quads, std::max(0, width - 1), std::max(0, height - 1));
  fit_size(out.inverse_depth, width, height);
  const Grid grid = link_pixels(view.range, camera.lens);
  const FastLens lens(camera.lens);
  const float jitter_px = estimate_jitter(grid.q, grid.noise);
  constexpr std::size_t kRows = 32;
  parallel_chunks(static_cast<std::size_t>(height), kRows, [&](std::size_t begin, std::size_t end) {
    const WindowRows fits(
        grid.q, options.radius, static_cast<int>(begin), static_cast<int>(end - begin));
    std::optional<WindowRows> wider;
    if (options.wide_radius > 0) {
      wider.emplace(
          grid.q, options.wide_radius, static_cast<int>(begin), static_cast<int>(end - begin));
    }
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        out.planes(x, y) = {};
        out.inverse_depth(x, y) = grid.q(x, y);
        if (std::isnan(grid.q(x, y))) continue;
        const ChosenWindow chosen = choose_window(
            grid.q, fits, {x, y}, {grid.noise(x, y), jitter_px}, wider ? &*wider : nullptr);
        if (std::isnan(chosen.fit.mean)) continue;
        const Pixel pixel = settled(chosen, {grid.q(x, y), chosen.noise});
        out.inverse_depth(x, y) = pixel.q;
        out.planes(x, y) = plane_of(chosen, pixel, lens, rays(x, y));
      }
    }
  });
  const auto crease_cosine = static_cast<float>(std::cos(options.crease_rad));
  parallel_rows(out.quads.height(), [&](int y) {
    for (int x = 0; x < out.quads.width(); ++x) {
      out.quads(x, y) = quad_of(grid, out, rays, {x, y}, crease_cosine);
    }
  });
  if (options.reach_px > 0) carry_planes(out, options.reach_px);
  return out;
}

}  // namespace frangia
