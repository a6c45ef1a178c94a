#include "usage.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/text.h"

namespace frangia {
namespace {

/// ", perhaps NAME was meant" for the nearest name, if it is near enough.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const auto nearest = nearest_name(word, names);
  return nearest ? fmt::format(", perhaps {} was meant", *nearest) : "";
}

/// The program, the verb that was called, and its subverb if it has one.
using VerbPath = std::vector<const CLI::App*>;
VerbPath verb_path(const CLI::App& program) {
  VerbPath path{&program};
  while (!path.back()->get_subcommands().empty())
    path.push_back(path.back()->get_subcommands().front());
  return path;
}

/// "calibrate piezo"; empty for the program itself.
std::string name_of(const VerbPath& path) {
  std::string name;
  for (std::size_t i = 1; i < path.size(); ++i)
    name += (i > 1 ? " " : "") + path[i]->get_name();
  return name;
}

std::vector<std::string> verbs_of(const CLI::App& verb) {
  const auto verbs = verb.get_subcommands(nullptr);
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const CLI::App* one : verbs)
    names.push_back(one->get_name());
  return names;
}

std::vector<std::string> options_of(const VerbPath& path) {
  std::vector<std::string> names;
  for (const CLI::App* verb : path) {
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& name : option->get_lnames())
        names.push_back("--" + name);
    }
  }
  return names;
}

bool is_option(const std::string& word) {
  return !word.empty() && word.front() == '-';
}

/// A word that belongs to the number before it, as in "--voxel 1 mm".
bool is_unit(const std::string& word) {
  constexpr std::array kUnits{"um", "mm", "cm", "m", "in", "ft", "deg", "rad", "GB", "MB", "kB"};
  return std::find(kUnits.begin(), kUnits.end(), word) != kUnits.end();
}

bool has_unknown_option(const VerbPath& path) {
  const std::vector<std::string> words = path.front()->remaining(true);
  return std::any_of(words.begin(), words.end(), is_option);
}

/// The sentence for words that no option takes, or for a verb that does not exist.
std::string unexpected_argument(const VerbPath& path) {
  const std::vector<std::string> words = path.front()->remaining(true);
  const auto word = std::find_if_not(words.begin(), words.end(), is_option);
  const auto option = std::find_if(words.begin(), words.end(), is_option);
  const std::vector<std::string> verbs = verbs_of(*path.back());
  const std::string name = path.size() > 1 ? name_of(path) : "the program";
  if (!verbs.empty() && word != words.end())
    return fmt::format("{} has no verb {}{}", name, *word, suggestion(*word, verbs));
  if (option != words.end())
    return fmt::format(
        "{} has no option {}{}", name, *option, suggestion(*option, options_of(path)));
  if (word != words.end()) {
    return fmt::format("{} is one argument more than {} takes{}",
                       *word,
                       name,
                       is_unit(*word)
                           ? fmt::format("; write a number and its unit as one word, such "
                                         "as 1{}",
                                         *word)
                           : "");
  }
  return fmt::format("{} needs a verb: {}", name, fmt::join(verbs, ", "));
}

/// The sentence for CLI11's "Could not convert: --views = 2.5".
std::string conversion_failure(const std::string& what) {
  const std::size_t name = what.find(": ");
  const std::size_t value = what.rfind(" = ");
  if (name == std::string::npos || value == std::string::npos) return what;
  return fmt::format(
      "{} cannot be {}", what.substr(name + 2, value - name - 2), what.substr(value + 3));
}

/// The sentence for CLI11's "--voxel: 1 required FLOAT missing" and "--voxel: At Most 1 required
/// but received 2".
std::string count_mismatch(const std::string& what) {
  const std::string name = what.substr(0, what.find(": "));
  const auto has = [&](const char* words) { return what.find(words) != std::string::npos; };
  if (has(": 1 required") && has("missing")) return name + " needs a value";
  if (has("At Most 1 required")) return name + " is given more than once";
  return what;
}

}  // namespace

std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error) {
  const VerbPath path = verb_path(program);
  std::string what = error.what();
  const bool required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const bool lacks_verb = required && !verbs_of(*path.back()).empty();
  // A required option may be present under a misspelt name; the message names that option.
  const bool misspelt = required && has_unknown_option(path);
  if (lacks_verb || misspelt || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    what = unexpected_argument(path);
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) what = conversion_failure(what);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) what = count_mismatch(what);
  return fmt::format("{}; see frangia {}{}--help", what, name_of(path), path.size() > 1 ? " " : "");
}

void require_usage(bool condition, const char* message) {
  if (!condition) throw CLI::ParseError(message, CLI::ExitCodes::ValidationError);
}

std::vector<std::string> without_help_verb(const CLI::App& program, int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  const CLI::App* verb = &program;
  for (const std::string& word : arguments) {
    const auto verbs =
        verb->get_subcommands([&](const CLI::App* one) { return one->get_name() == word; });
    if (verbs.empty()) return arguments;
    verb = verbs.front();
  }
  arguments.emplace_back("--help");
  return arguments;
}

}  // namespace frangia
