#include "frangia/editor/edit_script.h"

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/check_nesting.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"

namespace frangia {
namespace {

constexpr const char* kFormat = "frangia-edits";
constexpr int kVersion = 1;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

EditScript script_from(const nlohmann::json& json, const std::filesystem::path& path) {
  if (json.value("format", "") != kFormat)
    fail(path, "the file is not an edit script (format frangia-edits)");
  const nlohmann::json& version = json.at("version");
  if (!version.is_number_integer()) fail(path, "version is not a whole number; correct the file");
  if (version.is_number_unsigned() && version.get<std::uint64_t>() > kVersion) {
    fail(path, "a newer version of frangia wrote the script; update frangia");
  }
  EditScript script;
  for (const auto& step : json.at("steps")) {
    script.steps.push_back({step.at("operation").get<std::string>(), step.value("value", "")});
    try {
      check_step(script.steps.back());
    } catch (const Error& error) {
      fail(path, fmt::format("step {}: {}", script.steps.size(), error.what()));
    }
  }
  const nlohmann::json done = json.value("done", nlohmann::json(script.steps.size()));
  if (!done.is_number_unsigned() || done.get<std::uint64_t>() > script.steps.size()) {
    fail(path,
         fmt::format("done is {}, but the script has {} step{}; correct the file",
                     done.is_number() ? done.dump() : done.type_name(),
                     script.steps.size(),
                     script.steps.size() == 1 ? "" : "s"));
  }
  script.done = done.get<std::size_t>();
  return script;
}

}  // namespace

EditScript read_edit_script(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  check_json_nesting(text, path);
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) fail(path, "the file is not valid JSON");
  try {
    return script_from(json, path);
  } catch (const nlohmann::json::exception& error) {
    fail(path, fmt::format("the file is not an edit script ({})", error.what()));
  }
}

void write_edit_script(const std::filesystem::path& path,
                       const EditScript& script,
                       Durability durability) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["done"] = script.done;
  json["steps"] = nlohmann::ordered_json::array();
  for (const EditStep& step : script.steps) {
    nlohmann::ordered_json item;
    item["operation"] = step.operation;
    if (!step.value.empty()) item["value"] = step.value;
    json["steps"].push_back(std::move(item));
  }
  const std::string text = json.dump(1) + '\n';
  if (text.size() > kMaxTextFileBytes) {
    fail(path,
         fmt::format("the steps take {} bytes, more than the {} that are read again; export the "
                     "mesh, and begin a history with it",
                     text.size(),
                     kMaxTextFileBytes));
  }
  write_text_file(path, text, durability);
}

}  // namespace frangia
