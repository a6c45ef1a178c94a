#include "frangia/surface/local_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr float kSteepest = 7.1F;     // tan(82 degrees): steeper than that is a step, not a slope
constexpr float kNoiseSigmas = 4.0F;  // and a step must rise out of the noise

constexpr float kSmallestSigma = 1e-6F;  // of the depth: keeps the weight of perfect data finite

/// Which neighbours of a pixel lie on its surface.
enum Link : std::uint8_t { kRight = 1, kDown = 2 };

struct Grid {
  Image<float> q;      ///< inverse depth, 0 where missing
  Image<float> reach;  ///< how far q may differ from a neighbour's
  Image<std::uint8_t> links;
};

Image<float> inverse_of(const RangeGrid& range) {
  Image<float> q(range.depth_mm.width(), range.depth_mm.height());
  parallel_rows(q.height(), [&](int y) {
    for (int x = 0; x < q.width(); ++x) {
      const float depth = range.depth_mm(x, y);
      q(x, y) = depth > 0.0F && range.sigma_mm(x, y) >= 0.0F ? 1.0F / depth : 0.0F;
    }
  });
  return q;
}

Grid link_pixels(const RangeGrid& range, const Lens& camera) {
  Grid grid{inverse_of(range), {}, {}};
  const int width = grid.q.width();
  const int height = grid.q.height();
  grid.reach = Image<float>(width, height);
  grid.links = Image<std::uint8_t>(width, height);
  const auto slope = static_cast<float>(kSteepest / camera.focal_px.mean());
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float q = grid.q(x, y);
      if (q > 0.0F) grid.reach(x, y) = q * slope + kNoiseSigmas * range.sigma_mm(x, y) * q * q;
    }
  });
  const auto linked = [&](int x, int y, int to_x, int to_y) {
    const float here = grid.q(x, y);
    const float there = grid.q(to_x, to_y);
    return here > 0.0F && there > 0.0F &&
           std::abs(here - there) < std::max(grid.reach(x, y), grid.reach(to_x, to_y));
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

/// Slope of q across one axis: the mean of the linked differences in the rows about a pixel, which
/// over a full 3 x 3 neighbourhood is the least-squares plane.
struct Slope {
  float sum = 0.0F;
  int count = 0;

  void add(const Grid& grid, int x, int y, Link link) {
    if (x < 0 || y < 0 || (grid.links(x, y) & link) == 0) return;
    const bool right = link == kRight;
    sum += grid.q(right ? x + 1 : x, right ? y : y + 1) - grid.q(x, y);
    ++count;
  }
};

bool has(const Grid& grid, int x, int y, Link link) {
  return x >= 0 && y >= 0 && (grid.links(x, y) & link) != 0;
}

Slope slope_x(const Grid& grid, int x, int y) {
  Slope slope;
  for (const int row : {y - 1, y, y + 1}) {
    if (row != y && !has(grid, x, std::min(row, y), kDown)) continue;
    slope.add(grid, x - 1, row, kRight);
    slope.add(grid, x, row, kRight);
  }
  return slope;
}

Slope slope_y(const Grid& grid, int x, int y) {
  Slope slope;
  for (const int column : {x - 1, x, x + 1}) {
    if (column != x && !has(grid, std::min(column, x), y, kRight)) continue;
    slope.add(grid, column, y - 1, kDown);
    slope.add(grid, column, y, kDown);
  }
  return slope;
}

/// The plane through a pixel's point, from the slope of q over the image.
Eigen::Vector3f plane_of(float q,
                         const Eigen::Vector2f& per_pixel,
                         const Lens& camera,
                         const Eigen::Vector2f& ray) {
  const Eigen::Matrix2f pixels_per_ray =
      (camera.focal_px.asDiagonal() * camera.distort_jacobian(ray.cast<double>())).cast<float>();
  const Eigen::Vector2f ab = pixels_per_ray.transpose() * per_pixel;
  return {ab.x(), ab.y(), q - ab.dot(ray)};
}

LocalPlanes::Quad quad_of(
    const Grid& grid, const LocalPlanes& planes, const RangeGrid& range, int x, int y) {
  if (!has(grid, x, y, kRight) || !has(grid, x, y, kDown) || !has(grid, x, y + 1, kRight) ||
      !has(grid, x + 1, y, kDown)) {
    return {};
  }
  Eigen::Vector3f plane = Eigen::Vector3f::Zero();
  float q = 0.0F;
  float variance = 0.0F;
  for (const int row : {y, y + 1}) {
    for (const int column : {x, x + 1}) {
      plane += 0.25F * planes.plane_per_mm(column, row);
      q += 0.25F * planes.inverse_depth(column, row);
      const float sigma =
          std::max(range.sigma_mm(column, row), kSmallestSigma * range.depth_mm(column, row));
      variance += 0.25F * sigma * sigma;
    }
  }
  return {1.0F / plane.norm(), q * q / plane.squaredNorm() / variance};
}

}  // namespace

LocalPlanes local_planes(const View& view, const CameraRays& camera) {
  const RangeGrid& range = view.range;
  const Image<Eigen::Vector2f>& rays = camera.rays;
  require(same_size(range.depth_mm, rays) && same_size(range.sigma_mm, rays),
          "local_planes: the range grid and the camera differ in size");
  const Grid grid = link_pixels(range, camera.lens);
  const int width = rays.width();
  const int height = rays.height();
  LocalPlanes planes{grid.q,
                     Image<Eigen::Vector3f>(width, height, Eigen::Vector3f::Zero()),
                     Image<LocalPlanes::Quad>(std::max(0, width - 1), std::max(0, height - 1)),
                     view.rig_from_object};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (!(grid.q(x, y) > 0.0F)) continue;
      const Slope across = slope_x(grid, x, y);
      const Slope along = slope_y(grid, x, y);
      if (across.count == 0 || along.count == 0) continue;
      const Eigen::Vector2f per_pixel(across.sum / static_cast<float>(across.count),
                                      along.sum / static_cast<float>(along.count));
      planes.plane_per_mm(x, y) = plane_of(grid.q(x, y), per_pixel, camera.lens, rays(x, y));
    }
  });
  parallel_rows(planes.quads.height(), [&](int y) {
    for (int x = 0; x < planes.quads.width(); ++x) {
      planes.quads(x, y) = quad_of(grid, planes, range, x, y);
    }
  });
  return planes;
}

}  // namespace frangia
