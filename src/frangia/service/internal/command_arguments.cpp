#include "frangia/service/internal/command_arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/check_nesting.h"
#include "frangia/core/checksums.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void fail_argument(const char* key, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", key, what));
}

/// @errors   Error(Input) for an id that is none
void check_id(const std::string& id) {
  constexpr std::size_t kShortest = 8;
  constexpr std::size_t kLongest = 64;
  const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '_';
  });
  if (!plain || id.size() < kShortest || id.size() > kLongest)
    fail_argument("id", "8 to 64 letters, digits, - and _ are missing here");
}

}  // namespace

CommandArguments::CommandArguments(const std::string& text, const std::string& command) {
  constexpr std::size_t kMostBytes = 1'000'000;
  require(text.size() <= kMostBytes, "the command is longer than 1 MB; send a shorter one");
  check_json_nesting(text, "command");
  json_ = text.empty() ? nlohmann::json::object() : nlohmann::json::parse(text, nullptr, false);
  require(json_.is_object(), "the arguments of a command are a JSON object; send one, such as {}");
  if (const auto id = text_if_given("id")) {
    check_id(*id);
    key_.id = *id;
    json_.erase("id");
    const std::string said =
        command + json_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    key_.digest = crc32(said);
  }
}

const nlohmann::json* CommandArguments::find(const char* key) {
  read_.insert(key);
  const auto found = json_.find(key);
  return found == json_.end() || found->is_null() ? nullptr : &*found;
}

std::string CommandArguments::text(const char* key) {
  const nlohmann::json* value = find(key);
  if (value == nullptr || !value->is_string()) fail_argument(key, "a text is missing here");
  return value->get<std::string>();
}

std::string CommandArguments::text_or(const char* key, const std::string& otherwise) {
  return find(key) == nullptr ? otherwise : text(key);
}

std::optional<std::string> CommandArguments::text_if_given(const char* key) {
  return find(key) == nullptr ? std::nullopt : std::optional(text(key));
}

std::size_t CommandArguments::whole(const char* key, std::size_t least, std::size_t most) {
  const nlohmann::json* value = find(key);
  if (value == nullptr || !value->is_number_unsigned() || value->get<std::size_t>() < least ||
      value->get<std::size_t>() > most)
    fail_argument(key, fmt::format("a whole number from {} to {} is missing here", least, most));
  return value->get<std::size_t>();
}

std::size_t CommandArguments::whole_or(const char* key,
                                       std::size_t otherwise,
                                       std::size_t least,
                                       std::size_t most) {
  return find(key) == nullptr ? otherwise : whole(key, least, most);
}

std::optional<double> CommandArguments::number(const char* key) {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number() || !(std::abs(value->get<double>()) <= kLargest))
    fail_argument(key, fmt::format("a number of at most {:g} is missing here", kLargest));
  return value->get<double>();
}

std::optional<double> CommandArguments::positive(const char* key) {
  const auto value = number(key);
  if (value && !(*value > 0.0)) fail_argument(key, "a number above 0 is missing here");
  return value;
}

std::optional<double> CommandArguments::zero_or_more(const char* key) {
  const auto value = number(key);
  if (value && *value < 0.0) fail_argument(key, "a number of 0 or more is missing here");
  return value;
}

std::vector<double> CommandArguments::numbers(const char* key, std::size_t count) {
  const nlohmann::json* value = find(key);
  const auto is_number = [](const nlohmann::json& one) { return one.is_number(); };
  if (value == nullptr || !value->is_array() || value->size() != count ||
      !std::all_of(value->begin(), value->end(), is_number))
    fail_argument(key, fmt::format("a list of {} numbers is missing here", count));
  return value->get<std::vector<double>>();
}

std::vector<double> CommandArguments::numbers_or_none(const char* key, std::size_t count) {
  return find(key) == nullptr ? std::vector<double>() : numbers(key, count);
}

std::optional<std::vector<double>> CommandArguments::list(const char* key, std::size_t most) {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_array() || value->size() > most)
    fail_argument(key, fmt::format("a list of at most {} numbers is missing here", most));
  return numbers(key, value->size());
}

bool CommandArguments::flag(const char* key) {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) fail_argument(key, "true or false is missing here");
  return value->get<bool>();
}

std::map<std::string, std::string> CommandArguments::texts(const char* key, std::size_t most) {
  const nlohmann::json* value = find(key);
  const auto is_text = [](const nlohmann::json& one) { return one.is_string(); };
  if (value == nullptr || !value->is_object() || value->size() > most ||
      !std::all_of(value->begin(), value->end(), is_text))
    fail_argument(key, fmt::format("an object of at most {} texts is missing here", most));
  return value->get<std::map<std::string, std::string>>();
}

const nlohmann::json& CommandArguments::value(const char* key) {
  const nlohmann::json* value = find(key);
  if (value == nullptr) fail_argument(key, "it is missing");
  return *value;
}

nlohmann::json CommandArguments::object(const char* key) {
  const nlohmann::json* value = find(key);
  if (value == nullptr || !value->is_object()) fail_argument(key, "an object is missing here");
  return *value;
}

void CommandArguments::check_all_read() const {
  for (const auto& [key, value] : json_.items())
    if (!read_.contains(key)) fail_argument(key.c_str(), "the command has no such argument");
}

const nlohmann::ordered_json* AnsweredCommands::find(const CommandKey& key) const {
  if (key.id.empty()) return nullptr;
  const auto found = std::find_if(
      last_.begin(), last_.end(), [&](const auto& one) { return one.first.id == key.id; });
  if (found == last_.end()) return nullptr;
  require_same_command(key, found->first);
  return &found->second;
}

void AnsweredCommands::keep(const CommandKey& key, nlohmann::ordered_json answer) {
  if (key.id.empty()) return;
  if (last_.size() >= kMost) last_.pop_front();
  last_.emplace_back(key, std::move(answer));
}

void require_same_command(const CommandKey& asked, const CommandKey& known) {
  require(asked == known,
          "id: belongs to another command; send each command with an id of its own");
}

}  // namespace frangia
