#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "frangia/editor/edit_operation.h"

namespace frangia {

/// The difference between two states of an edit, from which either state restores the other to the
/// bit. Unchanged data is not stored.
class MeshDelta {
 public:
  /// Stores what differs between the two states.
  MeshDelta(const EditState& before, const EditState& after);

  /// Turn the state after the step into the one before it, and back.
  void undo(EditState& state) const;
  void redo(EditState& state) const;  ///< turns the state before the step into the one after it

  [[nodiscard]] std::size_t bytes() const;  ///< memory of the stored difference

 private:
  /// A range of an array's bytes that differs.
  struct Run {
    std::size_t offset = 0;
    std::vector<std::uint8_t> before, after;
  };
  struct ArrayDelta {
    std::size_t before_bytes = 0, after_bytes = 0;
    std::vector<Run> runs;
  };
  template <typename T>
  static ArrayDelta compare(const std::vector<T>& before, const std::vector<T>& after);
  template <typename T>
  static void patch(std::vector<T>& array, const ArrayDelta& delta, bool back);
  void apply(EditState& state, bool back) const;

  std::vector<ArrayDelta> arrays_;
  Combine combine_before_, combine_after_;
  double sigmas_before_, sigmas_after_;
};

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
