#include "edit_session.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

#include "counted.h"

namespace frangia {
namespace {

[[noreturn]] void fail_beyond_history(const char* action, std::size_t asked, std::size_t done) {
  throw Error(ErrorKind::Input,
              done == 0 ? fmt::format("{}: there is no step to {}", action, action)
                        : fmt::format("{} {}: the history has only {} to {}",
                                      action,
                                      asked,
                                      counted(done, "step"),
                                      action));
}

}  // namespace

EditSession::EditSession(Mesh mesh, bool with_history) {
  if (with_history) {
    history_ = std::make_unique<EditHistory>(std::move(mesh));
  } else {
    state_.mesh = std::move(mesh);
  }
}

void EditSession::apply(const EditStep& step, const Run& run) {
  run.stage(step.operation);
  if (history_ != nullptr) {
    history_->apply(step, run);
  } else {
    apply_step(state_, step, run);
    steps_.push_back(step);
  }
}

void EditSession::run_script(const EditScript& script, const Run& run) {
  // With a history, undone steps are applied and undone, so that redo can apply them again.
  const std::size_t count = history_ != nullptr ? script.steps.size() : script.done;
  for (std::size_t i = 0; i < count; ++i)
    apply(script.steps[i], run);
  if (history_ != nullptr) undo(count - script.done);
}

void EditSession::undo(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (history_ == nullptr || !history_->undo()) fail_beyond_history("undo", count, i);
}

void EditSession::redo(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (history_ == nullptr || !history_->redo()) fail_beyond_history("redo", count, i);
}

void EditSession::check_complete() const {
  const Combine how = state().combine;
  if (how == Combine::Replace) return;
  const std::string name = how == Combine::Add      ? "add"
                           : how == Combine::Within ? "within"
                                                    : "without";
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: no selection follows; put one after it, for example `select_box`", name));
}

const EditState& EditSession::state() const {
  return history_ != nullptr ? history_->state() : state_;
}

EditScript EditSession::script() const {
  if (history_ != nullptr) return {history_->steps(), history_->done()};
  return {steps_, steps_.size()};
}

}  // namespace frangia
