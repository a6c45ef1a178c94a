#pragma once

#include <cstddef>
#include <vector>

#include "frangia/editor/edit_operation.h"
#include "frangia/editor/mesh_delta.h"

namespace frangia {

/// A mesh being edited: every step can be undone and done again, to the bit, without end.
///
/// What is kept of a step is what it changed. The steps are a script that makes the same mesh of
/// the same beginning anywhere: edit_script.h reads and writes it.
class EditHistory {
 public:
  explicit EditHistory(Mesh mesh) { state_.mesh = std::move(mesh); }

  /// Does a step. What was undone before is forgotten. When it fails nothing has changed.
  ///
  /// errors   as apply_step
  void apply(const EditStep& step, const Run& run = {});

  /// False when there is nothing to undo or to do again.
  bool undo();
  bool redo();

  [[nodiscard]] const EditState& state() const { return state_; }
  [[nodiscard]] const Mesh& mesh() const { return state_.mesh; }
  /// All steps, the undone ones behind the `done()` first.
  [[nodiscard]] const std::vector<EditStep>& steps() const { return steps_; }
  [[nodiscard]] std::size_t done() const { return done_; }
  /// What the memory of all steps takes.
  [[nodiscard]] std::size_t bytes() const;

 private:
  EditState state_;
  std::vector<EditStep> steps_;
  std::vector<MeshDelta> deltas_;
  std::size_t done_ = 0;
};

}  // namespace frangia
