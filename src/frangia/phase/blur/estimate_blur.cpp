#include "frangia/phase/blur/estimate_blur.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// The logarithm of the ratio of two modulations over 2 pi^2 times the difference of f^2.
struct Weakening {
  double x = 0.0;
  double log_ratio = 0.0;
  int column = 0;  ///< of the image
};

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Change of a wrapped phase over one pixel, NaN where its neighbours disagree.
double slope_of(float before, float here, float after) {
  constexpr double kBent_rad = 0.5;
  const auto wrapped = [](double rad) { return std::remainder(rad, kTwoPi); };
  const double back = wrapped(static_cast<double>(here) - static_cast<double>(before));
  const double on = wrapped(static_cast<double>(after) - static_cast<double>(here));
  if (!(std::abs(on - back) < kBent_rad)) return kUnknown;
  return 0.5 * (back + on);
}

std::vector<Weakening> weakenings(const WholeLight& light, const WrappedPhase& fine) {
  // A phase this certain has a modulation whose logarithm has no bias by noise worth mentioning.
  constexpr float kCertain_rad = 0.05F;
  const double ratio = light.fringes / fine.pattern.fringes_per_unit();
  const Image<float>& phase = fine.phase_rad;
  std::vector<Weakening> out;
  for (int y = 1; y + 1 < phase.height(); y += kBlurBandRows) {
    for (int x = 1; x + 1 < phase.width(); ++x) {
      const auto whole = static_cast<double>(light.counts(x, y));
      if (!(fine.sigma_rad(x, y) < kCertain_rad && whole > 0.0)) continue;
      const double across = slope_of(phase(x - 1, y), phase(x, y), phase(x + 1, y));
      const double down = slope_of(phase(x, y - 1), phase(x, y), phase(x, y + 1));
      const double square = 0.5 * (across * across + down * down);  // 2 pi^2 f^2
      if (std::isnan(square)) continue;
      const auto weaker = static_cast<double>(fine.modulation_counts(x, y));
      out.push_back({square * (1.0 - ratio * ratio), std::log(weaker / whole), x});
    }
  }
  return out;
}

/// A line through the medians of groups of equal size, which single edges do not bend.
struct Line {
  double slope = kUnknown;
  double spread = 0.0;  ///< of the slope's predictions over all groups
  double rms = 0.0;     ///< of the medians about the line
};

Line line_through(std::vector<Weakening> samples) {
  constexpr std::size_t kGroups = 24;
  constexpr std::size_t kLeast = 20;  // samples of a group
  Line line;
  if (samples.size() < kGroups * kLeast) return line;
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  std::vector<std::array<double, 2>> medians;
  for (std::size_t g = 0; g < kGroups; ++g) {
    std::vector<double> x;
    std::vector<double> y;
    const std::size_t end = (g + 1) * samples.size() / kGroups;
    for (std::size_t i = g * samples.size() / kGroups; i < end; ++i) {
      x.push_back(samples[i].x);
      y.push_back(samples[i].log_ratio);
    }
    medians.push_back({median(std::move(x)), median(std::move(y))});
  }
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const auto& [x, y] : medians) {
    mean_x += x / kGroups;
    mean_y += y / kGroups;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const auto& [x, y] : medians) {
    xx += (x - mean_x) * (x - mean_x);
    xy += (x - mean_x) * (y - mean_y);
  }
  line.slope = xy / xx;
  line.spread = std::abs(line.slope) * std::sqrt(xx / kGroups);
  for (const auto& [x, y] : medians)
    line.rms += std::pow(y - mean_y - line.slope * (x - mean_x), 2) / kGroups;
  line.rms = std::sqrt(line.rms);
  return line;
}

/// The standard uncertainty of the slope: how much it changes without each block of neighbouring
/// columns, whose samples have more in common than noise. Blocks hold equally many samples, as a
/// part may cover a few columns only.
double jackknifed(std::vector<Weakening> samples) {
  constexpr std::size_t kBlocks = 8;
  std::stable_sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.column < b.column;
  });
  const auto at = [&](std::size_t block) {
    return samples.begin() + static_cast<std::ptrdiff_t>(block * samples.size() / kBlocks);
  };
  std::vector<double> slopes;
  for (std::size_t left_out = 0; left_out < kBlocks; ++left_out) {
    std::vector<Weakening> rest(samples.begin(), at(left_out));
    rest.insert(rest.end(), at(left_out + 1), samples.end());
    slopes.push_back(line_through(std::move(rest)).slope);
  }
  constexpr auto count = static_cast<double>(kBlocks);
  const double mean = std::accumulate(slopes.begin(), slopes.end(), 0.0) / count;
  double square = 0.0;
  for (const double slope : slopes)
    square += std::pow(slope - mean, 2);
  return std::sqrt(square * (count - 1.0) / count);
}

/// Fringes of the whole light, of those of the fine pattern: with more, both are weakened alike.
constexpr double kMostFringes = 0.95;

}  // namespace

WholeLight whole_light(const WrappedPhase& coarse) {
  return {coarse.modulation_counts, coarse.pattern.fringes_per_unit()};
}

WholeLight whole_light(const FrameStack& gray) {
  const int width = width_of(gray.frames.front());
  const int height = height_of(gray.frames.front());
  WholeLight light{Image<float>(width, height)};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      int darkest = gray.white_level;
      int brightest = 0;
      for (const Frame& frame : gray.frames) {
        darkest = std::min(darkest, counts_at(frame, x, y));
        brightest = std::max(brightest, counts_at(frame, x, y));
      }
      light.counts(x, y) =
          brightest < gray.white_level ? 0.5F * static_cast<float>(brightest - darkest) : kMissing;
    }
  });
  return light;
}

std::optional<ImageBlur> estimate_blur(const WholeLight& whole, const WrappedPhase& fine) {
  constexpr double kLeast_px2 = 0.1;    // the area of a pixel has 0.083
  constexpr double kMost_px2 = 25.0;    // no fringes remain
  constexpr double kStraight = 0.35;    // of the line's own spread
  constexpr double kSignificant = 5.0;  // times its uncertainty
  if (whole.fringes > kMostFringes * fine.pattern.fringes_per_unit()) return {};
  const std::vector<Weakening> samples = weakenings(whole, fine);
  const Line line = line_through(samples);
  ImageBlur blur{.variance_px2 = -line.slope};
  if (!(blur.variance_px2 > kLeast_px2 && blur.variance_px2 < kMost_px2)) return {};
  if (line.rms > kStraight * line.spread) return {};
  blur.u_px2 = jackknifed(samples);
  if (!(blur.variance_px2 > kSignificant * blur.u_px2)) return {};
  return blur;
}

double averaged_variance(const WholeLight& whole, const WrappedPhase& fine) {
  constexpr double kClearly = 3.0;          // times the uncertainty
  constexpr std::size_t kSamples = 20'000;  // tell 0.01 px^2
  if (whole.fringes > kMostFringes * fine.pattern.fringes_per_unit()) return kPixelAreaVariance;
  const std::vector<Weakening> all = weakenings(whole, fine);
  std::vector<Weakening> samples;
  const std::size_t step = all.size() / kSamples + 1;
  for (std::size_t i = 0; i < all.size(); i += step)
    samples.push_back(all[i]);
  const double found = -line_through(samples).slope;
  const bool is_less = found + kClearly * jackknifed(samples) < kPixelAreaVariance;
  return is_less ? std::max(0.0, found) : kPixelAreaVariance;
}

std::string describe(const ImageBlur& blur) {
  return fmt::format(
      "the phase is corrected at edges of brightness for the blur of the camera, {:.2f} px "
      "(`ignore_blur` leaves it)",
      blur.sigma_px());
}

}  // namespace frangia
