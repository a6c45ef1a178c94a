#include "frangia/editor/edit_history.h"

#include <type_traits>

namespace frangia {

static_assert(std::is_nothrow_move_assignable_v<EditHistory>,
              "a history that was prepared becomes the present one without failing");

EditHistory EditHistory::applied(const EditStep& step, const Run& run) const {
  EditHistory next = *this;
  apply_step(next.state_, step, run);
  next.deltas_.resize(done_);
  next.steps_.resize(done_);
  next.deltas_.push_back(std::make_shared<const MeshDelta>(state_, next.state_));
  next.steps_.push_back(step);
  ++next.done_;
  return next;
}

EditHistory EditHistory::undone() const {
  EditHistory next = *this;
  static_cast<void>(next.undo());
  return next;
}

EditHistory EditHistory::redone() const {
  EditHistory next = *this;
  static_cast<void>(next.redo());
  return next;
}

void EditHistory::apply(const EditStep& step, const Run& run) {
  *this = applied(step, run);
}

bool EditHistory::undo() {
  if (done_ == 0) return false;
  deltas_[--done_]->undo(state_);
  return true;
}

bool EditHistory::redo() {
  if (done_ == deltas_.size()) return false;
  deltas_[done_++]->redo(state_);
  return true;
}

std::size_t EditHistory::bytes() const {
  std::size_t sum = 0;
  for (const auto& delta : deltas_)
    sum += delta->bytes();
  return sum;
}

}  // namespace frangia
