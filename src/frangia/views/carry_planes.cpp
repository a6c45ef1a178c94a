#include "frangia/views/carry_planes.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "frangia/core/beside.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Missing pixels beside one that has a plane, row by row.
std::vector<Eigen::Vector2i> find_rim(const LocalPlanes& view) {
  std::vector<std::vector<Eigen::Vector2i>> rows(static_cast<std::size_t>(view.planes.height()));
  parallel_rows(view.planes.height(), [&](int y) {
    for (int x = 0; x < view.planes.width(); ++x) {
      if (view.has_plane(x, y)) continue;
      const bool beside = view.has_plane(x - 1, y) || view.has_plane(x + 1, y) ||
                          view.has_plane(x, y - 1) || view.has_plane(x, y + 1);
      if (beside) rows[static_cast<std::size_t>(y)].emplace_back(x, y);
    }
  });
  std::vector<Eigen::Vector2i> rim;
  for (const auto& row : rows)
    rim.insert(rim.end(), row.begin(), row.end());
  return rim;
}

/// Carries planes on to missing pixels, one pixel farther each time.
void carry_on(LocalPlanes& view, int reach_px) {
  std::vector<Eigen::Vector2i> rim = find_rim(view);
  for (int step = 0; step < reach_px; ++step) {
    std::vector<LocalPlanes::Plane> carried(rim.size());
    for (std::size_t i = 0; i < rim.size(); ++i) {
      for (const auto& [dx, dy] : kBeside) {
        if (!view.has_plane(rim[i].x() + dx, rim[i].y() + dy)) continue;
        carried[i] = view.planes(rim[i].x() + dx, rim[i].y() + dy);
        carried[i].weight = 0.0F;
        break;
      }
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
      view.planes(rim[i].x(), rim[i].y()) = carried[i];
    std::vector<Eigen::Vector2i> next;
    for (const auto& pixel : rim) {
      for (const auto& [dx, dy] : kBeside) {
        const int x = pixel.x() + dx;
        const int y = pixel.y() + dy;
        const bool within = x >= 0 && y >= 0 && x < view.planes.width() && y < view.planes.height();
        if (within && !view.has_plane(x, y)) next.emplace_back(x, y);
      }
    }
    rim = std::move(next);
  }
}

/// Unseen quads that a plane reaches.
void mark_beside(LocalPlanes& view) {
  parallel_rows(view.quads.height(), [&](int y) {
    for (int x = 0; x < view.quads.width(); ++x) {
      if (view.quads(x, y).kind != LocalPlanes::Kind::Unseen) continue;
      const bool beside = view.has_plane(x, y) || view.has_plane(x + 1, y) ||
                          view.has_plane(x, y + 1) || view.has_plane(x + 1, y + 1);
      if (beside) view.quads(x, y).kind = LocalPlanes::Kind::Beside;
    }
  });
}

}  // namespace

void carry_planes(LocalPlanes& view, int reach_px) {
  carry_on(view, reach_px);
  mark_beside(view);
}

}  // namespace frangia
