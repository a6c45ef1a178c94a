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
#include "frangia/editor/edit_history.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/editor/edit_script.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/edit_picture.h"

#include "edit_findings.h"
#include "picture_file.h"
#include "verbs.h"
#include "write_options.h"

namespace frangia {
namespace {

// Steps that are none of edit_operations(): they work on the history.
constexpr const char* kScript = "script";
constexpr const char* kUndo = "undo";
constexpr const char* kRedo = "redo";

struct EditArguments {
  std::filesystem::path mesh;
  std::vector<std::filesystem::path> outputs;
  std::vector<EditStep> steps;  ///< in the order given
  std::filesystem::path save_script;
  std::filesystem::path preview;
  WriteOptions write;
  bool list = false;
};

/// The edits of a mesh, with a history when something asks for one: it takes memory.
class Session {
 public:
  Session(Mesh mesh, bool with_history) {
    if (with_history) {
      history_ = std::make_unique<EditHistory>(std::move(mesh));
    } else {
      state_.mesh = std::move(mesh);
    }
  }

  void apply(const EditStep& step, const Run& run) {
    run.stage(step.operation);
    if (history_ != nullptr) {
      history_->apply(step, run);
    } else {
      apply_step(state_, step, run);
      steps_.push_back(step);
    }
  }
  void step_history(const EditStep& step, const Run& run) {
    const auto count = std::stoul(step.value);
    for (std::size_t i = 0; i < count; ++i) {
      const bool moved = step.operation == kUndo ? history_->undo() : history_->redo();
      if (moved) continue;
      run.warn(fmt::format("there was nothing left to {}", step.operation));
      return;
    }
  }
  void run_script(const EditScript& script, const Run& run) {
    // Steps that were undone are done and undone, so that they can be done again.
    const std::size_t count = history_ != nullptr ? script.steps.size() : script.done;
    for (std::size_t i = 0; i < count; ++i)
      apply(script.steps[i], run);
    for (std::size_t i = script.done; i < count; ++i)
      static_cast<void>(history_->undo());
  }

  [[nodiscard]] const EditState& state() const {
    return history_ != nullptr ? history_->state() : state_;
  }
  [[nodiscard]] const Mesh& mesh() const { return state().mesh; }
  [[nodiscard]] EditScript script() const {
    if (history_ != nullptr) return {history_->steps(), history_->done()};
    return {steps_, steps_.size()};
  }

 private:
  std::unique_ptr<EditHistory> history_;
  EditState state_;
  std::vector<EditStep> steps_;
};

bool asks_for_history(const EditArguments& arguments) {
  return std::any_of(arguments.steps.begin(), arguments.steps.end(), [](const EditStep& step) {
    return step.operation == kUndo || step.operation == kRedo;
  });
}

/// What can be found wrong before the work is found before it.
std::vector<EditScript> checked(const EditArguments& arguments) {
  for (const auto& path : arguments.outputs)
    check_mesh_extension(path);
  if (!arguments.preview.empty()) check_picture_output(arguments.preview);
  std::vector<EditScript> scripts;
  for (const EditStep& step : arguments.steps) {
    if (step.operation == kScript) {
      scripts.push_back(read_edit_script(step.value));
    } else if (step.operation != kUndo && step.operation != kRedo) {
      check_step(step);
    }
  }
  return scripts;
}

/// How many triangles an edit takes or moves, and how many it makes.
struct Change {
  std::size_t removed = 0;
  std::size_t added = 0;
};

/// Draws what the steps would do.
Change draw_preview(const Mesh& before,
                    const EditState& after,
                    const std::filesystem::path& path,
                    const Run& run) {
  if (before.empty()) {
    throw Error(ErrorKind::Input, "the mesh has no triangles: there is nothing to draw");
  }
  run.stage("preview");
  const EditPreview preview = edit_preview(before, after.mesh, run);
  RenderOptions options;
  options.width_px = 640;
  options.height_px = 640;
  options.samples_across = 2;
  write_png(path, edit_picture(before, after, preview, options, run));
  return {count_selected(preview.removed), count_selected(preview.added)};
}

void report(const Mesh& mesh,
            const std::optional<Change>& change,
            const EditArguments& arguments,
            Terminal& terminal,
            const Run& run) {
  if (terminal.json) {
    nlohmann::ordered_json json = findings_json(mesh_findings(mesh, run));
    if (change) json["preview"] = {{"removed", change->removed}, {"added", change->added}};
    for (const auto& stage : terminal.stage_seconds())
      json["seconds"][stage.first] = stage.second;
    fmt::print("{}\n", json.dump(2));
  } else if (arguments.list) {
    const MeshFindings found = mesh_findings(mesh, run);
    terminal.finish();
    print_findings(found);
  } else if (!terminal.quiet) {
    terminal.finish();
    fmt::print("{} triangles\n", mesh.triangles.size());
  }
  if (change && !terminal.json && !terminal.quiet) {
    fmt::print("preview: {} triangles would go or move, {} would come: {}\n",
               change->removed,
               change->added,
               arguments.preview.string());
  }
}

void edit(const EditArguments& arguments, Terminal& terminal) {
  const std::vector<EditScript> scripts = checked(arguments);
  const Run run = terminal.run();
  run.stage("read");
  Mesh mesh = read_mesh(arguments.mesh, run);
  const Mesh before = arguments.preview.empty() ? Mesh() : mesh;
  Session session(std::move(mesh), asks_for_history(arguments));
  auto script = scripts.begin();
  for (const EditStep& step : arguments.steps) {
    if (step.operation == kScript) {
      session.run_script(*script++, run);
    } else if (step.operation == kUndo || step.operation == kRedo) {
      session.step_history(step, run);
    } else {
      session.apply(step, run);
    }
  }
  run.stage("write");
  for (const auto& path : arguments.outputs)
    write_mesh(path, session.mesh(), arguments.write, run);
  if (!arguments.save_script.empty()) write_edit_script(arguments.save_script, session.script());
  std::optional<Change> change;
  if (!arguments.preview.empty()) {
    change = draw_preview(before, session.state(), arguments.preview, run);
  }
  run.stage("list");
  report(session.mesh(), change, arguments, terminal, run);
}

void add_operations(CLI::App& verb, EditArguments& arguments) {
  for (const EditOperation& operation : edit_operations()) {
    const std::string name = operation.name;
    CLI::Option* option = nullptr;
    if (*operation.value == 0) {
      option = verb.add_flag_callback(
          "--" + name,
          [&arguments, name] {
            arguments.steps.push_back({name, ""});
          },
          operation.help);
    } else {
      option = verb.add_option_function<std::string>(
          "--" + name,
          [&arguments, name](const std::string& value) {
            arguments.steps.push_back({name, value});
          },
          operation.help);
      option->type_name(operation.value);
    }
    option->trigger_on_parse()->group(operation.group);
  }
}

void add_history(CLI::App& verb, EditArguments& arguments) {
  constexpr const char* kGroup = "History";
  verb.add_option_function<std::string>(
          "--script",
          [&arguments](const std::string& value) {
            arguments.steps.push_back({kScript, value});
          },
          "do the steps that a script keeps")
      ->type_name("FILE.json")
      ->trigger_on_parse()
      ->group(kGroup);
  verb.add_option("--save-script", arguments.save_script, "keep all steps as a script")
      ->type_name("FILE.json")
      ->group(kGroup);
  for (const char* name : {kUndo, kRedo}) {
    verb.add_option_function<unsigned>(
            fmt::format("--{}", name),
            [&arguments, name](unsigned count) {
              arguments.steps.push_back({name, std::to_string(count)});
            },
            fmt::format("{} so many of the steps before", name))
        ->type_name("N")
        ->trigger_on_parse()
        ->group(kGroup);
  }
}

}  // namespace

void add_edit_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<EditArguments>();
  CLI::App* verb = program.add_subcommand("edit", "repair and change a mesh, in the order given");
  verb->footer(
      "example:\n  frangia edit bust.ply --remove-islands 2mm --fill-holes 10mm --decimate 0.01mm "
      "-o bust.dxf\n  frangia edit bust.ply --select-box 0,0,0,20,20,20 --within --select-normal "
      "0,0,1,30deg --delete -o cut.ply");
  verb->add_option("MESH", arguments->mesh, fmt::format("the mesh: {}", mesh_extensions()))
      ->required();
  verb->add_option("-o,--output", arguments->outputs, output_help())->allow_extra_args(false);
  add_write_options(*verb, arguments->write);
  verb->add_flag("--list", arguments->list, "show what the result has and what is wrong with it");
  verb->add_option("--preview",
                   arguments->preview,
                   "draw what the steps would do: before, what goes or moves in violet, and after, "
                   "what is moved yellow, synthesized blue, selected violet")
      ->type_name("FILE.png");
  add_operations(*verb, *arguments);
  add_history(*verb, *arguments);
  verb->callback([arguments, &terminal] { edit(*arguments, terminal); });
}

}  // namespace frangia
