#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace frangia {

/// A priority queue of many items of which most are never wanted: it gives the least first, exactly
/// as std::priority_queue would.
///
/// The least of them are kept in order; the others lie in a heap of their own and are looked at
/// only once those are used up. So the part that is worked with stays small, and in the cache.
template <typename Item>
class LazyPriorityQueue {
 public:
  explicit LazyPriorityQueue(std::vector<Item> items) : later_(std::move(items)) {}

  void push(const Item& item) {
    if (has_last_ && item < last_) {
      new_items_.push(item);
    } else {
      later_.push_back(item);
    }
  }

  /// The least item, or nothing. `outdated(item)` tells of those that need not be kept.
  template <typename Outdated>
  std::optional<Item> pop(const Outdated& outdated) {
    if (next_ == sorted_.size() && new_items_.empty()) refill(outdated);
    if (next_ == sorted_.size() && new_items_.empty()) return std::nullopt;
    if (new_items_.empty() || (next_ < sorted_.size() && sorted_[next_] < new_items_.top())) {
      return sorted_[next_++];
    }
    const Item item = new_items_.top();
    new_items_.pop();
    return item;
  }

 private:
  struct Greater {
    bool operator()(const Item& a, const Item& b) const { return b < a; }
  };

  template <typename Outdated>
  void refill(const Outdated& outdated) {
    constexpr std::size_t kShare = 12;
    constexpr std::size_t kLeast = 4096;
    later_.erase(std::remove_if(later_.begin(), later_.end(), outdated), later_.end());
    const std::size_t count = std::min(later_.size(), std::max(later_.size() / kShare, kLeast));
    const auto middle = later_.begin() + static_cast<std::ptrdiff_t>(count);
    if (middle != later_.end()) std::nth_element(later_.begin(), middle, later_.end());
    sorted_.assign(later_.begin(), middle);
    std::sort(sorted_.begin(), sorted_.end());
    later_.erase(later_.begin(), middle);
    next_ = 0;
    if (sorted_.empty()) return;
    last_ = sorted_.back();
    has_last_ = true;
  }

  std::vector<Item> later_;   ///< none less than `last_`
  std::vector<Item> sorted_;  ///< ascending; those before `next_` are done
  std::size_t next_ = 0;
  Item last_{};
  bool has_last_ = false;
  std::priority_queue<Item, std::vector<Item>, Greater> new_items_;  ///< less than `last_`
};

}  // namespace frangia
