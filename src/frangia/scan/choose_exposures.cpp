#include "frangia/scan/choose_exposures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace frangia {
namespace {

constexpr double kMaxSaturated = 0.005;  // of the lit pixels
constexpr double kWorthwhile = 0.005;    // of all that any exposure measures
constexpr int kMaxExposures = 6;
constexpr int kMaxSteps = 8;  // factors of two, up and down

bool too_bright(const Image<PixelFate>& fate) {
  const auto count = [&](PixelFate which) {
    return static_cast<double>(std::count(fate.pixels().begin(), fate.pixels().end(), which));
  };
  const double saturated = count(PixelFate::Saturated);
  return saturated > kMaxSaturated * (saturated + count(PixelFate::Measured));
}

std::size_t count_of(const std::vector<bool>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), true));
}

/// How many of `mask` are not in `all`, which may be shorter.
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

double longest_exposure(const ExposureProbe& probe, const ExposureRange& range) {
  double good = std::clamp(range.guess_ms, range.least_ms, range.most_ms);
  double bright = good;
  if (too_bright(probe(good))) {
    do {
      bright = good;
      good = std::max(0.5 * good, range.least_ms);
    } while (good > range.least_ms && too_bright(probe(good)));
  } else {
    do {
      good = bright;
      bright *= 2.0;
      if (bright > range.most_ms) return good;
    } while (!too_bright(probe(bright)));
  }
  while (bright / good > 1.05) {
    const double middle = std::sqrt(good * bright);
    (too_bright(probe(middle)) ? bright : good) = middle;
  }
  return good;
}

bool ExposureBracket::adds(int step, const Image<PixelFate>& fate, Mask& all) {
  Mask& mask = measured_[step];
  mask.resize(looked_at_);
  for (const PixelFate pixel : fate.pixels())
    mask.push_back(pixel == PixelFate::Measured);
  const Mask here(mask.begin() + static_cast<std::ptrdiff_t>(looked_at_), mask.end());
  const std::size_t fresh = count_new(here, all);
  add(here, all);
  return static_cast<double>(fresh) > kWorthwhile * static_cast<double>(count_of(all));
}

void ExposureBracket::look(const ExposureProbe& probe) {
  Mask all;
  std::size_t pixels = 0;
  for (const int way : {1, -1}) {
    int idle = 0;  // steps on end that added nothing; before anything is seen they do not count
    for (int step = way > 0 ? 0 : -1; std::abs(step) <= kMaxSteps && idle < 2; step += way) {
      const double exposure_ms = std::ldexp(range_.guess_ms, step);
      if (exposure_ms < range_.least_ms || exposure_ms > range_.most_ms) break;
      const Image<PixelFate> fate = probe(exposure_ms);
      pixels = fate.pixels().size();
      idle = adds(step, fate, all) || count_of(all) == 0 ? 0 : idle + 1;
    }
  }
  looked_at_ += pixels;
}

std::vector<double> ExposureBracket::chosen() const {
  Mask all;
  for (const auto& [step, mask] : measured_)
    add(mask, all);
  const auto worthwhile = kWorthwhile * static_cast<double>(count_of(all));
  std::vector<double> exposures_ms;
  Mask covered;
  while (static_cast<int>(exposures_ms.size()) < kMaxExposures) {
    std::size_t most = 0;
    int best = 0;
    for (const auto& [step, mask] : measured_) {
      const std::size_t fresh = count_new(mask, covered);
      if (fresh > most) {
        most = fresh;
        best = step;
      }
    }
    if (most == 0 || static_cast<double>(most) < worthwhile) break;
    exposures_ms.push_back(std::ldexp(range_.guess_ms, best));
    add(measured_.at(best), covered);
  }
  if (exposures_ms.empty()) exposures_ms.push_back(range_.guess_ms);
  return exposures_ms;
}

}  // namespace frangia
