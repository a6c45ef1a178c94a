#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace frangia {

/// A priority queue of many items of which most are never popped. It pops the smallest item first,
/// in the same order as std::priority_queue.
///
/// The smallest items are kept sorted; the others stay unsorted until those are used up. The active
/// part is small and stays in the cache.
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

  /// Removes and returns the smallest item; nullopt when the queue is empty. May drop items for
  /// which `outdated(item)` is true.
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
    constexpr std::size_t kShare = 12;  // sorts a twelfth of the items at a time
    constexpr std::size_t kMinCount = 4096;
    later_.erase(std::remove_if(later_.begin(), later_.end(), outdated), later_.end());
    const std::size_t count = std::min(later_.size(), std::max(later_.size() / kShare, kMinCount));
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
  std::vector<Item> sorted_;  ///< ascending; items before `next_` are popped
  std::size_t next_ = 0;
  Item last_{};
  bool has_last_ = false;
  std::priority_queue<Item, std::vector<Item>, Greater> new_items_;  ///< items less than `last_`
};

}  // namespace frangia
