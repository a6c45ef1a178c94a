#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// How the next selection combines with the present one.
enum class Combine {
  Replace,  ///< the next selection replaces the present one
  Add,      ///< selects what is in either
  Within,   ///< selects what is in both
  Without   ///< selects what is in the present one and not in the next
};

/// The state that operations change.
struct EditState {
  Mesh mesh;                           ///< mesh under edit
  Selection selection;                 ///< empty: no selection was made
  Combine combine = Combine::Replace;  ///< how the next selection combines with it
  double max_sigmas = 3.0;             ///< limit of smoothing in sigma of each vertex; 0: no limit

  bool operator==(const EditState& other) const;  ///< compares all members, to the bit
};

/// An operation and its value as scripts write them: "fill-holes", "10mm".
struct EditStep {
  std::string operation;  ///< name of an EditOperation
  std::string value;      ///< value of the operation, with its unit; empty when it takes none

  bool operator==(const EditStep&) const = default;  ///< compares both strings
};

/// An operation of the editor: its name, its help text and its function.
struct EditOperation {
  const char* name;   ///< as scripts and the command line write it: "fill-holes"
  const char* group;  ///< heading in a list of operations: "Selection", ...
  const char* value;  ///< pattern of its value: "SIZE", "X,Y,Z,MM"; empty when it takes none
  const char* help;   ///< one line for a list of operations
  /// Changes a state by a value.
  std::function<void(EditState&, const std::string&, const Run&)> apply;
};

/// All operations, in the order of the manual.
[[nodiscard]] const std::vector<EditOperation>& edit_operations();

/// Finds an operation by its name.
///
/// @errors   Error(Input) when there is no such operation
[[nodiscard]] const EditOperation& edit_operation(const std::string& name);

/// Checks the operation and the value of a step without applying it.
///
/// @errors   Error(Input) that names the operation and the value and says how to write one
void check_step(const EditStep& step);

/// Applies a step. Drops the selection when the triangles change.
///
/// @errors   Error(Input) as check_step and as the operation, and when the step leaves no triangle
///          of a mesh that had some; Error(Cancelled) when `run` is stopped
void apply_step(EditState& state, const EditStep& step, const Run& run = {});

}  // namespace frangia
