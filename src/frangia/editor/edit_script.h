#pragma once

#include <filesystem>
#include <vector>

#include "frangia/core/durable_file.h"
#include "frangia/editor/edit_operation.h"

namespace frangia {

/// The steps of an edit as a file stores them.
struct EditScript {
  std::vector<EditStep> steps;  ///< applied steps, then undone ones
  std::size_t done = 0;         ///< number of steps to apply; the steps after them were undone
};

/// Reads a script. Its JSON is {"format": "frangia-edits", "version": 1, "done": 1, "steps":
/// [{"operation": "fill-holes", "value": "10mm"}]}; without "done" all steps are done.
///
/// @errors   Error(Input) that names the file when it is missing, is not such JSON, has a newer
///          version, holds an unknown operation or a wrong value, or has more steps done than it
///          has steps
[[nodiscard]] EditScript read_edit_script(const std::filesystem::path& path);

/// Writes a script.
///
/// @errors   Error(Input) when it is longer than read_edit_script reads; Error(File) when the file
///          cannot be written
void write_edit_script(const std::filesystem::path& path,
                       const EditScript& script,
                       Durability durability = Durability::Buffered);

}  // namespace frangia
