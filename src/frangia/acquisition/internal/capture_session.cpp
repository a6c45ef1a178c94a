#include "frangia/acquisition/internal/capture_session.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/acquisition/internal/capture_folder.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/set_capture.h"
#include "frangia/acquisition/internal/wait_for_drift.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

/// The bytes of a frame; empty when the file is missing, damaged or of another size.
std::optional<std::vector<char>> intact_frame(const std::filesystem::path& folder,
                                              const std::string& file,
                                              const CameraModel& camera) {
  try {
    const std::filesystem::path path = path_below(folder, file);
    std::vector<char> bytes = read_regular_file(path);
    static_cast<void>(read_png(path, [&](int width_px, int height_px) {
      require(width_px == camera.width_px && height_px == camera.height_px, "another size");
    }));
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Whether the file at the frame's path was captured after the set's last rejection: `SetFiles`
/// then moved the rejected frame away first.
bool is_of_last_attempt(const std::filesystem::path& folder,
                        const std::string& frame_name,
                        int attempt) {
  return attempt == 0 || std::filesystem::exists(folder / "rejected" /
                                                 fmt::format("{}-{}", attempt - 1, frame_name));
}

/// The frames of one camera and set.
std::size_t recover_set(const Scan& plan,
                        const SetFiles& files,
                        std::size_t view,
                        const Pattern& pattern,
                        std::size_t camera,
                        CaptureManifest& manifest) {
  const CameraModel& model = plan.rig.cameras[camera].camera.model;
  const int attempt = manifest.attempt_of(files.set_of(view, pattern));
  std::size_t count = 0;
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      const std::string file = files.file_of(view, pattern, frame, exposure, camera);
      if (manifest.has(file) || !is_of_last_attempt(plan.folder / files.folder_of(view, camera),
                                                    frame_file_name(pattern, frame, exposure),
                                                    attempt))
        continue;
      const auto bytes = intact_frame(plan.folder, file, model);
      if (!bytes) continue;
      manifest.add_recovered(file, *bytes);
      ++count;
    }
  }
  return count;
}

/// Lists stored frames again whose lines in the manifest are damaged. A frame counts if its PNG
/// decodes completely, each part of which has a CRC-32, and has the size of the rig's camera.
/// Frames of a set that was rejected for motion do not count. Returns the number of frames.
///
/// @errors   Error(File) when the manifest cannot be written
std::size_t recover_frames(const Scan& plan, const SetFiles& files, CaptureManifest& manifest) {
  std::size_t count = 0;
  for (std::size_t view = 0; view < plan.views.size(); ++view) {
    for (const Pattern& pattern : plan.patterns) {
      const std::string set = files.set_of(view, pattern);
      if (!manifest.may_lack_frames_of(set)) continue;
      for (std::size_t camera = 0; camera < files.cameras(); ++camera)
        count += recover_set(plan, files, view, pattern, camera, manifest);
    }
  }
  return count;
}

}  // namespace

CaptureSession::CaptureSession(Scan plan,
                               RigDevices& devices,
                               const CaptureOptions& options,
                               const Run& run)
    : plan_(std::move(plan)),
      options_(options),
      run_(run),
      devices_(devices, plan_.rig, options, run),
      manifest_(plan_.folder),
      table_(devices_, manifest_, devices.turntable.get(), options.table_at_rad, run),
      exposures_(choose_exposures(
          plan_, devices_, exposure_range(devices, options), table_, manifest_, options_, run_)),
      files_(plan_, manifest_),
      store_(manifest_),
      assessor_(plan_, options_, run),
      sets_({plan_, options_, run_, devices_, table_, manifest_, files_, store_},
            exposures_.single_ms,
            [this](std::ptrdiff_t frames) {
              count(frames);
              assessor_.report(false);
            }),
      captured_(plan_),
      total_(static_cast<std::ptrdiff_t>(plan_.views.size() * files_.frames_per_view())) {
  report_.exposures_ms = exposures_.fringes_ms;
  check_stored_frames();
  report_.resumed = manifest_.frame_count();
}

void CaptureSession::check_stored_frames() {
  if (const std::size_t damaged = manifest_.damaged_lines(); damaged > 0) {
    run_.warn(fmt::format("damaged lines of the manifest: {}, frames recovered from the disk: {}",
                          damaged,
                          recover_frames(plan_, files_, manifest_)));
  }
  if (const std::size_t damaged = manifest_.forget_damaged(); damaged > 0)
    run_.warn(fmt::format("frames missing or damaged on the disk, captured again: {}", damaged));
}

CaptureReport CaptureSession::capture() {
  if (options_.drift_limit_mm > 0.0 && is_something_left()) {
    report_.drift_mm = wait_for_drift(plan_, devices_, options_, exposures_.single_ms, run_);
    run_.stage("scan");
  }
  capture_views();
  finish();
  return_table();
  const std::chrono::duration<double> time = Deadline::Clock::now() - begin_;
  report_.captured = sets_.captured();
  report_.frame_retries = manifest_.retries();
  report_.set_retakes = manifest_.retakes();
  report_.device_s = devices_.seconds();
  report_.disk_s = store_.disk_wait_s();
  report_.other_s = time.count() - report_.device_s - report_.disk_s;
  return report_;
}

bool CaptureSession::is_something_left() const {
  for (std::size_t view = 0; view < plan_.views.size(); ++view) {
    if (plan_.views[view].setup == options_.setup && !files_.is_complete(view)) return true;
  }
  return false;
}

void CaptureSession::capture_views() {
  captured_.views.clear();
  for (std::size_t view = 0; view < plan_.views.size(); ++view) {
    if (plan_.views[view].setup != options_.setup && !files_.is_complete(view)) {
      count(static_cast<std::ptrdiff_t>(files_.frames_per_view()));
      continue;  // the part is clamped in another way now
    }
    const Ready ready = set_up(view);
    if (ready == Ready::End) return;
    if (ready == Ready::No) continue;
    const std::string why = capture_view(view);
    if (why.empty()) {
      captured_.views.push_back(plan_.views[view]);
      if (options_.after_view) {
        store_.drain();
        options_.after_view(view);
      }
    } else {
      skip(view, why);
    }
  }
}

/// Has a person set up a view that is not captured yet.
CaptureSession::Ready CaptureSession::set_up(std::size_t view) {
  if (!options_.before_view || files_.is_complete(view)) return Ready::Yes;
  if (files_.is_begun(view)) {
    run_.note(fmt::format("view {} was interrupted and is left out", view + 1));
    return Ready::No;
  }
  for (const Pattern& pattern : plan_.patterns) {
    if (pattern.kind != PatternKind::White) continue;
    devices_.begin_set(pattern, 1.0);
    devices_.show(pattern, 0);
  }
  return options_.before_view(view) ? Ready::Yes : Ready::End;
}

void CaptureSession::capture_view_once(std::size_t view) {
  for (std::size_t camera = 0; camera < files_.cameras(); ++camera)
    make_folder(path_below(plan_.folder, files_.folder_of(view, camera)), Durability::Synced);
  std::vector<std::shared_ptr<const Frame>> frames;
  for (const Pattern& pattern : plan_.patterns) {
    const auto set = sets_.capture(view, pattern);
    frames.insert(frames.end(), set.begin(), set.end());
  }
  assessor_.begin(view, std::move(frames));
}

/// Captures the missing frames of a view. Returns the reason of a failure, or an empty text.
std::string CaptureSession::capture_view(std::size_t view) {
  if (files_.is_complete(view)) {
    count(static_cast<std::ptrdiff_t>(files_.frames_per_view()));
    return {};
  }
  std::string why;
  for (int attempt = 0; attempt < options_.view_attempts; ++attempt) {
    const std::ptrdiff_t counted = counted_;
    try {
      capture_view_once(view);
      return {};
    } catch (const Error& error) {
      devices_.make_safe();
      table_.forget();
      if (error.kind() != ErrorKind::Device) throw;
      store_.drain();
      devices_.check_health(error.what());  // throws when a device is lost
      if (why.empty()) {
        why = error.what();
      } else if (why != error.what()) {
        why += std::string("; at the next attempt: ") + error.what();
      }
      counted_ = counted;
      if (attempt + 1 < options_.view_attempts)
        run_.warn(fmt::format("view {} is captured again: {}", view + 1, why));
    }
  }
  return why;
}

void CaptureSession::skip(std::size_t view, const std::string& why) {
  report_.skipped.push_back({view, plan_.views[view].angle_rad, why});
  run_.warn("skipped " + report_.skipped.back().sentence());
  count(static_cast<std::ptrdiff_t>((view + 1) * files_.frames_per_view()) - counted_);
}

/// Writes scan.toml, which makes the scan complete.
void CaptureSession::finish() {
  store_.drain();
  assessor_.report(true);
  if (options_.decoded) options_.decoded->seal();
  const bool none =
      std::none_of(captured_.views.begin(), captured_.views.end(), [&](const ScanView& view) {
        return view.setup == options_.setup;
      });
  if (none && report_.skipped.empty())
    throw Error(ErrorKind::Input, "no view was captured; the same command begins again");
  if (none) {
    throw Error(ErrorKind::Device,
                "no view could be captured; " + report_.skipped.front().sentence());
  }
  finish_folder(captured_);
}

/// A fault of the table here does not make the scan incomplete.
void CaptureSession::return_table() {
  if (!report_.skipped.empty()) return;
  try {
    table_.return_to_zero();
  } catch (const Error& error) {
    devices_.make_safe();
    if (error.kind() != ErrorKind::Device) throw;
    run_.warn(fmt::format("the scan is complete, but the turntable did not return to 0: {}",
                          error.what()));
  }
}

void CaptureSession::count(std::ptrdiff_t frames) {
  counted_ += frames;
  run_.report(std::min(1.0, static_cast<double>(counted_) / static_cast<double>(total_)));
}

}  // namespace frangia
