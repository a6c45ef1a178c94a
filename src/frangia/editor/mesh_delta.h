#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace frangia
