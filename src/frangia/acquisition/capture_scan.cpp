// Longer than 250 lines: the functions of a session share its state, and the order of their device
// calls and manifest entries is what makes an interrupted capture continue with the same bytes.
#include "frangia/acquisition/capture_scan.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/acquisition/internal/assess_set.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_folder.h"
#include "frangia/acquisition/internal/check_devices.h"
#include "frangia/acquisition/internal/frame_store.h"
#include "frangia/acquisition/internal/set_files.h"
#include "frangia/acquisition/internal/survey_exposures.h"
#include "frangia/acquisition/internal/view_assessor.h"
#include "frangia/core/angles.h"
#include "frangia/core/make_folder.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

using FramePtr = std::shared_ptr<const Frame>;

/// The options that must not change between the sessions of one scan, in words.
std::string describe(const CaptureOptions& options) {
  static constexpr std::array kChoices = {"given", "automatic", "bracketed"};
  return fmt::format(
      "exposure = {} {} ms\ngain = {} dB\nblack level = {} counts\nsteps controlled = {}\n",
      kChoices.at(static_cast<std::size_t>(options.exposure)),
      options.camera.exposure_ms,
      options.camera.gain_db,
      options.camera.black_level_counts,
      options.control_steps);
}

/// The plan with the noise model at a camera gain: noise in counts grows with the gain.
Scan with_gain(Scan plan, double gain_db) {
  if (!plan.rig.camera.noise || gain_db == 0.0) return plan;
  const double gain = std::pow(10.0, gain_db / 20.0);
  NoiseModel& noise = *plan.rig.camera.noise;
  constexpr double kRounding_counts2 = 1.0 / 12.0;
  noise.slope_counts *= gain;
  noise.floor_counts2 = (noise.floor_counts2 - kRounding_counts2) * gain * gain + kRounding_counts2;
  return plan;
}

/// One session of a capture: all views of the plan, from the first missing frame on.
class Session {
 public:
  Session(Scan plan, RigDevices& devices, const CaptureOptions& options, const Run& run)
      : plan_(std::move(plan)),
        options_(options),
        run_(run),
        devices_(devices, plan_.rig, options, run),
        camera_range_{options.camera.exposure_ms,
                      devices.camera->info().min_exposure_ms,
                      devices.camera->info().max_exposure_ms},
        manifest_(plan_.folder),
        files_(plan_, manifest_),
        store_(manifest_),
        assessor_(plan_, run) {
    const std::size_t damaged = manifest_.forget_damaged();
    if (damaged > 0)
      run_.warn(fmt::format("frames missing or damaged on the disk, captured again: {}", damaged));
  }

  CaptureReport capture() {
    const auto begin = Deadline::Clock::now();
    choose_exposures();
    for (std::size_t view = 0; view < plan_.views.size(); ++view)
      total_ += files_.frames_per_view();
    Scan scan = plan_;
    scan.views.clear();
    for (std::size_t view = 0; view < plan_.views.size(); ++view) {
      const std::string why = capture_view(view);
      if (why.empty()) {
        scan.views.push_back(plan_.views[view]);
      } else {
        skip(view, why);
      }
    }
    store_.drain();
    assessor_.report(true);
    if (scan.views.empty())
      throw Error(ErrorKind::Device, "no view could be captured; " + report_.skipped.front());
    finish_folder(scan);
    finish_report(std::chrono::duration<double>(Deadline::Clock::now() - begin).count());
    return report_;
  }

 private:
  void skip(std::size_t view, const std::string& why) {
    const double angle_deg = deg_from_rad(plan_.views[view].angle_rad);
    report_.skipped.push_back(
        fmt::format("view {} at {:.6g} degrees: {}", view + 1, angle_deg, why));
    run_.warn("skipped " + report_.skipped.back());
    count(view * files_.frames_per_view() + files_.frames_per_view() - counted_);
  }

  /// Captures the missing frames of a view. Returns the reason of a failure, or an empty text.
  std::string capture_view(std::size_t view) {
    if (files_.is_complete(view)) {
      report_.resumed += files_.frames_per_view();
      count(files_.frames_per_view());
      return {};
    }
    std::string why;
    for (int attempt = 0; attempt < options_.view_attempts; ++attempt) {
      const std::size_t counted = counted_;
      try {
        make_folder(plan_.folder / plan_.views[view].folder);
        devices_.turn_to(plan_.views[view].angle_rad);
        frames_.clear();
        for (const Pattern& pattern : plan_.patterns)
          capture_set(view, pattern);
        assessor_.begin(view, std::exchange(frames_, {}));
        return {};
      } catch (const Error& error) {
        devices_.make_safe();
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

  /// Captures a set that is not stored, before the first stored one: it measures the step error, so
  /// that all views are captured with corrected steps.
  void capture_trial_set(std::size_t view, const Pattern& pattern) {
    const bool due = options_.control_steps && devices_.has_phase_shifter() &&
                     pattern.kind == PatternKind::Fringe && !manifest_.is_good("trial");
    if (!due) return;
    FrameStack stack{pattern, {}, plan_.rig.camera.white_level};
    stack.pattern.exposures_ms.clear();
    devices_.begin_set(pattern, 1.0);
    devices_.expose_for(exposure_of(pattern, 0));
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      devices_.show(pattern, frame);
      stack.frames.push_back(
          devices_.capture({static_cast<int>(view), pattern.name, frame, 0, 0}).frame);
    }
    const SetAssessment assessment = assess_set({&stack, 1}, plan_.rig.camera.noise, true);
    ManifestSet outcome;
    if (assessment.step_found) outcome.scale = 1.0 / (1.0 + assessment.gain_error);
    store_.put("trial", outcome);
    run_.note(
        fmt::format("step error of the phase shifter: {:+.2f} %, corrected from the first set on",
                    100.0 * assessment.gain_error));
  }

  /// Captures the missing frames of a set; repeats the set while it shows motion.
  void capture_set(std::size_t view, const Pattern& pattern) {
    const std::string set = files_.set_of(view, pattern);
    capture_trial_set(view, pattern);
    for (;;) {
      const int attempt = manifest_.attempt_of(set);
      std::vector<FramePtr> frames = acquire_set(view, pattern, attempt);
      if (!manifest_.is_good(set) && shows_motion(view, pattern, frames, attempt)) {
        ++report_.set_retakes;
        run_.warn(fmt::format("view {}: the frames of \"{}\" show motion and are captured again",
                              view + 1,
                              pattern.name));
        counted_ -= frames.size();
        continue;
      }
      // The order of read_frames: one exposure after the other.
      const auto exposures = static_cast<std::size_t>(pattern.exposure_count());
      for (std::size_t exposure = 0; exposure < exposures; ++exposure) {
        for (std::size_t i = exposure; i < frames.size(); i += exposures)
          frames_.push_back(frames[i]);
      }
      return;
    }
  }

  /// Assesses a complete set and stores the outcome.
  bool shows_motion(std::size_t view,
                    const Pattern& pattern,
                    const std::vector<FramePtr>& frames,
                    int attempt) {
    ManifestSet outcome{.attempt = attempt, .scale = manifest_.scale()};
    if (pattern.kind == PatternKind::Fringe) {
      const SetAssessment assessment = assess_set(
          stacks_of(pattern, frames), plan_.rig.camera.noise, devices_.has_phase_shifter());
      outcome.moved = assessment.moved && attempt + 1 < options_.set_attempts;
      if (options_.control_steps && assessment.step_found && !assessment.moved) {
        // The trial set corrected the gain error; each further set has its own phase-shift jitter.
        constexpr double kShare = 0.5;
        outcome.scale /= 1.0 + kShare * assessment.gain_error;
      }
    }
    store_.put(files_.set_of(view, pattern), outcome);
    return outcome.moved;
  }

  [[nodiscard]] std::vector<FrameStack> stacks_of(const Pattern& pattern,
                                                  const std::vector<FramePtr>& frames) const {
    std::vector<FrameStack> stacks;
    stacks.reserve(static_cast<std::size_t>(pattern.exposure_count()));
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure)
      stacks.push_back({pattern, {}, plan_.rig.camera.white_level, exposure});
    for (std::size_t i = 0; i < frames.size(); ++i)
      stacks[i % stacks.size()].frames.push_back(*frames[i]);
    return stacks;
  }

  /// The frames of a set at all exposures: read where stored, captured otherwise.
  std::vector<FramePtr> acquire_set(std::size_t view, const Pattern& pattern, int attempt) {
    const bool complete = files_.has_all_frames(view, pattern);
    const std::vector<bool> stored = files_.stored_frames(view, pattern);
    const double scale = files_.scale_of(view, pattern);
    if (!complete) {
      if (attempt > 0) store_.drain();  // until the rejected frames are written
      if (attempt > 0) files_.move_to_rejected(view, pattern, attempt - 1);
      devices_.begin_set(pattern, scale);
    }
    std::vector<FramePtr> frames;
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      // The shifter passes all positions, stored frames included, for the same hysteresis.
      if (!complete) devices_.show(pattern, frame);
      for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
        const std::string file = files_.file_of(view, pattern, frame, exposure);
        if (stored[frames.size()]) {
          frames.push_back(std::make_shared<const Frame>(read_png(plan_.folder / file)));
          ++report_.resumed;
        } else {
          const FrameLabel label{static_cast<int>(view), pattern.name, frame, exposure, attempt};
          devices_.expose_for(exposure_of(pattern, exposure));
          CompleteFrame taken = devices_.capture(label);
          frames.push_back(std::make_shared<const Frame>(std::move(taken.frame)));
          store_.put(file, frames.back(), {.attempts = taken.attempts, .scale = scale});
          ++report_.captured;
        }
        count(1);
        assessor_.report(false);
      }
    }
    devices_.end_set();
    return frames;
  }

  [[nodiscard]] double exposure_of(const Pattern& pattern, int exposure) const {
    if (!pattern.exposures_ms.empty())
      return pattern.exposures_ms[static_cast<std::size_t>(exposure)];
    return exposure_ms_;
  }

  void count(std::size_t frames) {
    counted_ += frames;
    run_.report(std::min(1.0, static_cast<double>(counted_) / static_cast<double>(total_)));
  }

  /// Chooses the exposures for the whole scan.
  void choose_exposures() {
    exposure_ms_ = options_.camera.exposure_ms;
    if (options_.exposure != ExposureChoice::Given) {
      if (manifest_.exposures_ms().empty()) {
        manifest_.add_exposures(survey_exposures(plan_, devices_, options_, camera_range_, run_));
      }
      report_.exposures_ms = manifest_.exposures_ms();
      exposure_ms_ = report_.exposures_ms.front();
    }
    for (Pattern& pattern : plan_.patterns) {
      const bool fringes = pattern.kind == PatternKind::Fringe || pattern.kind == PatternKind::Gray;
      if (options_.exposure == ExposureChoice::Bracketed && fringes)
        pattern.exposures_ms = report_.exposures_ms;
      if (fringes && !pattern.exposures_ms.empty()) {
        exposure_ms_ = pattern.exposures_ms.front();  // also for the laser sheet
        report_.exposures_ms = pattern.exposures_ms;
      }
    }
    if (report_.exposures_ms.empty()) report_.exposures_ms = {exposure_ms_};
  }

  void finish_report(double seconds) {
    report_.frame_retries = manifest_.retries();
    report_.set_retakes = manifest_.retakes();
    report_.device_s = devices_.seconds();
    report_.disk_s = store_.disk_wait_s();
    report_.other_s = seconds - report_.device_s - report_.disk_s;
  }

  Scan plan_;
  const CaptureOptions& options_;
  const Run& run_;
  CaptureDevices devices_;
  ExposureRange camera_range_;
  CaptureManifest manifest_;
  SetFiles files_;
  FrameStore store_;
  ViewAssessor assessor_;
  CaptureReport report_;
  double exposure_ms_ = 10.0;
  std::vector<FramePtr> frames_;  ///< of the current view, in the order of read_frames
  std::size_t total_ = 0;
  std::size_t counted_ = 0;
};

}  // namespace

CaptureReport capture_scan(const Scan& plan,
                           RigDevices& devices,
                           const CaptureOptions& options,
                           const Run& run) {
  require(!plan.patterns.empty() && !plan.views.empty(),
          "a scan needs at least one pattern and one view; add them to the plan");
  const SafeStateGuard safe(devices);
  check_devices(devices, plan, options);
  Scan real = with_gain(plan, options.camera.gain_db);
  const bool begun = claim_folder(real, describe(options));
  if (begun && devices.turntable && !devices.turntable->info().can_home) {
    run.warn(
        fmt::format("{} has no home switch: move it to the position where the scan began, at 0",
                    devices.turntable->name()));
  }
  return Session(std::move(real), devices, options, run).capture();
}

}  // namespace frangia
