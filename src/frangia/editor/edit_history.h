#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "frangia/editor/edit_operation.h"
#include "frangia/editor/mesh_delta.h"

namespace frangia {

/// A mesh under edit with unlimited undo and redo. Both restore the state to the bit.
///
/// The history stores what each step changed. The steps form a script that reproduces the result
/// from the same mesh: edit_script.h reads and writes it.
class EditHistory {
 public:
  /// Starts a history without steps.
  explicit EditHistory(Mesh mesh) { state_.mesh = std::move(mesh); }

  /// Applies a step and drops the steps that were undone. A step that fails changes nothing.
  ///
  /// @errors   as apply_step
  void apply(const EditStep& step, const Run& run = {});

  /// Return false when no step is left to undo or to redo.
  bool undo();
  bool redo();  ///< applies the last undone step again

  /// The history after a step, for those who decide later whether it becomes the present one: a
  /// history is moved without failing. Both share the stored changes.
  ///
  /// @errors   as apply_step
  [[nodiscard]] EditHistory applied(const EditStep& step, const Run& run = {}) const;
  /// The history after the last step is undone; the same without one.
  [[nodiscard]] EditHistory undone() const;
  [[nodiscard]] EditHistory redone() const;  ///< likewise, after a step is applied again

  /// Mesh, selection and settings after the applied steps.
  [[nodiscard]] const EditState& state() const { return state_; }
  [[nodiscard]] const Mesh& mesh() const { return state_.mesh; }  ///< mesh after the applied steps
  /// All steps; those after the first `done()` were undone.
  [[nodiscard]] const std::vector<EditStep>& steps() const { return steps_; }
  [[nodiscard]] std::size_t done() const { return done_; }  ///< number of applied steps
  /// The memory of the stored changes.
  [[nodiscard]] std::size_t bytes() const;

 private:
  EditState state_;
  std::vector<EditStep> steps_;
  std::vector<std::shared_ptr<const MeshDelta>> deltas_;
  std::size_t done_ = 0;
};

}  // namespace frangia
