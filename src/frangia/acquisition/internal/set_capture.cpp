#include "frangia/acquisition/internal/set_capture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/open_below.h"
#include "frangia/frames/png.h"
#include "frangia/phase/algorithm/estimate_shifts.h"
#include "frangia/phase/algorithm/estimate_step.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {

std::vector<SetCapture::FramePtr> SetCapture::capture(std::size_t view, const Pattern& pattern) {
  const std::string set = parts_.files.set_of(view, pattern);
  for (;;) {
    const int attempt = parts_.manifest.attempt_of(set);
    const std::vector<FramePtr> frames = acquire(view, pattern, attempt);
    if (!parts_.manifest.is_good(set) && shows_motion(view, pattern, frames, attempt)) {
      parts_.run.warn(
          fmt::format("view {}: the frames of \"{}\" show motion and are captured again",
                      view + 1,
                      pattern.name));
      on_frames_(-static_cast<std::ptrdiff_t>(frames.size()));
      continue;
    }
    std::vector<FramePtr> ordered;
    const auto exposures = static_cast<std::size_t>(pattern.exposure_count());
    for (std::size_t exposure = 0; exposure < exposures; ++exposure) {
      for (std::size_t i = exposure; i < frames.size(); i += exposures)
        ordered.push_back(frames[i]);
    }
    return ordered;
  }
}

/// Captures a set that is not stored, before the first stored one: it measures the step error, so
/// that all views are captured with corrected steps.
void SetCapture::capture_trial_set(std::size_t view, const Pattern& pattern) {
  const bool due = parts_.options.control_steps && parts_.devices.has_phase_shifter() &&
                   pattern.kind == PatternKind::Fringe && !parts_.manifest.has_sets();
  if (!due) return;
  FrameStack stack{pattern, {}, parts_.plan.rig.reference().white_level};
  stack.pattern.exposures_ms.clear();
  parts_.devices.begin_set(pattern, 1.0);
  parts_.devices.expose_for(exposure_of(pattern, 0));
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    parts_.devices.show(pattern, frame);
    stack.frames.push_back(
        parts_.devices.capture({static_cast<int>(view), pattern.name, frame, 0, 0}).frame);
  }
  const SetAssessment assessment = assess_set({&stack, 1}, parts_.plan.rig.reference().noise, true);
  ManifestSet outcome;
  if (assessment.step_found) outcome.scale = 1.0 / (1.0 + assessment.gain_error);
  parts_.store.put("trial", outcome);
  parts_.run.note(
      fmt::format("step error of the phase shifter: {:+.2f} %, corrected from the first set on",
                  100.0 * assessment.gain_error));
}

/// Assesses a complete set and stores the outcome.
bool SetCapture::shows_motion(std::size_t view,
                              const Pattern& pattern,
                              const std::vector<FramePtr>& frames,
                              int attempt) {
  ManifestSet outcome{.attempt = attempt, .scale = parts_.manifest.scale()};
  if (pattern.kind == PatternKind::Fringe) {
    const SetAssessment assessment = assess_set(stacks_of(pattern, frames),
                                                parts_.plan.rig.reference().noise,
                                                parts_.devices.has_phase_shifter());
    outcome.moved = assessment.moved && attempt + 1 < parts_.options.set_attempts;
    if (parts_.options.control_steps && assessment.step_found && !assessment.moved) {
      // The trial set corrected the gain error; each further set has its own phase-shift jitter.
      constexpr double kShare = 0.5;
      outcome.scale /= 1.0 + kShare * assessment.gain_error;
    }
  }
  parts_.store.put(parts_.files.set_of(view, pattern), outcome);
  return outcome.moved;
}

std::vector<FrameStack> SetCapture::stacks_of(const Pattern& pattern,
                                              const std::vector<FramePtr>& frames) const {
  std::vector<FrameStack> stacks;
  stacks.reserve(static_cast<std::size_t>(pattern.exposure_count()));
  for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure)
    stacks.push_back({pattern, {}, parts_.plan.rig.reference().white_level, exposure});
  for (std::size_t i = 0; i < frames.size(); ++i)
    stacks[i % stacks.size()].frames.push_back(*frames[i]);
  return stacks;
}

/// The other cameras take the frame that is shown, one after the other.
void SetCapture::capture_further_cameras(std::size_t view,
                                         const Pattern& pattern,
                                         const FrameLabel& label,
                                         double scale) {
  for (std::size_t camera = 1; camera < parts_.files.cameras(); ++camera) {
    const std::string file =
        parts_.files.file_of(view, pattern, label.frame, label.exposure, camera);
    if (parts_.manifest.has(file)) continue;
    parts_.devices.expose_for(exposure_of(pattern, label.exposure));
    CompleteFrame taken = parts_.devices.capture(label, camera);
    parts_.store.put(
        file, std::make_shared<const Frame>(std::move(taken.frame)), about(taken.attempts, scale));
    ++captured_;
  }
}

/// A frame that was taken just now.
ManifestFrame SetCapture::about(int attempts, double scale) const {
  return {.attempts = attempts, .scale = scale, .at_s = parts_.manifest.seconds_since_begin()};
}

/// The frames of a set at all exposures: read where stored, captured otherwise.
std::vector<SetCapture::FramePtr> SetCapture::acquire(std::size_t view,
                                                      const Pattern& pattern,
                                                      int attempt) {
  const bool complete = parts_.files.has_all_frames(view, pattern);
  if (!complete) {
    parts_.table.turn_to(parts_.plan.views[view].angle_rad);
    capture_trial_set(view, pattern);
  }
  const std::vector<bool> stored = parts_.files.stored_frames(view, pattern);
  const double scale = parts_.files.scale_of(view, pattern);
  if (!complete) {
    if (attempt > 0) parts_.store.drain();  // until the rejected frames are written
    if (attempt > 0) parts_.files.move_to_rejected(view, pattern, attempt - 1);
    parts_.devices.begin_set(pattern, scale);
  }
  std::vector<FramePtr> frames;
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    // The shifter passes all positions, stored frames included, for the same hysteresis.
    if (!complete) parts_.devices.show(pattern, frame);
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      const std::string file = parts_.files.file_of(view, pattern, frame, exposure);
      if (stored[frames.size()]) {
        frames.push_back(
            std::make_shared<const Frame>(read_png(path_below(parts_.plan.folder, file))));
      } else {
        const FrameLabel label{static_cast<int>(view), pattern.name, frame, exposure, attempt};
        parts_.devices.expose_for(exposure_of(pattern, exposure));
        CompleteFrame taken = parts_.devices.capture(label);
        frames.push_back(std::make_shared<const Frame>(std::move(taken.frame)));
        parts_.store.put(file, frames.back(), about(taken.attempts, scale));
        ++captured_;
      }
      if (!complete) {
        capture_further_cameras(
            view, pattern, {static_cast<int>(view), pattern.name, frame, exposure, attempt}, scale);
      }
      on_frames_(1);
    }
  }
  parts_.devices.end_set();
  return frames;
}

double SetCapture::exposure_of(const Pattern& pattern, int exposure) const {
  if (!pattern.exposures_ms.empty())
    return pattern.exposures_ms[static_cast<std::size_t>(exposure)];
  return exposure_ms_;
}

std::string SetFiles::set_of(std::size_t view, const Pattern& pattern) const {
  return (plan_.views[view].folder / pattern.name).generic_string();
}

std::filesystem::path SetFiles::folder_of(std::size_t view, std::size_t camera) const {
  const std::filesystem::path& folder = plan_.views[view].folder;
  return camera == 0 ? folder : folder / plan_.rig.cameras[camera].camera.name;
}

std::size_t SetFiles::cameras() const {
  return plan_.rig.cameras.size();
}

std::string SetFiles::file_of(
    std::size_t view, const Pattern& pattern, int frame, int exposure, std::size_t camera) const {
  return (folder_of(view, camera) / frame_file_name(pattern, frame, exposure)).generic_string();
}

std::size_t SetFiles::frames_per_view() const {
  int count = 0;
  for (const Pattern& pattern : plan_.patterns)
    count += pattern.frame_count() * pattern.exposure_count();
  return static_cast<std::size_t>(count);
}

bool SetFiles::has_all_frames(std::size_t view, const Pattern& pattern) const {
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      for (std::size_t camera = 0; camera < cameras(); ++camera)
        if (!manifest_.has(file_of(view, pattern, frame, exposure, camera))) return false;
    }
  }
  return true;
}

bool SetFiles::is_complete(std::size_t view) const {
  return std::all_of(plan_.patterns.begin(), plan_.patterns.end(), [&](const Pattern& pattern) {
    return has_all_frames(view, pattern) && manifest_.is_good(set_of(view, pattern));
  });
}

bool SetFiles::is_begun(std::size_t view) const {
  return std::any_of(plan_.patterns.begin(), plan_.patterns.end(), [&](const Pattern& pattern) {
    const std::vector<bool> stored = stored_frames(view, pattern);
    return manifest_.attempt_of(set_of(view, pattern)) > 0 ||
           std::find(stored.begin(), stored.end(), true) != stored.end();
  });
}

double SetFiles::scale_of(std::size_t view, const Pattern& pattern) const {
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      const ManifestFrame* stored = manifest_.find(file_of(view, pattern, frame, exposure));
      if (stored != nullptr) return stored->scale;
    }
  }
  return manifest_.scale();
}

std::vector<bool> SetFiles::stored_frames(std::size_t view, const Pattern& pattern) const {
  std::vector<bool> stored;
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure)
      stored.push_back(manifest_.has(file_of(view, pattern, frame, exposure)));
  }
  return stored;
}

void SetFiles::move_to_rejected(std::size_t view, const Pattern& pattern, int attempt) const {
  for (std::size_t camera = 0; camera < cameras(); ++camera) {
    const std::filesystem::path folder = path_below(plan_.folder, folder_of(view, camera));
    const std::filesystem::path rejected = path_below(folder, "rejected");
    make_folder(rejected, Durability::Synced);
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
        const std::string name = frame_file_name(pattern, frame, exposure);
        const std::filesystem::path to = rejected / fmt::format("{}-{}", attempt, name);
        const bool counts = manifest_.has(file_of(view, pattern, frame, exposure, camera));
        if (!counts && std::filesystem::exists(folder / name) && !std::filesystem::exists(to))
          std::filesystem::rename(folder / name, to);
      }
    }
    sync_to_disk(rejected);
    sync_to_disk(folder);
  }
}

namespace {

/// Ratio of residual to noise variance above which a set with a phase shifter shows vibration.
/// Piezo steps that are wrong by a degree stay below it.
constexpr double kVibratingPiezo = 6.0;
/// Gain errors above this are failed estimates, such as a step wrong by a fringe.
constexpr double kMaxGainError = 0.3;

NoiseModel noise_of(const FrameStack& stack, const std::optional<NoiseModel>& camera) {
  return camera ? *camera : estimate_noise({&stack, 1});
}

/// Estimates the gain error: by a fit to all shifts for six frames or more, else by the mean step.
void find_gain(const FrameStack& stack, const NoiseModel& noise, SetAssessment& assessment) {
  const std::vector<double>& nominal = stack.pattern.shifts_rad;
  if (nominal.size() >= 6) {
    const ShiftEstimate shifts = estimate_shifts(stack, noise);
    double covariance = 0.0;
    double variance = 0.0;
    double mean_nominal = 0.0;
    double mean_found = 0.0;
    const auto count = static_cast<double>(nominal.size());
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      mean_nominal += nominal[i] / count;
      mean_found += shifts.shifts_rad[i] / count;
    }
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      covariance += (nominal[i] - mean_nominal) * (shifts.shifts_rad[i] - mean_found);
      variance += (nominal[i] - mean_nominal) * (nominal[i] - mean_nominal);
    }
    assessment.step_found = shifts.found;
    assessment.gain_error = covariance / variance - 1.0;
  } else {
    const StepEstimate step = estimate_step(stack);
    assessment.step_found = step.found;
    assessment.gain_error = step.gain_error();
  }
  assessment.step_found = assessment.step_found && std::abs(assessment.gain_error) < kMaxGainError;
}

}  // namespace

SetAssessment assess_set(std::span<const FrameStack> exposures,
                         const std::optional<NoiseModel>& camera,
                         bool shifter) {
  SetAssessment assessment;
  double best_share = -1.0;
  const FrameStack* best = nullptr;
  FrameAssessment best_assessment;
  for (const FrameStack& stack : exposures) {
    const NoiseModel noise = noise_of(stack, camera);
    const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
    const FrameAssessment frame_assessment =
        assess_frames(stack, fitted, wrap_phase(stack, fitted.algorithm, noise), noise);
    if (frame_assessment.measured_fraction <= best_share) continue;
    best_share = frame_assessment.measured_fraction;
    best = &stack;
    best_assessment = frame_assessment;
  }
  if (best == nullptr) return assessment;
  const bool vibrating =
      shifter ? best_assessment.residual_ratio > kVibratingPiezo : best_assessment.exceeds_noise;
  if (shifter) find_gain(*best, noise_of(*best, camera), assessment);
  assessment.moved = camera && vibrating;
  return assessment;
}

Image<PixelStatus> pixel_status_of(const FrameStack& stack,
                                   const std::optional<NoiseModel>& camera) {
  const NoiseModel noise = noise_of(stack, camera);
  return wrap_phase(stack, fit_algorithm("auto", stack, noise).algorithm, noise).status;
}

}  // namespace frangia
