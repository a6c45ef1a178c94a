#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "frangia/editor/edit_history.h"
#include "frangia/editor/edit_script.h"

namespace frangia {

/// The mesh that `frangia edit` works on. It has a history only if undo or redo needs one, because
/// a history takes memory.
class EditSession {
 public:
  EditSession(Mesh mesh, bool with_history);

  /// @errors   as apply_step
  void apply(const EditStep& step, const Run& run);
  /// Applies the steps of a script, then undoes those that it holds as undone.
  void run_script(const EditScript& script, const Run& run);
  /// @errors   Error(Input) when fewer steps can be undone or redone
  void undo(std::size_t count);
  void redo(std::size_t count);
  /// Checks that no operation waits for another one to follow.
  ///
  /// @errors   Error(Input) when `add`, `within` or `without` is not followed by a selection
  void check_complete() const;

  [[nodiscard]] const EditState& state() const;
  [[nodiscard]] const Mesh& mesh() const { return state().mesh; }
  [[nodiscard]] EditScript script() const;

 private:
  std::unique_ptr<EditHistory> history_;
  EditState state_;              ///< without a history
  std::vector<EditStep> steps_;  ///< without a history
};

}  // namespace frangia
