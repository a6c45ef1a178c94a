#include "frangia/acquisition/internal/capture_folder.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"
#include "frangia/core/sync_to_disk.h"
#include "frangia/dataset/write_scan.h"

namespace frangia {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes scan.toml, rig.toml and options.txt.
void write_plan(const Scan& plan,
                const std::filesystem::path& folder,
                const std::string& options_text) {
  make_folder(folder);
  Scan copy = plan;
  copy.folder = folder;
  write_scan(copy);
  std::ofstream(folder / "options.txt", std::ios::binary) << options_text;
  for (const auto* name : {"scan.toml", "rig.toml", "options.txt"})
    sync_to_disk(folder / name);
}

bool same_plan(const std::filesystem::path& a, const std::filesystem::path& b) {
  constexpr std::array kFiles = {"scan.toml", "rig.toml", "options.txt"};
  return std::all_of(kFiles.begin(), kFiles.end(), [&](const char* name) {
    return text_of(a / name) == text_of(b / name);
  });
}

/// The temporary files of a session that was killed: ".NAME.PROCESS.tmp".
void remove_remnants(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name.front() == '.' && entry.path().extension() == ".tmp")
      std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace

bool claim_folder(const Scan& plan, const std::string& options_text) {
  const std::filesystem::path kept = plan.folder / "capture";
  const std::filesystem::path fresh = plan.folder / "capture.new";
  make_folder(plan.folder);
  const bool begun = std::filesystem::exists(kept);
  if (!begun && !std::filesystem::is_empty(plan.folder) && !std::filesystem::exists(fresh)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is not empty; name a new folder, or empty this one",
                            plan.folder.string()));
  }
  write_plan(plan, fresh, options_text);
  if (!begun) {
    std::filesystem::rename(fresh, kept);
    sync_to_disk(plan.folder);
    return false;
  }
  const bool same = same_plan(kept, fresh);
  std::filesystem::remove_all(fresh);
  if (!same) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: holds another scan; name a new folder, or use the options and the rig "
                    "of the first session",
                    plan.folder.string()));
  }
  remove_remnants(plan.folder);
  return true;
}

void finish_folder(const Scan& scan) {
  write_scan(scan);
  sync_to_disk(scan.folder / "rig.toml");
  sync_to_disk(scan.folder / "scan.toml");
  sync_to_disk(scan.folder);
}

}  // namespace frangia
