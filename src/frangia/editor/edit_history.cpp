#include "frangia/editor/edit_history.h"

#include <utility>

namespace frangia {

void EditHistory::apply(const EditStep& step, const Run& run) {
  EditState next = state_;
  apply_step(next, step, run);
  deltas_.erase(deltas_.begin() + static_cast<std::ptrdiff_t>(done_), deltas_.end());
  steps_.resize(done_);
  deltas_.emplace_back(state_, next);
  steps_.push_back(step);
  state_ = std::move(next);
  ++done_;
}

bool EditHistory::undo() {
  if (done_ == 0) return false;
  deltas_[--done_].undo(state_);
  return true;
}

bool EditHistory::redo() {
  if (done_ == deltas_.size()) return false;
  deltas_[done_++].redo(state_);
  return true;
}

std::size_t EditHistory::bytes() const {
  std::size_t sum = 0;
  for (const MeshDelta& delta : deltas_)
    sum += delta.bytes();
  return sum;
}

}  // namespace frangia
