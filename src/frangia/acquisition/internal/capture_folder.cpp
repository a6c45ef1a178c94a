#include "frangia/acquisition/internal/capture_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/core/checksums.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/rig/write_rig.h"

namespace frangia {
namespace {

/// The lines of a text, each after its header and the header's number.
std::vector<std::string> lines_with_headers(const std::string& text) {
  std::vector<std::string> lines;
  std::map<std::string, int> counts;
  std::string prefix;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      const int number = ++counts[line];
      prefix = line.starts_with("[[") ? fmt::format("{} {}: ", line, number) : line + ": ";
    } else {
      lines.push_back(prefix + line);
    }
  }
  return lines;
}

/// The first of `lines` that `others` lack; empty without any.
std::string first_only_in(const std::vector<std::string>& lines,
                          const std::vector<std::string>& others) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return std::find(others.begin(), others.end(), line) == others.end();
  });
  return found == lines.end() ? std::string() : *found;
}

/// Describes the first difference between two texts of lines such as "key = value" below headers
/// such as "[camera]": "had "[[view]] 2: angle_deg = 120.0" and now has "[[view]] 2: angle_deg =
/// 90.0"".
std::string first_difference(const std::string& before, const std::string& now) {
  const std::vector<std::string> old_lines = lines_with_headers(before);
  const std::vector<std::string> new_lines = lines_with_headers(now);
  const std::string had = first_only_in(old_lines, new_lines);
  const std::string has = first_only_in(new_lines, old_lines);
  if (had.empty() && has.empty()) return "has its lines in another order";
  if (had.empty()) return fmt::format("now has \"{}\"", has);
  if (has.empty()) return fmt::format("had \"{}\"", had);
  return fmt::format("had \"{}\" and now has \"{}\"", had, has);
}

/// A file of the stored plan.
struct PlanFile {
  std::string name;
  std::string text;
};
using PlanFiles = std::array<PlanFile, 4>;

PlanFiles files_of(const Scan& plan, const SessionSettings& settings) {
  return {PlanFile{"scan.toml", scan_text(plan)},
          PlanFile{"rig.toml", rig_text(plan.rig)},
          PlanFile{"options.txt", settings.options},
          PlanFile{"devices.txt", settings.devices}};
}

/// The text without the name of the scan, which follows the name of its folder.
std::string identity_of(const std::string& text) {
  const std::size_t begin = text.find("\nname = ");
  if (begin == std::string::npos || begin > text.find("\n[")) return text;
  const std::size_t end = text.find('\n', begin + 1);
  return text.substr(0, begin) + (end == std::string::npos ? "" : text.substr(end));
}

/// The text of a stored file; empty when it is missing or cannot be read.
std::string stored_text(const std::filesystem::path& path) {
  try {
    return read_text_file(path);
  } catch (const Error&) {
    return {};
  }
}

/// Writes the plan under another name first, so that `capture/` is complete or missing.
void store_plan(const std::filesystem::path& folder, const PlanFiles& files) {
  const std::filesystem::path fresh = folder / "capture.new";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == FolderLock::kFileName || name == fresh.filename()) continue;
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: is not empty; name a new folder, or empty this one", folder.string()));
  }
  std::filesystem::remove_all(fresh);  // of a session that was killed, or whose disk was full
  make_folder(fresh, Durability::Synced);
  CaptureManifest::PlanChecksums checksums;
  for (const PlanFile& file : files) {
    write_text_file(fresh / file.name, file.text, Durability::Synced);
    checksums[file.name] = crc32(identity_of(file.text));
  }
  CaptureManifest::begin(fresh / CaptureManifest::kFileName, checksums);
  std::filesystem::rename(fresh, folder / "capture");
  sync_to_disk(folder);
}

/// Folders of the views of the stored plan; none where it cannot be read.
std::set<std::filesystem::path> stored_views(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> folders;
  try {
    for (const ScanView& view : read_scan(folder / "capture", {}, RigContent::PhaseOnly).views)
      folders.insert(view.folder);
  } catch (const Error&) {
    return {};
  }
  return folders;
}

/// Replaces the stored plan where the new one has further views, of the same setup or of another,
/// and differs by nothing else. The manifest comes first: a stored plan that is not the one it
/// names is replaced later.
void extend_plan(const Scan& plan, const std::string& text) {
  const std::set<std::filesystem::path> stored = stored_views(plan.folder);
  Scan before = plan;
  std::erase_if(before.views, [&](const ScanView& view) { return !stored.contains(view.folder); });
  if (before.views.empty() || before.views.size() == plan.views.size()) return;
  std::erase_if(before.part_poses, [&](const auto& pose) {
    return std::none_of(before.views.begin(), before.views.end(), [&](const ScanView& view) {
      return view.setup == pose.first;
    });
  });
  const std::filesystem::path path = path_below(plan.folder, "capture/scan.toml");
  if (identity_of(stored_text(path)) != identity_of(scan_text(before))) return;
  CaptureManifest(plan.folder).change_plan("scan.toml", crc32(identity_of(text)));
  write_text_file(path, text, Durability::Synced);
}

/// Replaces the stored rig where the new one knows the axis of the turntable, and differs by
/// nothing else: it may be found from the frames themselves.
void adopt_axis(const Scan& plan, const std::string& text) {
  if (!plan.rig.turntable) return;
  Rig before = plan.rig;
  before.turntable.reset();
  const std::filesystem::path path = path_below(plan.folder, "capture/rig.toml");
  if (stored_text(path) != rig_text(before)) return;
  CaptureManifest(plan.folder).change_plan("rig.toml", crc32(identity_of(text)));
  write_text_file(path, text, Durability::Synced);
}

/// Checks that a plan equals the stored one. A stored file that is damaged is replaced.
void compare_plan(const std::filesystem::path& folder, const PlanFiles& files, const Run& run) {
  const CaptureManifest manifest(folder);
  for (const PlanFile& file : files) {
    const std::filesystem::path path =
        path_below(folder, std::filesystem::path("capture") / file.name);
    const std::string before = identity_of(stored_text(path));
    const std::string now = identity_of(file.text);
    if (before == now) continue;
    const auto stored = manifest.plan_checksums().find(file.name);
    const bool known = stored != manifest.plan_checksums().end();
    if (!known && !std::filesystem::exists(path)) continue;
    if (known && stored->second == crc32(now)) {
      run.warn(fmt::format("{}: was damaged and is replaced", path.string()));
      write_text_file(path, file.text, Durability::Synced);
      continue;
    }
    throw Error(ErrorKind::Input,
                fmt::format("{}: holds another scan: {} {}; name a new folder, or use the options "
                            "and the rig of the first session",
                            folder.string(),
                            file.name,
                            first_difference(before, now)));
  }
}

}  // namespace

void claim_folder(const Scan& plan, const SessionSettings& settings, const Run& run) {
  const PlanFiles files = files_of(plan, settings);
  if (!std::filesystem::exists(plan.folder / "capture")) {
    store_plan(plan.folder, files);
  } else {
    extend_plan(plan, files[0].text);
    adopt_axis(plan, files[1].text);
    compare_plan(plan.folder, files, run);
  }
  remove_temporary_files(plan.folder);
}

void finish_folder(const Scan& scan) {
  write_scan(scan, Durability::Synced);
}

}  // namespace frangia
