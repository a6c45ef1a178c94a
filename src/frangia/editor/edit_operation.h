#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// How the next selection meets the present one.
enum class Combine { Replace, Add, Within };

/// What operations work on.
struct EditState {
  Mesh mesh;
  Selection selection;  ///< empty: nothing was selected
  Combine combine = Combine::Replace;
  double max_sigmas = 3.0;  ///< how far smoothing may move a vertex; 0: as far as it likes

  bool operator==(const EditState& other) const;
};

/// An operation and its value, as the command line and scripts write them: "fill-holes", "10mm".
struct EditStep {
  std::string operation;
  std::string value;

  bool operator==(const EditStep&) const = default;
};

struct EditOperation {
  const char* name;
  const char* group;  ///< of the operation in a list: "Selecting", ...
  const char* value;  ///< what its value is, "MM" or "X,Y,Z,MM"; empty when it takes none
  const char* help;
  std::function<void(EditState&, const std::string&, const Run&)> apply;
};

/// All operations, in the order in which a manual tells of them.
[[nodiscard]] const std::vector<EditOperation>& edit_operations();

/// errors   Error(Input) when there is no such operation, or its value is none
[[nodiscard]] const EditOperation& edit_operation(const std::string& name);

/// Checks that a step's value is one, without doing anything.
///
/// errors   Error(Input) that names the operation, the value, and how one is written
void check_step(const EditStep& step);

/// errors   Error(Input) as check_step and as the operation itself
void apply_step(EditState& state, const EditStep& step, const Run& run = {});

}  // namespace frangia
