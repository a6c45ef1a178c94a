#include "batch/batch_task.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/open_below.h"

#include "batch/batch_inputs.h"
#include "batch/child_process.h"
#include "batch/file_record.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kInputExitCode = 3;

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

/// The files of a step in a folder: its standard output, and what it said.
fs::path output_of(const Step& step, const fs::path& folder) {
  return folder / (step.name + ".json");
}
fs::path messages_of(const Step& step, const fs::path& folder) {
  return folder / (step.name + ".log");
}

/// @errors   Error(Input) that names a link through which a scan's results would be written
void require_no_links(const BatchScan& scan, const BatchPlan& plan, const fs::path& out) {
  const fs::path folder = path_below(out, scan.name);
  for (const Step& step : steps_of(scan, plan, folder)) {
    static_cast<void>(path_below(folder, output_of(step, folder).filename()));
    static_cast<void>(path_below(folder, messages_of(step, folder).filename()));
  }
}

/// What a result depends on beside files.
Json cause_of(const BatchScan& scan, const BatchPlan& plan, const fs::path& folder) {
  Json cause{{"version", FRANGIA_VERSION}};
  for (const Step& step : steps_of(scan, plan, folder))
    cause["commands"].push_back(step.words);
  return cause;
}

constexpr const char* kMark = "done.json";
/// Exit code of a reconstruction from fewer views: those at fault are left out and named.
constexpr int kSkippedViews = 4;

/// What the steps left in a folder: everything but the mark, locks and temporary files.
NamedFiles results_in(const fs::path& folder) {
  NamedFiles files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != kMark && name.front() != '.' && !entry.is_symlink() && entry.is_regular_file())
      files.emplace(name, entry.path());
  }
  return files;
}

/// The results that a record names: other files in the folder belong to the user.
NamedFiles recorded_results(const Json& record, const fs::path& folder) {
  NamedFiles files;
  if (!record.is_object()) return files;
  for (const auto& [name, value] : record.items())
    if (name == fs::path(name).filename()) files.emplace(name, folder / name);
  return files;
}

/// Words for the first result that a link has taken the place of; empty without one.
std::string first_link(const Json& record, const fs::path& folder) {
  for (const auto& [name, path] : recorded_results(record, folder))
    if (fs::is_symlink(path)) return fmt::format("{} is a link now", name);
  return {};
}

/// The name of the first file that a record states as missing; empty when it has all. A scan may
/// fail for a missing file, but what is done needs all.
std::string first_missing(const Json& record) {
  for (const auto& [name, file] : record.items())
    if (file.is_null()) return name;
  return {};
}

/// Waits until the results and their names are on the disk.
void sync_results(const fs::path& folder) {
  for (const auto& [name, path] : results_in(folder))
    sync_to_disk(path);
  sync_to_disk(folder);
}

/// JSON of a file below a folder; null when there is none, or it is a link, damaged, or nested as
/// no program writes it.
Json read_json(const fs::path& folder, const fs::path& inner) {
  constexpr std::uint64_t kMostBytes = 64'000'000;  // the record of a frame has some 150
  try {
    return Json::parse(read_json_below(folder, inner, kMostBytes), nullptr, false);
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

}  // namespace

BatchRow read_row(const BatchScan& scan,
                  const BatchPlan& plan,
                  const fs::path& out,
                  const CheckFiles& check) {
  BatchRow open;
  open.name = scan.name;
  open.sigma_mm = std::nan("");
  const fs::path folder = out / scan.name;
  const Json mark = read_json(out, fs::path(scan.name) / kMark);
  try {
    if (!mark.is_object() || mark.value("cause", Json()) != cause_of(scan, plan, folder))
      return open;
    BatchRow row = row_of(mark.value("row", Json::object()));
    row.name = scan.name;
    check.run.check();
    const auto changed_in = [&](const char* key, const NamedFiles& files) {
      const std::string name = first_changed(mark.value(key, Json()), files, check.all);
      if (!name.empty()) open.message = fmt::format("{} has changed or is missing", name);
      return !name.empty();
    };
    if (changed_in("inputs", inputs_of(scan))) return open;
    if (row.state == BatchState::Done) {
      const Json results = mark.value("results", Json());
      if (std::string link = first_link(results, folder); !link.empty()) {
        open.message = std::move(link);
        return open;
      }
      if (!results.is_object() || results.empty() || !first_missing(results).empty() ||
          changed_in("results", recorded_results(results, folder)))
        return open;
    }
    if (check.all) {
      if (std::string frame = differing_frame(scan); !frame.empty()) {
        row.state = BatchState::Failed;
        row.exit_code = kInputExitCode;
        row.message = std::move(frame);
      }
    }
    return row;
  } catch (const nlohmann::json::exception&) {  // a mark of another program
    return open;
  }
}

BatchRow run_task(const BatchScan& scan,
                  const BatchPlan& plan,
                  const fs::path& out,
                  const BatchCommand& command,
                  const CheckFiles& check) {
  const fs::path folder = out / scan.name;
  BatchRow row;
  row.name = scan.name;
  row.sigma_mm = std::nan("");
  std::optional<FolderLock> lock;
  try {
    require_no_links(scan, plan, out);
    make_folder(folder);
    lock.emplace(folder);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input) throw;
    // A link, or another process writes to it, perhaps a step that was orphaned.
    row.message = error.what();
    return row;
  }
  if (BatchRow known = read_row(scan, plan, out, check); known.state == BatchState::Done)
    return known;  // by another process in the meantime
  fs::remove(folder / kMark);
  sync_to_disk(folder);
  const Json before = stamps_of(inputs_of(scan));
  for (const Step& step : steps_of(scan, plan, folder)) {
    std::vector<std::string> words{command.program};
    if (command.threads > 0)
      words.insert(words.end(), {"--threads", std::to_string(command.threads)});
    words.insert(words.end(), step.words.begin(), step.words.end());
    const fs::path output = output_of(step, folder);
    const fs::path messages = messages_of(step, folder);
    const ChildResult result =
        run_child(words, output, messages, check.run.stop, lock->descriptor());
    if (check.run.stop.stop_requested()) return row;
    row.seconds += result.seconds;
    row.processor_s += result.processor_s;
    row.memory_mb = std::max(row.memory_mb, result.memory_mb);
    take_results(read_json(folder, output.filename()), row);
    if (result.exit_code == 0) continue;
    if (step.name == "reconstruct" && result.exit_code == kSkippedViews) {
      row.message = fmt::format("{}: {}", step.name, cause_in(messages));
      continue;
    }
    row.state = BatchState::Failed;
    row.exit_code = result.exit_code;
    row.message = fmt::format("{}: {}", step.name, cause_in(messages));
    break;
  }
  const NamedFiles inputs = inputs_of(scan);
  if (stamps_of(inputs) != before) {
    row.state = BatchState::Open;
    row.message = "a file of it changed while it was read; the next run does it again";
    return row;
  }
  if (row.state != BatchState::Failed) row.state = BatchState::Done;
  sync_results(folder);
  Json content{{"row", json_of(row)}, {"cause", cause_of(scan, plan, folder)}};
  try {
    const Json read = record_of(inputs);
    const Json left = record_of(results_in(folder));
    if (row.state == BatchState::Done) {
      const std::string missing = first_missing(read) + first_missing(left);
      require(missing.empty(), "a file of it is missing since; the next run does it again");
    }
    content["inputs"] = read;
    content["results"] = left;
  } catch (const Error& error) {
    row.state = BatchState::Open;
    row.message = error.what();  // a file is gone again
    return row;
  }
  write_text_file(folder / kMark,
                  content.dump(2, ' ', true, Json::error_handler_t::replace) + "\n",
                  Durability::Synced);
  return row;
}

}  // namespace frangia
