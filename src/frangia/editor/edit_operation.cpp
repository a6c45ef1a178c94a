#include "frangia/editor/edit_operation.h"

#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"

namespace frangia {
namespace {

/// Compares vectors as bytes, so that NaN equals itself.
template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Removes the name of a library function in front of an error: users know the operation's name.
std::string without_function(const std::string& text) {
  const std::size_t colon = text.find(": ");
  const bool has_name = colon != std::string::npos && text.find(' ') > colon;
  return has_name ? text.substr(colon + 2) : text;
}

}  // namespace

bool EditState::operator==(const EditState& other) const {
  return same_bytes(mesh.vertices_mm, other.mesh.vertices_mm) &&
         same_bytes(mesh.triangles, other.mesh.triangles) &&
         same_bytes(mesh.normals, other.mesh.normals) &&
         same_bytes(mesh.sigma_mm, other.mesh.sigma_mm) &&
         same_bytes(mesh.sigma_noise_mm, other.mesh.sigma_noise_mm) &&
         same_bytes(mesh.sigma_systematic_mm, other.mesh.sigma_systematic_mm) &&
         same_bytes(mesh.views, other.mesh.views) && same_bytes(mesh.colors, other.mesh.colors) &&
         same_bytes(mesh.vertex_marks, other.mesh.vertex_marks) &&
         same_bytes(mesh.triangle_marks, other.mesh.triangle_marks) &&
         same_bytes(selection, other.selection) && combine == other.combine &&
         max_sigmas == other.max_sigmas;
}

const std::vector<EditOperation>& edit_operations() {
  static const std::vector<EditOperation> kAll = [] {
    std::vector<EditOperation> all = selection_operations();
    for (auto kind : {repair_operations, modify_operations}) {
      for (EditOperation& operation : kind())
        all.push_back(std::move(operation));
    }
    return all;
  }();
  return kAll;
}

const EditOperation& edit_operation(const std::string& name) {
  for (const EditOperation& operation : edit_operations())
    if (name == operation.name) return operation;
  throw Error(ErrorKind::Input,
              fmt::format("there is no operation '{}'; `help` lists the operations", name));
}

void check_step(const EditStep& step) {
  const EditOperation& operation = edit_operation(step.operation);
  try {
    const std::string pattern = operation.value;
    if (pattern.empty()) {
      require(step.value.empty(), "the operation takes no value");
    } else if (pattern == "MARK") {
      static_cast<void>(edit_mark(step.value));
    } else if (pattern == kOutlinePattern) {
      static_cast<void>(edit_outline(step.value));
    } else {
      static_cast<void>(edit_numbers(pattern, step.value));
    }
  } catch (const Error& error) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", step.operation, error.what()));
  }
}

void apply_step(EditState& state, const EditStep& step, const Run& run) {
  check_step(step);
  run.check();
  const bool had_triangles = !state.mesh.empty();
  try {
    edit_operation(step.operation).apply(state, step.value, run);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input) throw;
    throw Error(ErrorKind::Input,
                fmt::format("{}: {}", step.operation, without_function(error.what())));
  }
  if (had_triangles && state.mesh.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no triangle of the mesh would be left", step.operation));
  }
  // A selection holds one flag per triangle: it has no meaning for other triangles.
  if (state.selection.size() != state.mesh.triangles.size()) state.selection.clear();
}

}  // namespace frangia
