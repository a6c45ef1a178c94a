#include "frangia/surface/local_planes.h"

#include <array>
#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/surface/fast_lens.h"
#include "frangia/surface/fit_windows.h"

namespace frangia {
namespace {

constexpr float kSteepest = 7.1F;     // tan(82 degrees): steeper than that is a step, not a slope
constexpr float kNoiseSigmas = 4.0F;  // and a step must rise out of the noise
constexpr float kSmallestSigma = 1e-6F;  // of the depth: keeps the weight of perfect data finite

/// Which neighbours of a pixel lie on its surface.
enum Link : std::uint8_t { kRight = 1, kDown = 2 };

struct Grid {
  Image<float> q;      ///< inverse depth, NaN where missing
  Image<float> noise;  ///< its standard deviation
  Image<std::uint8_t> links;
};

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

/// Mean of the linked differences to a pixel's two neighbours, NaN without any: for a pixel that no
/// window holds.
float slope_between(const Grid& grid, int x, int y, Link link) {
  const int dx = link == kRight ? 1 : 0;
  const int dy = 1 - dx;
  float sum = 0.0F;
  float count = 0.0F;
  if (has(grid, x, y, link)) {
    sum += grid.q(x + dx, y + dy) - grid.q(x, y);
    ++count;
  }
  if (has(grid, x - dx, y - dy, link)) {
    sum += grid.q(x, y) - grid.q(x - dx, y - dy);
    ++count;
  }
  return sum / count;
}

/// The best window's plane at pixel (x, y), from fits that begin at row `first`.
WindowFit choose_window(const Grid& grid,
                        const Image<WindowFit>& fits,
                        int first,
                        int radius,
                        const Eigen::Vector2i& at) {
  constexpr float kNoiseFits = 2.0F;      // in variance: a centred window that fits so well is kept
  constexpr float kClearlyBetter = 0.5F;  // than a centred one
  const int x = at.x();
  const int y = at.y();
  const WindowFit& centred = fits(x, y - first);
  const float noise = grid.noise(x, y);
  if (centred.variance < kNoiseFits * noise * noise) return centred;
  WindowFit best = centred;
  float limit = std::isnan(centred.variance) ? 1e30F : kClearlyBetter * centred.variance;
  for (const int dy : {-radius, 0, radius}) {
    for (const int dx : {-radius, 0, radius}) {
      if (x + dx < 0 || x + dx >= fits.width()) continue;
      const WindowFit& shifted = fits(x + dx, y + dy - first);
      if (!(shifted.variance < limit)) continue;
      limit = shifted.variance;
      best = shifted;
      best.mean -=
          static_cast<float>(dx) * shifted.slope_x + static_cast<float>(dy) * shifted.slope_y;
    }
  }
  if (!std::isnan(best.mean)) return best;
  return {
      grid.q(x, y), slope_between(grid, x, y, kRight), slope_between(grid, x, y, kDown), kMissing};
}

/// The plane through a pixel's point, from q and its slope over the image.
Eigen::Vector3f plane_of(const WindowFit& fit, const FastLens& lens, const Eigen::Vector2f& ray) {
  const Eigen::Vector2f ab =
      lens.jacobian(ray).transpose() * Eigen::Vector2f(fit.slope_x, fit.slope_y);
  return {ab.x(), ab.y(), fit.mean - ab.dot(ray)};
}

using Corners = std::array<Eigen::Vector2i, 4>;

/// Whether the corners of a quad lie on one face, and if not whether the faces bulge or gape.
LocalPlanes::Kind kind_of(const LocalPlanes& planes,
                          const Image<Eigen::Vector2f>& rays,
                          const Corners& corners,
                          float crease_cosine) {
  bool one_face = true;
  float gap = 0.0F;  // how far the corners lie in front of one another's planes
  for (const auto& a : corners) {
    const Eigen::Vector3f& plane = planes.plane_per_mm(a.x(), a.y());
    for (const auto& b : corners) {
      const Eigen::Vector3f& other = planes.plane_per_mm(b.x(), b.y());
      if (plane.dot(other) > crease_cosine * plane.norm() * other.norm()) continue;
      one_face = false;
      const float depth = 1.0F / planes.inverse_depth(b.x(), b.y());
      gap += (1.0F - depth * plane.dot(rays(b.x(), b.y()).homogeneous())) / plane.norm();
    }
  }
  if (one_face) return LocalPlanes::Kind::Smooth;
  return gap < 0.0F ? LocalPlanes::Kind::Ridge : LocalPlanes::Kind::Valley;
}

LocalPlanes::Quad quad_of(const Grid& grid,
                          const LocalPlanes& planes,
                          const Image<Eigen::Vector2f>& rays,
                          const Eigen::Vector2i& at,
                          float crease_cosine) {
  const int x = at.x();
  const int y = at.y();
  if (!has(grid, x, y, kRight) || !has(grid, x, y, kDown) || !has(grid, x, y + 1, kRight) ||
      !has(grid, x + 1, y, kDown)) {
    return {};
  }
  const Corners corners{at, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}};
  Eigen::Vector3f plane = Eigen::Vector3f::Zero();
  float q = 0.0F;
  float variance = 0.0F;
  for (const auto& corner : corners) {
    const float noise = grid.noise(corner.x(), corner.y());
    plane += 0.25F * planes.plane_per_mm(corner.x(), corner.y());
    q += 0.25F * planes.inverse_depth(corner.x(), corner.y());
    variance += 0.25F * noise * noise;
  }
  const float q2 = q * q;
  return {1.0F / plane.norm(),
          q2 / plane.squaredNorm() * (q2 * q2 / variance),
          kind_of(planes, rays, corners, crease_cosine)};
}

}  // namespace

LocalPlanes local_planes(const View& view,
                         const CameraRays& camera,
                         const LocalPlanesOptions& options) {
  const Image<Eigen::Vector2f>& rays = camera.rays;
  require(same_size(view.range.depth_mm, rays) && same_size(view.range.sigma_mm, rays),
          "local_planes: the range grid and the camera differ in size");
  const Grid grid = link_pixels(view.range, camera.lens);
  const int width = rays.width();
  const int height = rays.height();
  LocalPlanes planes{Image<float>(width, height),
                     Image<Eigen::Vector3f>(width, height, Eigen::Vector3f::Zero()),
                     Image<LocalPlanes::Quad>(std::max(0, width - 1), std::max(0, height - 1)),
                     view.rig_from_object};
  const FastLens lens(camera.lens);
  constexpr std::size_t kRows = 32;
  parallel_chunks(static_cast<std::size_t>(height), kRows, [&](std::size_t begin, std::size_t end) {
    const int first = static_cast<int>(begin) - options.radius;
    Image<WindowFit> fits(width, static_cast<int>(end) + options.radius - first);
    fit_windows(grid.q, options.radius, first, fits);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        if (!(grid.q(x, y) > 0.0F)) continue;
        planes.inverse_depth(x, y) = grid.q(x, y);
        const WindowFit fit = choose_window(grid, fits, first, options.radius, {x, y});
        planes.plane_per_mm(x, y) = plane_of(fit, lens, rays(x, y));
      }
    }
  });
  const auto crease_cosine = static_cast<float>(std::cos(options.crease_rad));
  parallel_rows(planes.quads.height(), [&](int y) {
    for (int x = 0; x < planes.quads.width(); ++x) {
      planes.quads(x, y) = quad_of(grid, planes, rays, {x, y}, crease_cosine);
    }
  });
  return planes;
}

}  // namespace frangia
