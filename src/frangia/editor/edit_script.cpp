#include "frangia/editor/edit_script.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr const char* kFormat = "frangia-edits";
constexpr int kVersion = 1;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

EditScript script_from(const nlohmann::json& json, const std::filesystem::path& path) {
  if (json.value("format", "") != kFormat) fail(path, "it is no script of edits (frangia-edits)");
  if (json.at("version").get<int>() > kVersion) {
    fail(path, "it is of a newer version; update the program");
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
  script.done = std::min(json.value("done", script.steps.size()), script.steps.size());
  return script;
}

}  // namespace

EditScript read_edit_script(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "it cannot be opened; check its name");
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object()) fail(path, "its JSON is damaged");
  try {
    return script_from(json, path);
  } catch (const nlohmann::json::exception& error) {
    fail(path, fmt::format("it is no script of edits ({})", error.what()));
  }
}

void write_edit_script(const std::filesystem::path& path, const EditScript& script) {
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
  AtomicFile file(path);
  file.stream() << json.dump(1) << '\n';
  file.commit();
}

}  // namespace frangia
