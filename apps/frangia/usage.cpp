#include "usage.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace frangia {
namespace {

/// How many letters make one word of the other: Levenshtein 1966.
std::size_t letters_between(const std::string& word, const std::string& name) {
  std::vector<std::size_t> row(name.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : word) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < name.size(); ++j) {
      const std::size_t changed = diagonal + (letter == name[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// ", perhaps ... was meant" when one of the names is nearly the word.
std::string hint(const std::string& word, const std::vector<std::string>& names) {
  const auto nearest = std::min_element(
      names.begin(), names.end(), [&](const std::string& one, const std::string& other) {
        return letters_between(word, one) < letters_between(word, other);
      });
  const bool near = nearest != names.end() && letters_between(word, *nearest) * 3 <= word.size();
  return near ? fmt::format(", perhaps {} was meant", *nearest) : "";
}

std::vector<std::string> verbs_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands(nullptr))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

std::string without_verb(const CLI::App& program) {
  for (const std::string& word : program.remaining()) {
    if (word[0] != '-')
      return fmt::format("there is no verb {}{}", word, hint(word, verbs_of(program)));
  }
  return "a verb is missing";
}

std::string told_too_much(const CLI::App& program, const CLI::App& verb) {
  const std::vector<std::string> words = program.remaining(true);
  const auto option = std::find_if(
      words.begin(), words.end(), [](const std::string& word) { return word[0] == '-'; });
  if (option == words.end())
    return fmt::format("{} is one argument more than {} takes", words.front(), verb.get_name());
  return fmt::format(
      "{} has no option {}{}", verb.get_name(), *option, hint(*option, options_of(verb)));
}

/// Of "Could not convert: --views = 2.5".
std::string unfit(const std::string& what) {
  const std::size_t name = what.find(": ");
  const std::size_t value = what.rfind(" = ");
  if (name == std::string::npos || value == std::string::npos) return what;
  return fmt::format(
      "{} cannot be {}", what.substr(name + 2, value - name - 2), what.substr(value + 3));
}

/// Of "--voxel: 1 required FLOAT missing" and "--voxel: At Most 1 required but received 2".
std::string miscounted(const std::string& what) {
  const std::string name = what.substr(0, what.find(": "));
  const auto has = [&](const char* words) { return what.find(words) != std::string::npos; };
  if (has(": 1 required") && has("missing")) return name + " needs a value";
  if (has("At Most 1 required")) return name + " is given more than once";
  return what;
}

}  // namespace

std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error) {
  const auto parsed = program.get_subcommands();
  if (parsed.empty()) return without_verb(program) + "; frangia --help lists them";
  const CLI::App& verb = *parsed.front();
  std::string what = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) what = told_too_much(program, verb);
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) what = unfit(what);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) what = miscounted(what);
  return fmt::format("{}; see frangia {} --help", what, verb.get_name());
}

}  // namespace frangia
