#pragma once

#include <filesystem>
#include <vector>

#include <CLI/CLI.hpp>

#include "frangia/editor/edit_operation.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"

namespace frangia {

// Steps in addition to edit_operations(): they act on the history.
constexpr const char* kScriptStep = "script";  ///< its value is the path of a script
constexpr const char* kUndoStep = "undo";      ///< its value is the number of steps
constexpr const char* kRedoStep = "redo";      ///< its value is the number of steps

struct EditArguments {
  std::filesystem::path mesh;
  std::vector<std::filesystem::path> outputs;
  std::vector<EditStep> steps;  ///< in the order of the command line
  std::filesystem::path save_script;
  std::filesystem::path preview;
  WriteOptions write;
  ReadOptions read;
  bool list = false;
};

/// Declares the options of `frangia edit`. Parsing fills `arguments`, which must outlive it.
void add_edit_arguments(CLI::App& verb, EditArguments& arguments);

}  // namespace frangia
