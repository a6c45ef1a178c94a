#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/core/enum_names.h"

namespace frangia {

/// What tells a command from others, so that the same one is not carried out twice.
struct CommandKey {
  std::string id;            ///< chosen by the client; empty: without one
  std::uint32_t digest = 0;  ///< of the command and its arguments

  bool operator==(const CommandKey&) const = default;
};

/// The arguments of a command: a JSON object whose every key is read exactly once.
///
/// @errors   each function throws Error(Input) that names the key and what it should be
class CommandArguments {
 public:
  /// Beyond any length, angle or time of a rig, and small enough for times and sums of them.
  static constexpr double kLargest = 1e7;

  /// Parses at most 1 MB of JSON. `command` is the name of the command.
  explicit CommandArguments(const std::string& text, const std::string& command = "");

  /// The argument `id`, which every command may have: 8 to 64 letters, digits, `-` and `_`.
  [[nodiscard]] const CommandKey& key() const { return key_; }

  [[nodiscard]] std::string text(const char* key);  ///< a string; required
  [[nodiscard]] std::string text_or(const char* key, const std::string& otherwise);
  [[nodiscard]] std::optional<std::string> text_if_given(const char* key);
  /// The value of an enum that a name stands for; required.
  template <NamedEnum Enum>
  [[nodiscard]] Enum named(const char* key) {
    const std::optional<Enum> value = find_named<Enum>(text(key));
    if (!value) throw Error(ErrorKind::Input, fmt::format("{}: is {}", key, listed_names<Enum>()));
    return *value;
  }
  /// Likewise, or `otherwise` without the key.
  template <NamedEnum Enum>
  [[nodiscard]] Enum named_or(const char* key, Enum otherwise) {
    return find(key) == nullptr ? otherwise : named<Enum>(key);
  }
  /// A whole number from `least` to `most`; required.
  [[nodiscard]] std::size_t whole(const char* key, std::size_t least, std::size_t most);
  [[nodiscard]] std::size_t whole_or(const char* key,
                                     std::size_t otherwise,
                                     std::size_t least,
                                     std::size_t most);
  /// A number of at most kLargest in size, or empty.
  [[nodiscard]] std::optional<double> number(const char* key);
  [[nodiscard]] std::optional<double> positive(const char* key);      ///< likewise, above 0
  [[nodiscard]] std::optional<double> zero_or_more(const char* key);  ///< likewise, 0 or more
  [[nodiscard]] std::vector<double> numbers(const char* key, std::size_t count);  ///< required
  /// Likewise, or empty when the key is missing.
  [[nodiscard]] std::vector<double> numbers_or_none(const char* key, std::size_t count);
  /// A list of at most `most` numbers, or empty.
  [[nodiscard]] std::optional<std::vector<double>> list(const char* key, std::size_t most);
  [[nodiscard]] bool flag(const char* key);  ///< true or false; false without the key
  /// Texts by name: an object of at most `most` texts; required.
  [[nodiscard]] std::map<std::string, std::string> texts(const char* key, std::size_t most);
  [[nodiscard]] const nlohmann::json& value(const char* key);  ///< of any kind; required
  /// An object, whose keys the caller reads; required.
  [[nodiscard]] nlohmann::json object(const char* key);
  /// Fails when a key is left that no function has read.
  void check_all_read() const;

 private:
  [[nodiscard]] const nlohmann::json* find(const char* key);

  nlohmann::json json_;
  CommandKey key_;
  std::set<std::string> read_;
};

/// The last commands that had an id and were accepted, with their answers: a client whose
/// connection broke before the answer sends the same command again. Those that changed a surface
/// are in SurfaceVersions as well, which outlives the program.
class AnsweredCommands {
 public:
  static constexpr std::size_t kMost = 256;

  /// The answer to a command; null when it was not given yet.
  ///
  /// @errors   Error(Input) when the id was that of another command
  [[nodiscard]] const nlohmann::ordered_json* find(const CommandKey& key) const;
  void keep(const CommandKey& key, nlohmann::ordered_json answer);

 private:
  std::deque<std::pair<CommandKey, nlohmann::ordered_json>> last_;
};

/// @errors   Error(Input) unless both are the same command
void require_same_command(const CommandKey& asked, const CommandKey& known);

}  // namespace frangia
