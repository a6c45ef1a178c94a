#include "edit_arguments.h"

#include <string>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/mesh_formats.h"

#include "allow_memory.h"
#include "option_names.h"
#include "write_options.h"

namespace frangia {
namespace {

/// What is wrong with the value of an operation; empty for a right one.
std::string fault_of_step(const std::string& name, const std::string& value) {
  try {
    check_step({name, value});
  } catch (const Error& error) {
    const std::string what = error.what();
    const std::string prefix = name + ": ";
    return with_flags(what.starts_with(prefix) ? what.substr(prefix.size()) : what);
  }
  return {};
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
          with_flags(operation.help));
    } else {
      option = verb.add_option_function<std::string>(
          "--" + name,
          [&arguments, name](const std::string& value) {
            arguments.steps.push_back({name, value});
          },
          with_flags(operation.help));
      option->type_name(operation.value)
          ->check(CLI::Validator(
              [name](const std::string& value) { return fault_of_step(name, value); }, ""));
    }
    option->trigger_on_parse()->group(operation.group);
  }
}

void add_history(CLI::App& verb, EditArguments& arguments) {
  constexpr const char* kGroup = "History";
  verb.add_option_function<std::string>(
          "--script",
          [&arguments](const std::string& value) {
            arguments.steps.push_back({kScriptStep, value});
          },
          "apply the steps of a script")
      ->type_name("FILE.json")
      ->trigger_on_parse()
      ->group(kGroup);
  verb.add_option("--save-script", arguments.save_script, "save all steps as a script")
      ->type_name("FILE.json")
      ->group(kGroup);
  for (const char* name : {kUndoStep, kRedoStep}) {
    verb.add_option_function<unsigned>(
            fmt::format("--{}", name),
            [&arguments, name](unsigned count) {
              arguments.steps.push_back({name, std::to_string(count)});
            },
            fmt::format("{} the last N steps", name))
        ->type_name("N")
        ->trigger_on_parse()
        ->group(kGroup);
  }
}

}  // namespace

void add_edit_arguments(CLI::App& verb, EditArguments& arguments) {
  verb.add_option("MESH", arguments.mesh, fmt::format("mesh file: {}", mesh_extensions()))
      ->required();
  verb.add_option("-o,--output", arguments.outputs, output_help())->allow_extra_args(false);
  add_write_options(verb, arguments.write);
  add_allow_memory(verb, arguments.read);
  verb.add_flag("--list", arguments.list, "list the components, holes and faults of the result");
  verb.add_option("--preview",
                  arguments.preview,
                  "draw the mesh before the steps, with what they remove or move in violet, and "
                  "after them, with displaced parts yellow, synthesized blue and selected violet")
      ->type_name("FILE.png");
  add_operations(verb, arguments);
  add_history(verb, arguments);
}

}  // namespace frangia
