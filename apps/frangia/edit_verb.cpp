#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/editor/edit_script.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/edit_picture.h"

#include "check_can_write.h"
#include "counted.h"
#include "edit_arguments.h"
#include "edit_findings.h"
#include "edit_session.h"
#include "picture_file.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

bool needs_history(const EditArguments& arguments) {
  return std::any_of(arguments.steps.begin(), arguments.steps.end(), [](const EditStep& step) {
    return step.operation == kUndoStep || step.operation == kRedoStep;
  });
}

/// Checks all arguments before the work begins, and reads the scripts.
std::vector<EditScript> checked_scripts(const EditArguments& arguments) {
  for (const auto& path : arguments.outputs) {
    check_mesh_extension(path);
    check_can_write(path);
  }
  if (!arguments.save_script.empty()) check_can_write(arguments.save_script);
  if (!arguments.preview.empty()) check_picture_output(arguments.preview);
  std::vector<EditScript> scripts;
  for (const EditStep& step : arguments.steps) {
    if (step.operation == kScriptStep) {
      scripts.push_back(read_edit_script(step.value));
    } else if (step.operation != kUndoStep && step.operation != kRedoStep) {
      check_step(step);
    }
  }
  return scripts;
}

/// The number of triangles that an edit removes or moves, and that it adds.
struct PreviewCounts {
  std::size_t removed = 0;
  std::size_t added = 0;
};

/// Draws the mesh before and after the steps.
PreviewCounts draw_preview(const Mesh& before,
                           const EditState& after,
                           const std::filesystem::path& path,
                           const Run& run) {
  run.stage("preview");
  const EditPreview preview = edit_preview(before, after.mesh, run);
  RenderOptions options;
  options.width_px = 640;
  options.height_px = 640;
  options.samples_across = 2;
  write_png(path, edit_picture(before, after, preview, options, run));
  return {count_selected(preview.removed), count_selected(preview.added)};
}

std::vector<std::filesystem::path> written_files(const EditArguments& arguments) {
  std::vector<std::filesystem::path> files = arguments.outputs;
  for (const auto& path : {arguments.save_script, arguments.preview})
    if (!path.empty()) files.push_back(path);
  return files;
}

void print_unsaved(const EditArguments& arguments) {
  if (arguments.outputs.empty() && !arguments.steps.empty())
    print_text("the mesh was not saved; -o names a file for it\n");
}

void report(const Mesh& mesh,
            const std::optional<PreviewCounts>& counts,
            const EditArguments& arguments,
            Terminal& terminal,
            const Run& run) {
  if (terminal.json) {
    nlohmann::ordered_json json = findings_json(mesh_findings(mesh, run));
    if (counts) json["preview"] = {{"removed", counts->removed}, {"added", counts->added}};
    for (const auto& stage : terminal.stage_seconds())
      json["seconds"][stage.first] = stage.second;
    json["warnings"] = terminal.warnings();
    json["outputs"] = nlohmann::ordered_json::array();
    for (const auto& path : written_files(arguments))
      json["outputs"].push_back(path.string());
    print_json(json);
  } else if (arguments.list) {
    const MeshFindings found = mesh_findings(mesh, run);
    terminal.finish();
    print_findings(found);
    print_unsaved(arguments);
  } else if (!terminal.quiet) {
    terminal.finish();
    print_text("{}\n",
               mesh.empty() ? counted(mesh.vertices_mm.size(), "point")
                            : counted(mesh.triangles.size(), "triangle"));
    print_unsaved(arguments);
  }
  if (counts && !terminal.json && !terminal.quiet) {
    print_text("preview: {} would be removed or moved, {} added\n",
               counted(counts->removed, "triangle"),
               counts->added);
  }
  for (const auto& path : written_files(arguments))
    terminal.print_written(path.string());
}

Mesh read_triangles(const EditArguments& arguments, const Run& run) {
  const std::filesystem::path& path = arguments.mesh;
  Mesh mesh = read_mesh(path, run, arguments.read);
  const bool converts = arguments.steps.empty() && arguments.preview.empty();
  if (mesh.empty() && !converts) {
    const std::size_t points = mesh.vertices_mm.size();
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the file has {} and no triangles, which edits need; without edits, "
                    "-o writes the points in another format",
                    path.string(),
                    counted(points, "point")));
  }
  return mesh;
}

void edit(const EditArguments& arguments, Terminal& terminal) {
  const std::vector<EditScript> scripts = checked_scripts(arguments);
  const Run run = terminal.run();
  run.stage("read");
  Mesh mesh = read_triangles(arguments, run);
  const Mesh before = arguments.preview.empty() ? Mesh() : mesh;
  EditSession session(std::move(mesh), needs_history(arguments));
  auto script = scripts.begin();
  for (const EditStep& step : arguments.steps) {
    if (step.operation == kScriptStep) {
      session.run_script(*script++, run);
    } else if (step.operation == kUndoStep) {
      session.undo(std::stoul(step.value));
    } else if (step.operation == kRedoStep) {
      session.redo(std::stoul(step.value));
    } else {
      session.apply(step, run);
    }
  }
  session.check_complete();
  run.stage("write");
  for (const auto& path : arguments.outputs)
    write_mesh(path, session.mesh(), arguments.write, run);
  if (!arguments.save_script.empty()) write_edit_script(arguments.save_script, session.script());
  std::optional<PreviewCounts> counts;
  if (!arguments.preview.empty()) {
    counts = draw_preview(before, session.state(), arguments.preview, run);
  }
  run.stage("list");
  report(session.mesh(), counts, arguments, terminal, run);
}

}  // namespace

void add_edit_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<EditArguments>();
  CLI::App* verb = program.add_subcommand(
      "edit", "repair and modify a mesh: operations apply in the order given");
  verb->footer(
      "example:\n  frangia edit bust.ply --remove-islands 2mm --fill-holes 10mm --decimate 0.01mm "
      "-o bust.dxf\n  frangia edit bust.ply --select-box 0,0,0,20,20,20 --within --select-normal "
      "0,0,1,30deg --delete -o cut.ply");
  add_edit_arguments(*verb, *arguments);
  verb->callback([arguments, &terminal] { edit(*arguments, terminal); });
}

}  // namespace frangia
