#pragma once

#include <filesystem>
#include <vector>

#include "frangia/editor/edit_operation.h"

namespace frangia {

/// The steps of an edit as a file keeps them.
struct EditScript {
  std::vector<EditStep> steps;
  std::size_t done = 0;  ///< how many of them are done; those behind were undone
};

/// JSON: {"format": "frangia-edits", "version": 1, "done": 1, "steps": [{"operation":
/// "fill-holes", "value": "10mm"}]}; without "done" all are done.
///
/// errors   Error(Input) that names the file: missing, no such JSON, too new, an operation or a
/// value
///          that is none
[[nodiscard]] EditScript read_edit_script(const std::filesystem::path& path);

/// errors   Error(File) when it cannot be written
void write_edit_script(const std::filesystem::path& path, const EditScript& script);

}  // namespace frangia
