#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "frangia/core/error.h"
#include "frangia/devices/guardian.h"

#include "exit_codes.h"
#include "interrupt.h"
#include "merge_verb.h"
#include "option_names.h"
#include "option_values.h"
#include "print_text.h"
#include "shell_quoted.h"
#include "usage.h"
#include "verbs.h"

namespace frangia {
namespace {

int exit_code_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Input:
    case ErrorKind::File:
      return BadInput;
    case ErrorKind::Device:
      return DeviceFault;
    case ErrorKind::Numeric:
      return NumericFault;
    case ErrorKind::Cancelled:
      return Interrupted;
  }
  return NumericFault;
}

/// Prints one sentence. The exit code is right even when standard error cannot be written.
int fail(const std::string& message, int code) {
  const std::string sentence = terminal_text(message);
  static_cast<void>(std::fprintf(stderr, "frangia: %s\n", sentence.c_str()));  // NOLINT(*-vararg)
  return code;
}

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Input:
      return "input";
    case ErrorKind::File:
      return "file";
    case ErrorKind::Device:
      return "device";
    case ErrorKind::Numeric:
      return "numeric";
    case ErrorKind::Cancelled:
      return "interrupted";
  }
  return "numeric";
}

/// Whether `--json` is among the arguments. CLI11 sets no flag when it refuses the command line.
bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const char* argument) {
    return std::string_view(argument) == "--json";
  });
}

/// Whether the verb that runs takes a flag; true without a verb.
bool verb_has_flag(const CLI::App& program, const std::string& flag) {
  const CLI::App* verb = &program;
  while (!verb->get_subcommands().empty())
    verb = verb->get_subcommands().front();
  if (verb == &program) return true;
  for (; verb != nullptr; verb = verb->get_parent()) {
    if (verb->get_option_no_throw(flag) != nullptr) return true;
  }
  return false;
}

/// Prints the error that ended a verb: a sentence, and JSON where that was asked for. A reader of
/// the output that has ended stops the program without a message, as it does other programs.
int print_error(const CLI::App& program,
                Terminal& terminal,
                const std::string& sentence,
                int code,
                const char* kind) {
  if (reader_has_ended()) end_by_sigpipe();
  try {
    terminal.release();
    terminal.finish();
  } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch) of standard error
  }
  const std::string message =
      with_flags(sentence, [&](const std::string& flag) { return verb_has_flag(program, flag); });
  try {
    if (terminal.json) {
      nlohmann::ordered_json json;
      json["error"]["message"] = message;
      json["error"]["exit_code"] = code;
      json["error"]["kind"] = kind;
      print_json(json);
    }
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch) of standard output; the end states it
  }
  return fail(message, code);
}

int run_program(int argc, char** argv) {
  Terminal terminal;
  for (int i = 0; i < argc; ++i)
    terminal.command_line += (i > 0 ? " " : "") + shell_quoted(argv[i]);
  CLI::App program("frangia: a 360-degree fringe projection 3D scanner", "frangia");
  program.require_subcommand(1);
  program.set_version_flag("--version", FRANGIA_VERSION);
  program.set_help_all_flag("--help-all", "show the help of every verb");
  program.add_flag("--json", terminal.json, "results as JSON on standard output, no progress");
  program.add_flag("--quiet", terminal.quiet, "warnings and errors only");
  program.add_flag("--verbose", terminal.verbose, "all notes, the time of each stage, the memory");
  std::unique_ptr<tbb::global_control> threads;
  program
      .add_option_function<std::size_t>(
          "--threads",
          [&](std::size_t count) {
            threads = std::make_unique<tbb::global_control>(
                tbb::global_control::max_allowed_parallelism, count);
          },
          "number of cores to use; the result is the same for any number")
      ->check(from_to(1, 1024));
  program.fallthrough();
  add_demo_verb(program, terminal);
  add_simulate_verb(program, terminal);
  add_reconstruct_verb(program, terminal);
  add_import_verb(program, terminal);
  add_decode_verb(program, terminal);
  add_inspect_verb(program, terminal);
  add_accept_verb(program, terminal);
  add_algorithms_verb(program, terminal);
  add_plan_verb(program, terminal);
  add_response_verb(program, terminal);
  add_edit_verb(program, terminal);
  add_picture_verb(program, terminal);
  add_scan_verb(program, terminal);
  add_devices_verb(program, terminal);
  add_calibrate_verb(program, terminal);
  add_merge_verb(program, terminal);
  add_batch_verb(program, terminal);
#ifdef FRANGIA_WITH_APP
  add_serve_verb(program, terminal);
#endif
  if (argc == 1) {
    fmt::print(stderr, "{}", program.help());
    return Usage;
  }
  try {
    std::vector<std::string> arguments = without_help_verb(program, argc, argv);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help and --version
    terminal.json = asks_for_json(argc, argv);
    return print_error(program, terminal, usage_sentence(program, error), Usage, "usage");
  } catch (const Error& error) {
    return print_error(
        program, terminal, error.what(), exit_code_of(error.kind()), name_of(error.kind()));
  } catch (const std::bad_alloc&) {
    return print_error(program,
                       terminal,
                       "this does not fit into the memory of the machine; set a larger `voxel`",
                       NumericFault,
                       "memory");
  } catch (const std::filesystem::filesystem_error& error) {
    return print_error(program,
                       terminal,
                       fmt::format("{}: {}; check the name and its permissions",
                                   error.path1().string(),
                                   error.code().message()),
                       BadInput,
                       "file");
  } catch (const std::system_error& error) {  // of output to standard error
    return print_error(program, terminal, error.what(), BadInput, "file");
  } catch (const std::exception& error) {
    return print_error(program, terminal, error.what(), NumericFault, "numeric");
  }
  terminal.finish();
  return terminal.exit_code;
}

/// Ends the output. It fails when the result could not be written; when a reader has ended, the
/// program ends by SIGPIPE.
int finish_output(int code) {
  try {
    flush_output();
  } catch (const Error& error) {
    if (reader_has_ended()) end_by_sigpipe();
    return fail(error.what(), code == 0 ? exit_code_of(error.kind()) : code);
  }
  if (reader_has_ended()) end_by_sigpipe();
  return code;
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "guardian") {
    const int code = frangia::run_guardian();
    return code == 0 ? 0 : frangia::fail("only frangia itself starts its guardian", code);
  }
  try {
    frangia::handle_signals();
    return frangia::finish_output(frangia::run_program(argc, argv));
  } catch (const std::exception& error) {  // before or after the parse
    if (frangia::reader_has_ended()) frangia::end_by_sigpipe();
    return frangia::fail(error.what(), frangia::NumericFault);
  }
}
