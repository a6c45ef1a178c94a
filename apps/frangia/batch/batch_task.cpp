#include "batch/batch_task.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/make_folder.h"
#include "frangia/core/read_text_file.h"

#include "batch/child_process.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A step: the words after the program's name, and the name of its files.
struct Step {
  std::string name;
  std::vector<std::string> words;
};

std::vector<Step> steps_of(const BatchScan& scan, const BatchPlan& plan, const fs::path& folder) {
  const bool edits = !scan.edit.empty();
  const auto mesh = [&](const std::string& stem, const std::string& format) {
    return (folder / (stem + "." + format)).string();
  };
  std::vector<Step> steps;
  Step reconstruct{"reconstruct", {"--json", "reconstruct", scan.folder.string()}};
  if (edits) {
    reconstruct.words.insert(reconstruct.words.end(), {"-o", mesh("measured", "ply")});
  } else {
    for (const std::string& format : plan.formats)
      reconstruct.words.insert(reconstruct.words.end(), {"-o", mesh("mesh", format)});
  }
  reconstruct.words.insert(
      reconstruct.words.end(), scan.reconstruct.begin(), scan.reconstruct.end());
  steps.push_back(std::move(reconstruct));
  if (edits) {
    Step edit{"edit", {"--json", "edit", mesh("measured", "ply"), "--script", scan.edit.string()}};
    for (const std::string& format : plan.formats)
      edit.words.insert(edit.words.end(), {"-o", mesh("mesh", format)});
    steps.push_back(std::move(edit));
  }
  if (!scan.inspect.empty()) {
    Step inspect{"inspect", {"--json", "inspect", mesh("mesh", plan.formats.front())}};
    inspect.words.insert(inspect.words.end(), scan.inspect.begin(), scan.inspect.end());
    steps.push_back(std::move(inspect));
  }
  return steps;
}

/// Size and time of a file, which tell whether it has changed.
Json stamp_of(const fs::path& path) {
  std::error_code missing;
  const auto size = fs::file_size(path, missing);
  if (missing) return nullptr;
  return {size, fs::last_write_time(path, missing).time_since_epoch().count()};
}

/// What a result depends on.
Json cause_of(const BatchScan& scan, const BatchPlan& plan, const fs::path& folder) {
  Json cause{{"version", FRANGIA_VERSION}};
  for (const Step& step : steps_of(scan, plan, folder))
    cause["commands"].push_back(step.words);
  for (const char* file : {"scan.toml", "rig.toml"})
    cause["files"][file] = stamp_of(scan.folder / file);
  if (!scan.edit.empty()) cause["files"]["edit"] = stamp_of(scan.edit);
  return cause;
}

/// JSON of a file; null when there is none or it is damaged.
Json read_json(const fs::path& path) {
  try {
    return Json::parse(read_text_file(path), nullptr, false);
  } catch (const Error&) {
    return nullptr;
  }
}

/// The first line that a step wrote to standard error: warnings are not its cause.
std::string cause_in(const fs::path& messages) {
  std::ifstream in(messages);
  std::string first;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("frangia: ")) return line.substr(9);
    if (first.empty()) first = line;
  }
  return first;
}

void take_results(const Json& results, BatchRow& row) {
  if (!results.is_object()) return;
  row.points = results.value("points", row.points);
  row.triangles = results.value("triangles", row.triangles);
  if (const auto sigma = results.find("median_sigma"); sigma != results.end()) {
    const auto combined = sigma->find("combined_mm");
    if (combined != sigma->end() && combined->is_number()) row.sigma_mm = combined->get<double>();
  }
}

Json json_of(const BatchRow& row) {
  constexpr const char* kStates[] = {"open", "done", "failed"};  // NOLINT(*-avoid-c-arrays)
  return {{"name", row.name},
          {"state", kStates[static_cast<int>(row.state)]},
          {"exit_code", row.exit_code},
          {"message", row.message},
          {"seconds", row.seconds},
          {"processor_s", row.processor_s},
          {"memory_mb", row.memory_mb},
          {"points", row.points},
          {"triangles", row.triangles},
          {"sigma_mm", std::isnan(row.sigma_mm) ? Json() : Json(row.sigma_mm)}};
}

BatchRow row_of(const Json& json) {
  BatchRow row;
  row.name = json.value("name", "");
  const std::string state = json.value("state", "open");
  row.state = state == "done"     ? BatchState::Done
              : state == "failed" ? BatchState::Failed
                                  : BatchState::Open;
  row.exit_code = json.value("exit_code", 0);
  row.message = json.value("message", "");
  row.seconds = json.value("seconds", 0.0);
  row.processor_s = json.value("processor_s", 0.0);
  row.memory_mb = json.value("memory_mb", 0.0);
  row.points = json.value("points", std::size_t{0});
  row.triangles = json.value("triangles", std::size_t{0});
  const auto sigma = json.find("sigma_mm");
  row.sigma_mm = sigma != json.end() && sigma->is_number() ? sigma->get<double>() : std::nan("");
  return row;
}

}  // namespace

nlohmann::ordered_json json_of(const std::vector<BatchRow>& rows) {
  Json json = Json::array();
  for (const BatchRow& row : rows)
    json.push_back(json_of(row));
  return json;
}

BatchRow read_row(const BatchScan& scan, const BatchPlan& plan, const fs::path& out) {
  BatchRow open;
  open.name = scan.name;
  open.sigma_mm = std::nan("");
  const fs::path folder = out / scan.name;
  const Json mark = read_json(folder / "done.json");
  try {
    if (!mark.is_object() || mark.value("cause", Json()) != cause_of(scan, plan, folder))
      return open;
    return row_of(mark.value("row", Json::object()));
  } catch (const nlohmann::json::exception&) {  // a mark of another program
    return open;
  }
}

BatchRow run_task(const BatchScan& scan,
                  const BatchPlan& plan,
                  const fs::path& out,
                  const BatchCommand& command,
                  const std::stop_token& stop) {
  const fs::path folder = out / scan.name;
  make_folder(folder);
  const FolderLock lock(folder);
  BatchRow row = read_row(scan, plan, out);
  if (row.state == BatchState::Done) return row;  // by another process in the meantime
  fs::remove(folder / "done.json");
  row = {};
  row.name = scan.name;
  row.sigma_mm = std::nan("");
  for (const Step& step : steps_of(scan, plan, folder)) {
    std::vector<std::string> words{command.program};
    if (command.threads > 0)
      words.insert(words.end(), {"--threads", std::to_string(command.threads)});
    words.insert(words.end(), step.words.begin(), step.words.end());
    const fs::path output = folder / (step.name + ".json");
    const fs::path messages = folder / (step.name + ".log");
    const ChildResult result = run_child(words, output, messages, stop);
    if (stop.stop_requested()) return row;
    row.seconds += result.seconds;
    row.processor_s += result.processor_s;
    row.memory_mb = std::max(row.memory_mb, result.memory_mb);
    take_results(read_json(output), row);
    if (result.exit_code == 0) continue;
    row.state = BatchState::Failed;
    row.exit_code = result.exit_code;
    row.message = fmt::format("{}: {}", step.name, cause_in(messages));
    break;
  }
  if (row.state != BatchState::Failed) row.state = BatchState::Done;
  AtomicFile mark(folder / "done.json", Durability::Synced);
  mark.stream() << Json{{"row", json_of(row)}, {"cause", cause_of(scan, plan, folder)}}.dump(
                       2, ' ', true, Json::error_handler_t::replace)
                << '\n';
  mark.commit();
  return row;
}

}  // namespace frangia
