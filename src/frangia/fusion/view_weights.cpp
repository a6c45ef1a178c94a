#include "frangia/fusion/view_weights.h"

#include <algorithm>
#include <cmath>

#include "frangia/fusion/internal/block_index.h"

namespace frangia {

ViewWeights::ViewWeights(double spacing_mm, std::span<const Place> places, std::vector<View> views)
    : spacing_mm_(static_cast<float>(spacing_mm)), views_(std::move(views)) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    order.emplace_back(block_key(cell_of(places[i].point_mm)), static_cast<std::uint32_t>(i));
  std::sort(order.begin(), order.end());
  places_.reserve(places.size());
  ends_.reserve(places.size());
  for (const auto& [key, i] : order) {
    if (cells_.empty() || cells_.back().first != key)
      cells_.emplace_back(key, static_cast<std::uint32_t>(places_.size()));
    places_.push_back(places[i]);
    ends_.push_back(i + 1 < places.size() ? places[i + 1].first
                                          : static_cast<std::uint32_t>(views_.size()));
  }
}

Eigen::Vector3i ViewWeights::cell_of(const Eigen::Vector3f& point_mm) const {
  return (point_mm / spacing_mm_).array().floor().cast<int>();
}

void ViewWeights::shares_at(const Eigen::Vector3f& point_mm,
                            const Eigen::Vector3f& normal,
                            Eigen::Ref<Eigen::VectorXf> shares) const {
  constexpr float kReach = 1.5F;  // spacings; places are in the cells beside that of the point
  shares.setZero();
  const Eigen::Vector3i middle = cell_of(point_mm);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i cell = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const std::uint64_t key = block_key(cell);
    const auto found =
        std::lower_bound(cells_.begin(), cells_.end(), key, [](const auto& one, auto wanted) {
          return one.first < wanted;
        });
    if (found == cells_.end() || found->first != key) continue;
    const std::size_t end = found + 1 == cells_.end() ? places_.size() : (found + 1)->second;
    for (std::size_t place = found->second; place < end; ++place) {
      const Place& here = places_[place];
      const float ratio = (here.point_mm - point_mm).norm() / (kReach * spacing_mm_);
      if (ratio >= 1.0F || here.normal.dot(normal) <= 0.0F) continue;
      const float near = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);
      const auto views = std::span(views_).subspan(here.first, ends_[place] - here.first);
      float sum = 0.0F;
      for (const auto& [view, weight] : views)
        sum += weight;
      for (const auto& [view, weight] : views) {
        if (view < shares.size()) shares[view] += near * weight / sum;
      }
    }
  }
  const float sum = shares.sum();
  if (sum > 0.0F) shares /= sum;
}

}  // namespace frangia
