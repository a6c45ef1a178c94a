#include "frangia/surface/local_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

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
  const Image<float>& q;  ///< inverse depth
  Image<float> noise;     ///< its standard deviation
  Image<std::uint8_t> links;
};

template <typename T>
void fit_size(Image<T>& image, int width, int height) {
  if (image.width() != width || image.height() != height) image = Image<T>(width, height);
}

/// Fills `q`.

Grid link_pixels(Image<float>& q, const RangeGrid& range, const Lens& camera) {
  const int width = range.depth_mm.width();
  const int height = range.depth_mm.height();
  fit_size(q, width, height);
  Grid grid{q, Image<float>(width, height), Image<std::uint8_t>(width, height)};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float depth = range.depth_mm(x, y);
      const float sigma = std::max(range.sigma_mm(x, y), kSmallestSigma * depth);
      const bool seen = depth > 0.0F && sigma >= 0.0F;
      q(x, y) = seen ? 1.0F / depth : kMissing;
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
LocalPlanes::Plane plane_of(const WindowFit& fit,
                            const FastLens& lens,
                            const Eigen::Vector2f& ray) {
  const Eigen::Vector2f ab =
      lens.jacobian(ray).transpose() * Eigen::Vector2f(fit.slope_x, fit.slope_y);
  const Eigen::Vector3f abc(ab.x(), ab.y(), fit.mean - ab.dot(ray));
  const float distance = 1.0F / abc.norm();
  return {-distance * abc, distance};
}

bool has_plane(const Image<LocalPlanes::Plane>& planes, int x, int y) {
  return x >= 0 && y >= 0 && x < planes.width() && y < planes.height() &&
         planes(x, y).distance_mm > 0.0F;
}

constexpr std::array<std::array<int, 2>, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Missing pixels beside one that has a plane, row by row.
std::vector<Eigen::Vector2i> find_rim(const Image<LocalPlanes::Plane>& planes) {
  std::vector<std::vector<Eigen::Vector2i>> rows(static_cast<std::size_t>(planes.height()));
  parallel_rows(planes.height(), [&](int y) {
    for (int x = 0; x < planes.width(); ++x) {
      if (has_plane(planes, x, y)) continue;
      const bool beside = has_plane(planes, x - 1, y) || has_plane(planes, x + 1, y) ||
                          has_plane(planes, x, y - 1) || has_plane(planes, x, y + 1);
      if (beside) rows[static_cast<std::size_t>(y)].emplace_back(x, y);
    }
  });
  std::vector<Eigen::Vector2i> rim;
  for (const auto& row : rows)
    rim.insert(rim.end(), row.begin(), row.end());
  return rim;
}

/// Carries planes on to missing pixels, one pixel farther each time.
void carry_on(Image<LocalPlanes::Plane>& planes, int reach_px) {
  std::vector<Eigen::Vector2i> rim =
      reach_px > 0 ? find_rim(planes) : std::vector<Eigen::Vector2i>();
  for (int step = 0; step < reach_px; ++step) {
    std::vector<LocalPlanes::Plane> carried(rim.size());
    for (std::size_t i = 0; i < rim.size(); ++i) {
      for (const auto& [dx, dy] : kBeside) {
        if (!has_plane(planes, rim[i].x() + dx, rim[i].y() + dy)) continue;
        carried[i] = planes(rim[i].x() + dx, rim[i].y() + dy);
        break;
      }
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
      planes(rim[i].x(), rim[i].y()) = carried[i];
    std::vector<Eigen::Vector2i> next;
    for (const auto& pixel : rim) {
      for (const auto& [dx, dy] : kBeside) {
        const int x = pixel.x() + dx;
        const int y = pixel.y() + dy;
        const bool within = x >= 0 && y >= 0 && x < planes.width() && y < planes.height();
        if (within && !has_plane(planes, x, y)) next.emplace_back(x, y);
      }
    }
    rim = std::move(next);
  }
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
  float distance = 0.0F;
  float q = 0.0F;
  float variance = 0.0F;
  for (const auto& corner : corners_of(x, y)) {
    const float noise = grid.noise(corner.x(), corner.y());
    distance += 0.25F * view.planes(corner.x(), corner.y()).distance_mm;
    q += 0.25F * grid.q(corner.x(), corner.y());
    variance += 0.25F * noise * noise;
  }
  const float cosine = q * distance;
  const float sigma2 = variance / (q * q * q * q);
  return {distance,
          cosine * cosine / sigma2,
          is_smooth(view.planes, x, y, crease_cosine) ? LocalPlanes::Kind::Smooth
                                                      : crease_of(view, rays, x, y)};
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
  const Grid grid = link_pixels(out.inverse_depth, view.range, camera.lens);
  const FastLens lens(camera.lens);
  constexpr std::size_t kRows = 32;
  parallel_chunks(static_cast<std::size_t>(height), kRows, [&](std::size_t begin, std::size_t end) {
    const int first = static_cast<int>(begin) - options.radius;
    Image<WindowFit> fits(width, static_cast<int>(end) + options.radius - first);
    fit_windows(grid.q, options.radius, first, fits);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        out.planes(x, y) = {};
        if (std::isnan(grid.q(x, y))) continue;
        const WindowFit fit = choose_window(grid, fits, first, options.radius, {x, y});
        out.planes(x, y) = plane_of(fit, lens, rays(x, y));
      }
    }
  });
  carry_on(out.planes, options.reach_px);
  const auto crease_cosine = static_cast<float>(std::cos(options.crease_rad));
  parallel_rows(out.quads.height(), [&](int y) {
    for (int x = 0; x < out.quads.width(); ++x) {
      LocalPlanes::Quad& quad = out.quads(x, y);
      quad = quad_of(grid, out, rays, {x, y}, crease_cosine);
      if (quad.kind != LocalPlanes::Kind::Unseen || options.reach_px == 0) continue;
      const auto corners = corners_of(x, y);
      const bool beside = std::any_of(corners.begin(), corners.end(), [&](const auto& corner) {
        return has_plane(out.planes, corner.x(), corner.y());
      });
      if (beside) quad.kind = LocalPlanes::Kind::Beside;
    }
  });
  return out;
}

}  // namespace frangia
