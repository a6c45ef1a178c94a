#include "batch/batch_plan.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

std::string name_of_folder(const fs::path& folder) {
  return fs::weakly_canonical(folder).filename().string();
}

/// The folders with a scan.toml, by name.
std::vector<BatchScan> scans_in(const fs::path& folder) {
  std::vector<BatchScan> scans;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && fs::exists(entry.path() / "scan.toml"))
      scans.push_back({entry.path().filename().string(), entry.path(), {}, {}, {}});
  }
  std::sort(scans.begin(), scans.end(), [](const BatchScan& a, const BatchScan& b) {
    return a.name < b.name;
  });
  return scans;
}

std::vector<std::string> texts_or_none(TomlReader& reader, const char* key) {
  return reader.has(key) ? reader.texts(key) : std::vector<std::string>{};
}

BatchScan read_scan_of(TomlReader& reader, const fs::path& base) {
  BatchScan scan;
  scan.folder = base / reader.text("folder");
  scan.name = reader.has("name") ? reader.text("name") : name_of_folder(scan.folder);
  if (scan.name.empty() || scan.name.front() == '.' || scan.name.find('/') != std::string::npos)
    reader.fail("name", fmt::format("is \"{}\"; it must be the name of a folder", scan.name));
  scan.reconstruct = texts_or_none(reader, "reconstruct");
  scan.inspect = texts_or_none(reader, "inspect");
  if (reader.has("edit")) scan.edit = base / reader.text("edit");
  return scan;
}

BatchPlan read_plan_file(const fs::path& path) {
  const toml::table table = parse_toml(path, "frangia-batch");
  TomlReader reader(path, "", table);
  reader.ignore("format");
  reader.ignore("version");
  const fs::path base = path.parent_path();
  BatchPlan plan;
  if (reader.has("formats")) plan.formats = reader.texts("formats");
  if (plan.formats.empty()) reader.fail("formats", "is empty; name at least one, such as \"ply\"");
  if (reader.has("scans")) {
    const fs::path folder = base / reader.text("scans");
    if (!fs::is_directory(folder)) reader.fail("scans", "names no folder: " + folder.string());
    plan.scans = scans_in(folder);
  }
  for (TomlReader& one : reader.tables("scan")) {
    plan.scans.push_back(read_scan_of(one, base));
    one.refuse_unused_keys();
  }
  const auto reconstruct = texts_or_none(reader, "reconstruct");
  const auto inspect = texts_or_none(reader, "inspect");
  const fs::path edit = reader.has("edit") ? base / reader.text("edit") : fs::path();
  for (BatchScan& scan : plan.scans) {
    scan.reconstruct.insert(scan.reconstruct.begin(), reconstruct.begin(), reconstruct.end());
    scan.inspect.insert(scan.inspect.begin(), inspect.begin(), inspect.end());
    if (scan.edit.empty()) scan.edit = edit;
    if (!scan.edit.empty() && !fs::exists(scan.edit))
      reader.fail("edit", "names no file: " + scan.edit.string());
  }
  reader.refuse_unused_keys();
  return plan;
}

}  // namespace

BatchPlan read_batch_plan(const fs::path& path) {
  BatchPlan plan;
  if (fs::is_directory(path)) {
    plan.scans = scans_in(path);
  } else {
    plan = read_plan_file(path);
  }
  if (plan.scans.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} holds no scan: no folder in it has a scan.toml", path.string()));
  }
  std::set<std::string> names;
  for (const BatchScan& scan : plan.scans) {
    if (!names.insert(scan.name).second) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{} has two scans of the name \"{}\"; give one of them another `name`",
                      path.string(),
                      scan.name));
    }
  }
  return plan;
}

}  // namespace frangia
