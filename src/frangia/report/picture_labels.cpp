#include "frangia/report/picture_labels.h"

#include <algorithm>
#include <numeric>

namespace frangia {
namespace {

/// Moves the boxes of a column apart: pooled neighbors share the mean of what each would like
/// (isotonic regression by pooling adjacent violators).
void spread(std::vector<LabelBox>& boxes, double height_px, double step, double box_height) {
  struct Pool {
    double sum = 0.0;
    std::size_t count = 0;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    pools.push_back({boxes[i].top_px - static_cast<double>(i) * step, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  const double most = height_px - box_height - step * static_cast<double>(boxes.size() - 1);
  std::size_t next = 0;
  for (const Pool& pool : pools) {
    for (std::size_t k = 0; k < pool.count; ++k, ++next) {
      boxes[next].top_px =
          std::clamp(pool.mean(), 0.0, std::max(0.0, most)) + static_cast<double>(next) * step;
    }
  }
}

}  // namespace

std::vector<LabelBox> place_labels(const std::vector<PictureLabel>& labels,
                                   double width_px,
                                   double height_px,
                                   const LabelLayout& layout) {
  const double step = layout.height_px + layout.gap_px;
  const auto room = static_cast<std::size_t>((height_px + layout.gap_px) / step);
  std::vector<std::size_t> kept(std::min({labels.size(), layout.most, 2 * room}));
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
    return labels[a].at_px.x() < labels[b].at_px.x();
  });
  // Each label goes to its side; what does not fit there goes to the other one.
  auto left = static_cast<std::size_t>(std::count_if(kept.begin(), kept.end(), [&](std::size_t i) {
    return labels[i].at_px.x() < 0.5 * width_px;
  }));
  left = std::clamp(left, kept.size() > room ? kept.size() - room : 0, std::min(room, kept.size()));
  std::vector<LabelBox> placed;
  for (const bool right : {false, true}) {
    std::vector<LabelBox> column;
    for (std::size_t i = right ? left : 0; i < (right ? kept.size() : left); ++i)
      column.push_back({kept[i], right, labels[kept[i]].at_px.y() - 0.5 * layout.height_px});
    if (column.empty()) continue;
    std::stable_sort(column.begin(), column.end(), [](const LabelBox& a, const LabelBox& b) {
      return a.top_px < b.top_px;
    });
    spread(column, height_px, step, layout.height_px);
    placed.insert(placed.end(), column.begin(), column.end());
  }
  return placed;
}

}  // namespace frangia
