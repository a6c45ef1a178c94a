#include "batch/batch_inputs.h"

#include <exception>

#include <fmt/format.h>

#include "frangia/core/checksums.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/text.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// The values of an option among words: "--plan FILE" or "--plan=FILE".
std::vector<fs::path> files_of_option(const std::vector<std::string>& words,
                                      const std::string& option) {
  std::vector<fs::path> values;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option && i + 1 < words.size()) values.emplace_back(words[i + 1]);
    if (words[i].starts_with(option + "=")) values.emplace_back(words[i].substr(option.size() + 1));
  }
  return values;
}

/// The covariance of the rig, and the images in each view's folder, of all cameras. Sets that were
/// captured again keep the earlier frames in `rejected`.
void add_files_of_scan(const BatchScan& scan, NamedFiles& files) {
  const Scan read = read_scan(scan.folder);
  const auto& calibration = read.rig.calibration;
  if (calibration && !calibration->covariance_file.empty())
    files.emplace(calibration->covariance_file, scan.folder / calibration->covariance_file);
  for (const ScanView& view : read.views) {
    fs::recursive_directory_iterator entry(scan.folder / view.folder);
    for (; entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename() == "rejected") entry.disable_recursion_pending();
      const std::string ending = lowercase_extension(entry->path());
      if (ending != ".png" && ending != ".tif" && ending != ".tiff") continue;
      files.emplace(entry->path().lexically_relative(scan.folder).generic_string(), entry->path());
    }
  }
}

}  // namespace

NamedFiles inputs_of(const BatchScan& scan) {
  NamedFiles files;
  for (const char* file : {"scan.toml", "rig.toml"})
    files.emplace(file, scan.folder / file);
  try {
    add_files_of_scan(scan, files);
  } catch (const std::exception&) {  // the step that reads the scan says what is wrong
  }
  if (!scan.edit.empty()) files.emplace("edit", scan.edit);
  for (const fs::path& reference : files_of_option(scan.inspect, "--reference"))
    files.emplace("reference " + reference.string(), reference);
  for (const fs::path& plan : files_of_option(scan.inspect, "--plan")) {
    files.emplace("plan " + plan.string(), plan);
    try {
      const fs::path reference = read_inspection_plan(plan).reference;
      if (!reference.empty()) files.emplace("reference " + reference.string(), reference);
    } catch (const Error&) {  // the step that reads the plan says what is wrong
    }
  }
  return files;
}

std::string differing_frame(const BatchScan& scan) {
  const auto stored = read_stored_frames(scan.folder);
  if (stored.empty()) return {};
  for (const auto& [name, frame] : inputs_of(scan)) {
    const auto known = stored.find(name);
    if (known == stored.end()) continue;
    try {
      if (crc32(read_regular_file(frame)) == known->second.checksum) continue;
    } catch (const Error& error) {
      return error.what();
    }
    return fmt::format(
        "{} does not have the checksum of capture/manifest.txt; restore it, or "
        "capture the scan again",
        frame.string());
  }
  return {};
}

}  // namespace frangia
