#include "frangia/fusion/internal/block_index.h"

#include <algorithm>
#include <utility>

namespace frangia {

void BlockIndex::add(std::uint64_t key, std::uint32_t number) {
  if (2 * (size_ + 1) > slots_.size()) {
    constexpr std::size_t kFirst = 1024;
    std::vector<Slot> before(std::max(kFirst, 2 * slots_.size()));
    std::swap(before, slots_);
    for (const Slot& slot : before) {
      if (slot.number != kNone) slots_[slot_of(slot.key)] = slot;
    }
  }
  slots_[slot_of(key)] = {key, number};
  ++size_;
}

}  // namespace frangia
