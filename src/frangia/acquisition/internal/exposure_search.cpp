#include "frangia/acquisition/internal/exposure_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace frangia {
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

}  // namespace frangia
