#include "frangia/local_fit/internal/extrapolate_planes.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Pixels without a plane that have a four-neighbour with one, row by row.
std::vector<Eigen::Vector2i> boundary_of(const LocalPlanes& view) {
  const PixelBox box = view.box.within(view.planes.width(), view.planes.height());
  std::vector<std::vector<Eigen::Vector2i>> rows(static_cast<std::size_t>(box.height()));
  parallel_rows(box.height(), [&](int row) {
    const int y = box.top + row;
    for (int x = box.left; x < box.right; ++x) {
      if (view.has_plane(x, y)) continue;
      const bool beside = view.has_plane(x - 1, y) || view.has_plane(x + 1, y) ||
                          view.has_plane(x, y - 1) || view.has_plane(x, y + 1);
      if (beside) rows[static_cast<std::size_t>(row)].emplace_back(x, y);
    }
  });
  std::vector<Eigen::Vector2i> boundary;
  for (const auto& row : rows)
    boundary.insert(boundary.end(), row.begin(), row.end());
  return boundary;
}

/// Extends planes by one pixel in each step.
void extrapolate(LocalPlanes& view, int extrapolate_px) {
  std::vector<Eigen::Vector2i> boundary = boundary_of(view);
  for (int step = 0; step < extrapolate_px; ++step) {
    std::vector<LocalPlanes::Plane> extrapolated(boundary.size());
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      for (const auto& [dx, dy] : kFourNeighbors) {
        if (!view.has_plane(boundary[i].x() + dx, boundary[i].y() + dy)) continue;
        extrapolated[i] = view.planes(boundary[i].x() + dx, boundary[i].y() + dy);
        extrapolated[i].weight = 0.0F;
        break;
      }
    }
    for (std::size_t i = 0; i < boundary.size(); ++i)
      view.planes(boundary[i].x(), boundary[i].y()) = extrapolated[i];
    std::vector<Eigen::Vector2i> next;
    for (const auto& pixel : boundary) {
      for (const auto& [dx, dy] : kFourNeighbors) {
        const int x = pixel.x() + dx;
        const int y = pixel.y() + dy;
        const bool within = x >= 0 && y >= 0 && x < view.planes.width() && y < view.planes.height();
        if (within && !view.has_plane(x, y)) next.emplace_back(x, y);
      }
    }
    boundary = std::move(next);
  }
}

/// Marks unseen quads that have a plane at a corner.
void mark_extrapolated(LocalPlanes& view) {
  const PixelBox box = view.box.within(view.quads.width(), view.quads.height());
  parallel_rows(box.height(), [&](int row) {
    const int y = box.top + row;
    for (int x = box.left; x < box.right; ++x) {
      if (view.quads(x, y).kind != LocalPlanes::Kind::Unseen) continue;
      const bool beside = view.has_plane(x, y) || view.has_plane(x + 1, y) ||
                          view.has_plane(x, y + 1) || view.has_plane(x + 1, y + 1);
      if (beside) view.quads(x, y).kind = LocalPlanes::Kind::Extrapolated;
    }
  });
}

}  // namespace

void extrapolate_planes(LocalPlanes& view, int extrapolate_px) {
  extrapolate(view, extrapolate_px);
  mark_extrapolated(view);
}

}  // namespace frangia
