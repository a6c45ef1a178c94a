#include "frangia/acquisition/internal/choose_exposures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/set_capture.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Chooses exposures from up to four views, evenly over the plan: one exposure, or a bracket in the
/// order of the pixels that each adds.
///
/// @units    ms
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
std::vector<double> survey_exposures(const Scan& plan,
                                     CaptureDevices& devices,
                                     TableMover& table,
                                     const CaptureOptions& options,
                                     ExposureRange range,
                                     const Run& run) {
  constexpr std::size_t kViews = 4;
  const bool bracketed = options.exposure == ExposureChoice::Bracketed;
  ExposureBracket bracket(range);
  const std::size_t views = std::min(kViews, plan.views.size());
  for (std::size_t i = 0; i < views; ++i) {
    run.check();
    const std::size_t view = i * plan.views.size() / views;
    table.turn_to(plan.views[view].angle_rad);
    const ExposureProbe probe_here = [&](double exposure_ms) {
      run.check();
      return probe_exposure(plan.patterns, plan.rig, static_cast<int>(view), devices, exposure_ms);
    };
    if (bracketed) {
      bracket.add_view(probe_here);
    } else {
      range.initial_ms = longest_exposure(probe_here, range);
      range.max_ms = range.initial_ms;  // the other views can only shorten it
    }
  }
  std::vector<double> chosen =
      bracketed ? bracket.selected() : std::vector<double>{range.initial_ms};
  run.note(fmt::format("exposures chosen: {:.3g} ms", fmt::join(chosen, ", ")));
  return chosen;
}

void warn_of_uneven_light(const std::vector<double>& exposures_ms, double step_ms, const Run& run) {
  constexpr double kSame = 0.01;  // of a step
  if (step_ms <= 0.0) return;
  for (const double exposure_ms : exposures_ms) {
    const double steps = std::max(1.0, std::round(exposure_ms / step_ms));
    if (std::abs(exposure_ms / step_ms - steps) < kSame) continue;
    run.warn(
        fmt::format("exposures of {:.4g} ms see the light of room and display uneven; expose for "
                    "{:.4g} ms, a whole multiple of the exposure_step_ms of [devices.camera]",
                    exposure_ms,
                    steps * step_ms));
    return;
  }
}

}  // namespace

ChosenExposures choose_exposures(Scan& plan,
                                 CaptureDevices& devices,
                                 const ExposureRange& range,
                                 TableMover& table,
                                 CaptureManifest& manifest,
                                 const CaptureOptions& options,
                                 const Run& run) {
  ChosenExposures chosen;
  chosen.single_ms = options.camera.exposure_ms;
  if (options.exposure != ExposureChoice::Given) {
    if (manifest.exposures_ms().empty()) {
      if (manifest.damaged_lines() > 0) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: {} is damaged and lacks the exposures that were chosen; start "
                                "the scan in a new folder",
                                plan.folder.string(),
                                CaptureManifest::kFileName));
      }
      manifest.add_exposures(survey_exposures(plan, devices, table, options, range, run));
    }
    chosen.fringes_ms = manifest.exposures_ms();
    chosen.single_ms = chosen.fringes_ms.front();
  }
  for (Pattern& pattern : plan.patterns) {
    const bool fringes = pattern.kind == PatternKind::Fringe || pattern.kind == PatternKind::Gray;
    if (options.exposure == ExposureChoice::Bracketed && fringes)
      pattern.exposures_ms = chosen.fringes_ms;
    if (fringes && !pattern.exposures_ms.empty()) {
      chosen.single_ms = pattern.exposures_ms.front();  // also for the laser sheet
      chosen.fringes_ms = pattern.exposures_ms;
    }
  }
  if (chosen.fringes_ms.empty()) chosen.fringes_ms = {chosen.single_ms};
  warn_of_uneven_light(chosen.fringes_ms, range.step_ms, run);
  return chosen;
}

namespace {

constexpr double kMaxSaturated = 0.005;  // of the lit pixels
constexpr double kMinGain = 0.005;       // of the pixels that any exposure measures
constexpr int kMaxExposures = 6;
constexpr int kMaxSteps = 8;  // factors of two, up and down

bool is_overexposed(const Image<PixelStatus>& status) {
  const auto count = [&](PixelStatus which) {
    return static_cast<double>(std::count(status.pixels().begin(), status.pixels().end(), which));
  };
  const double saturated = count(PixelStatus::Saturated);
  return saturated > kMaxSaturated * (saturated + count(PixelStatus::Measured));
}

std::size_t count_of(const std::vector<bool>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), true));
}

/// Counts the pixels of `mask` that are not in `all`, which may be shorter.
std::size_t count_new(const std::vector<bool>& mask, const std::vector<bool>& all) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i)
    count += mask[i] && !(i < all.size() && all[i]) ? 1U : 0U;
  return count;
}

void add(const std::vector<bool>& mask, std::vector<bool>& all) {
  all.resize(std::max(all.size(), mask.size()));
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i]) all[i] = true;
}

}  // namespace

ExposureRange exposure_range(const RigDevices& devices, const CaptureOptions& options) {
  const CameraInfo& camera = devices.reference()->info();
  return {options.camera.exposure_ms,
          camera.min_exposure_ms,
          camera.max_exposure_ms,
          devices.exposure_step_ms};
}

double on_raster(double exposure_ms, double step_ms) {
  constexpr double kRounding = 1e-6;
  if (step_ms <= 0.0 || exposure_ms < step_ms * (1.0 - kRounding)) return exposure_ms;
  return step_ms * std::floor(exposure_ms / step_ms + kRounding);
}

double longest_exposure(const ExposureProbe& probe, const ExposureRange& range) {
  double good = std::clamp(range.initial_ms, range.min_ms, range.max_ms);
  double bright = good;
  if (is_overexposed(probe(good))) {
    do {
      bright = good;
      good = std::max(0.5 * good, range.min_ms);
    } while (good > range.min_ms && is_overexposed(probe(good)));
  } else {
    do {
      good = bright;
      bright *= 2.0;
      if (bright > range.max_ms) return on_raster(good, range.step_ms);
    } while (!is_overexposed(probe(bright)));
  }
  while (bright / good > 1.05) {
    const double middle = std::sqrt(good * bright);
    (is_overexposed(probe(middle)) ? bright : good) = middle;
  }
  return on_raster(good, range.step_ms);
}

double ExposureBracket::exposure_of(int step) const {
  return on_raster(std::ldexp(range_.initial_ms, step), range_.step_ms);
}

bool ExposureBracket::adds(int step, const Image<PixelStatus>& status, Mask& all) {
  Mask& mask = measured_[step];
  mask.resize(earlier_pixels_);
  for (const PixelStatus pixel : status.pixels())
    mask.push_back(pixel == PixelStatus::Measured);
  const Mask here(mask.begin() + static_cast<std::ptrdiff_t>(earlier_pixels_), mask.end());
  const std::size_t added = count_new(here, all);
  add(here, all);
  return static_cast<double>(added) > kMinGain * static_cast<double>(count_of(all));
}

void ExposureBracket::add_view(const ExposureProbe& probe) {
  Mask all;
  std::size_t pixels = 0;
  for (const int direction : {1, -1}) {
    int idle = 0;  // successive steps without new pixels, once any pixel is measured
    for (int step = direction > 0 ? 0 : -1; std::abs(step) <= kMaxSteps && idle < 2;
         step += direction) {
      const double exposure_ms = exposure_of(step);
      if (exposure_ms < range_.min_ms || exposure_ms > range_.max_ms) break;
      const Image<PixelStatus> status = probe(exposure_ms);
      pixels = status.pixels().size();
      idle = adds(step, status, all) || count_of(all) == 0 ? 0 : idle + 1;
    }
  }
  earlier_pixels_ += pixels;
}

std::vector<double> ExposureBracket::selected() const {
  Mask all;
  for (const auto& [step, mask] : measured_)
    add(mask, all);
  const auto min_gain = kMinGain * static_cast<double>(count_of(all));
  std::vector<double> exposures_ms;
  Mask covered;
  while (static_cast<int>(exposures_ms.size()) < kMaxExposures) {
    std::size_t most = 0;
    int best = 0;
    for (const auto& [step, mask] : measured_) {
      const std::size_t added = count_new(mask, covered);
      if (added > most) {
        most = added;
        best = step;
      }
    }
    if (most == 0 || static_cast<double>(most) < min_gain) break;
    exposures_ms.push_back(exposure_of(best));
    add(measured_.at(best), covered);
  }
  if (exposures_ms.empty()) exposures_ms.push_back(exposure_of(0));
  return exposures_ms;
}

namespace {

const Pattern& finest_fringes(std::span<const Pattern> patterns) {
  const Pattern* finest = nullptr;
  for (const Pattern& pattern : patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (finest == nullptr || pattern.fringes_per_unit() > finest->fringes_per_unit())
      finest = &pattern;
  }
  require(
      finest != nullptr,
      "an automatic exposure, or a wait for drift, needs a fringe pattern; add one to the plan");
  return *finest;
}

}  // namespace

FrameStack capture_finest(std::span<const Pattern> patterns,
                          const Rig& rig,
                          int view,
                          CaptureDevices& devices,
                          double exposure_ms) {
  FrameStack stack{finest_fringes(patterns), {}, rig.reference().white_level};
  stack.pattern.exposures_ms.clear();
  devices.begin_set(stack.pattern, 1.0);
  devices.expose_for(exposure_ms);
  for (int frame = 0; frame < stack.pattern.frame_count(); ++frame) {
    devices.show(stack.pattern, frame);
    stack.frames.push_back(devices.capture({view, stack.pattern.name, frame, 0, 0}).frame);
  }
  return stack;
}

Image<PixelStatus> probe_exposure(std::span<const Pattern> patterns,
                                  const Rig& rig,
                                  int view,
                                  CaptureDevices& devices,
                                  double exposure_ms) {
  return pixel_status_of(capture_finest(patterns, rig, view, devices, exposure_ms),
                         rig.reference().noise);
}

}  // namespace frangia
