#include "frangia/decode/decoded_views.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/rig/write_rig.h"

namespace frangia {
namespace {

/// Everything of a rig that views are decoded with.
std::string decoding_rig(const Rig& rig) {
  Rig untabled = rig;
  untabled.turntable.reset();
  return rig_text(untabled);
}

/// Names, sizes and times of the files in the folder of a view; empty where that cannot be read.
std::string stamp_of(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error)) continue;
    const auto time = entry.last_write_time(error).time_since_epoch().count();
    files.push_back(
        fmt::format("{} {} {}\n", entry.path().filename().string(), entry.file_size(error), time));
    if (error) return {};
  }
  std::sort(files.begin(), files.end());
  std::string stamp;
  for (const std::string& file : files)
    stamp += file;
  return stamp;
}

/// The patterns of a scan as scan.toml states them.
std::string patterns_text(const Scan& scan) {
  Scan patterns;
  patterns.rig = scan.rig;
  patterns.patterns = scan.patterns;
  patterns.frames = scan.frames;
  return scan_text(patterns);
}

std::string text_of(const Scan& plan) {
  return decoding_rig(plan.rig) + scan_text(plan);
}

std::size_t pixels_of(const DecodedView& view) {
  std::size_t pixels = 0;
  for (const DecodedDirection& direction : view.directions)
    pixels += direction.phase.phase_rad.pixels().size();
  return pixels;
}

/// Whether several views decide about the decoding of one.
bool depends_on_others(const ScanSurvey& survey) {
  return survey.noise.has_value() || !survey.gain_error.empty();
}

}  // namespace

DecodedViews::DecodedViews(const Scan& plan,
                           DecodeOptions options,
                           const std::filesystem::path& scratch)
    : plan_(text_of(plan)), options_(std::move(options)) {
  make_folder(scratch);
  Scan written = plan;
  written.folder = scratch;
  write_scan(written);
  scan_ = read_scan(scratch);
  if (scan_.rig.cameras.size() == 1) rig_ = decoding_rig(scan_.rig);
  scan_.folder = plan.folder;
  std::error_code ignored;
  std::filesystem::remove_all(scratch, ignored);
}

bool DecodedViews::fits(const Scan& plan, const DecodeOptions& options) const {
  return text_of(plan) == plan_ && options.algorithm == options_.algorithm;
}

void DecodedViews::forget(std::size_t view) {
  const std::lock_guard lock(mutex_);
  kept_.erase(scan_.views.at(view).folder.string());
}

void DecodedViews::put(std::size_t view, ToldView decoded) {
  const std::size_t pixels = pixels_of(decoded.view);
  auto told = std::make_shared<const ToldView>(std::move(decoded));
  const std::lock_guard lock(mutex_);
  const std::string name = scan_.views.at(view).folder.string();
  std::size_t others = 0;
  for (const auto& [other, kept] : kept_)
    others += other == name ? 0 : kept.pixels;
  if (others + pixels > kMostPixels) {
    kept_.erase(name);
    return;
  }
  kept_[name] = {.view = std::move(told), .frames = {}, .pixels = pixels};
}

void DecodedViews::seal() {
  const std::lock_guard lock(mutex_);
  for (auto& [name, kept] : kept_)
    if (kept.frames.empty()) kept.frames = stamp_of(scan_.folder / name);
}

void DecodedViews::forget_unsealed() {
  const std::lock_guard lock(mutex_);
  std::erase_if(kept_, [](const auto& one) { return one.second.frames.empty(); });
}

std::shared_ptr<const ToldView> DecodedViews::find(const Scan& scan,
                                                   const DecodeOptions& options,
                                                   std::size_t view) const {
  if (depends_on_others(options.survey)) return nullptr;
  if (rig_.empty() || patterns_text(scan) != patterns_text(scan_) || decoding_rig(scan.rig) != rig_)
    return nullptr;
  const std::string name = scan.views.at(view).folder.string();
  const std::lock_guard lock(mutex_);
  const auto kept = kept_.find(name);
  if (kept == kept_.end() || kept->second.frames.empty()) return nullptr;
  return kept->second.frames == stamp_of(scan.folder / name) ? kept->second.view : nullptr;
}

}  // namespace frangia
