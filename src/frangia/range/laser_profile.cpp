#include "frangia/range/laser_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Least height of a peak above its base, in standard deviations of the camera's noise.
constexpr double kLaserProfileMinSigmas = 6.0;

/// Added to it for the quantization of dark frames.
constexpr double kMinHeight_counts = 2.0;

/// Least height of the brighter neighbour of a peak's pixel, as a share of the peak's height.
constexpr double kMinNeighbor = 0.1;

/// Largest number of saturated pixels of a peak.
constexpr int kMaxSaturated_px = 3;

struct Peak {
  double center_px;
  double sigma_px;
};

/// Predicts the counts of a pixel beside the line from its counts in the fringe frames: spilled
/// laser light is proportional to them, ambient light is constant.
struct StrayLight {
  double ambient_counts = 0.0;
  double spill_ratio = 0.0;
  double dark_counts = 0.0;  ///< pixels darker than this in the fringe frames are background

  [[nodiscard]] double operator()(double fringe_counts) const {
    return ambient_counts + spill_ratio * fringe_counts;
  }
};

/// Fits a straight line through the medians of equal bins of brightness. The laser line covers so
/// few pixels that it does not affect the medians.
StrayLight estimate_stray_light(const Frame& line,
                                const Image<float>& fringe_counts,
                                const NoiseModel& noise) {
  constexpr std::size_t kBins = 16;      // the fit has two unknowns
  constexpr std::size_t kMinInBin = 20;  // for a median that single pixels do not affect
  constexpr double kDarkSigmas = 10.0;   // of the noise without light
  StrayLight stray_light{.dark_counts = kDarkSigmas * std::sqrt(noise.variance(0.0))};
  const float brightest =
      *std::max_element(fringe_counts.pixels().begin(), fringe_counts.pixels().end());
  std::array<std::vector<double>, kBins> seen;
  for (int y = 0; y < fringe_counts.height(); ++y) {
    for (int x = 0; x < fringe_counts.width(); ++x) {
      const double lit = fringe_counts(x, y);
      if (lit <= stray_light.dark_counts) continue;
      const auto bin = static_cast<std::size_t>(lit / brightest * kBins);
      seen[std::min(bin, kBins - 1)].push_back(counts_at(line, x, y));
    }
  }
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (seen[bin].size() < kMinInBin) continue;
    const double weight = static_cast<double>(seen[bin].size());
    const double x = (static_cast<double>(bin) + 0.5) * brightest / kBins;
    const double y = median_in_place(std::span<double>(seen[bin]));
    n += weight;
    sx += weight * x;
    sy += weight * y;
    sxx += weight * x * x;
    sxy += weight * x * y;
  }
  if (n == 0.0) return stray_light;
  const double spread = n * sxx - sx * sx;
  stray_light.spill_ratio = spread > 0.0 ? std::max(0.0, (n * sxy - sx * sy) / spread) : 0.0;
  stray_light.ambient_counts = (sy - stray_light.spill_ratio * sx) / n;
  if (stray_light.ambient_counts < 0.0) stray_light = {0.0, sxy / sxx, stray_light.dark_counts};
  return stray_light;
}

/// Centre of gravity of the part of a peak above `LaserProfileOptions::threshold`, which keeps the
/// surroundings from biasing the centre.
Peak center_of(const std::vector<double>& counts,
               std::size_t top,
               double base,
               const NoiseModel& noise,
               const LaserProfileOptions& options) {
  const double foot = base + options.threshold * (counts[top] - base);
  std::size_t first = top;
  std::size_t last = top;
  const auto reach = static_cast<std::size_t>(options.half_width_px);
  while (first > 0 && top - first < reach && counts[first - 1] > foot)
    --first;
  while (last + 1 < counts.size() && last - top < reach && counts[last + 1] > foot)
    ++last;
  double weight = 0.0;
  double moment = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    weight += counts[i] - foot;
    moment += (counts[i] - foot) * static_cast<double>(i);
  }
  const double center = moment / weight;
  double variance = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const double lever = (static_cast<double>(i) - center) / weight;
    variance += lever * lever * noise.variance(counts[i]);
  }
  return {center, std::sqrt(variance)};
}

std::vector<Peak> peaks_of(const std::vector<double>& counts,
                           int white_level,
                           const NoiseModel& noise,
                           double least_height,
                           const LaserProfileOptions& options) {
  std::vector<Peak> peaks;
  const auto reach = static_cast<std::size_t>(options.half_width_px);
  for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
    // A peak is the first of equal values and the maximum within reach.
    if (counts[i] <= counts[i - 1] || counts[i] < counts[i + 1]) continue;
    const auto begin = counts.begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(i - std::min(i, reach));
    const auto here = begin + static_cast<std::ptrdiff_t>(i);
    const auto last = begin + static_cast<std::ptrdiff_t>(std::min(counts.size(), i + reach + 1));
    if (*std::max_element(first, last) > counts[i]) continue;
    const auto saturated = std::count_if(first, last, [&](double c) { return c >= white_level; });
    if (saturated > kMaxSaturated_px) continue;
    // The base is the brighter side: the other may be the background beyond the object's edge.
    const double base = std::max(*std::min_element(first, here), *std::min_element(here + 1, last));
    const double height = counts[i] - base;
    const double noise_height = kLaserProfileMinSigmas * std::sqrt(noise.variance(counts[i]));
    if (height < noise_height + kMinHeight_counts) continue;
    if (height < least_height) continue;
    // A laser line covers at least two pixels; a hot pixel is single.
    if (std::max(counts[i - 1], counts[i + 1]) < base + kMinNeighbor * height) continue;
    peaks.push_back(center_of(counts, i, base, noise, options));
  }
  return peaks;
}

}  // namespace

std::vector<ProfilePoint> laser_profile(const FrameStack& line,
                                        const Image<float>& fringe_counts,
                                        const Rig& rig,
                                        const NoiseModel& noise,
                                        const LaserProfileOptions& options) {
  require(rig.laser_sheet.has_value(), "laser_profile: the rig has no laser sheet");
  require(line.frames.size() == 1, "laser_profile: a line pattern must have exactly one frame");
  const Frame& frame = line.frames.front();
  require(fringe_counts.width() == width_of(frame) && fringe_counts.height() == height_of(frame),
          "laser_profile: the frames of the line and the fringes differ in size");
  const LaserSheet& plane = *rig.laser_sheet;
  const StrayLight stray_light = estimate_stray_light(frame, fringe_counts, noise);
  // The laser line runs along normal . (x, y, 1) = 0 in the image: search across it.
  const bool scan_rows = std::abs(plane.normal.x()) >= std::abs(plane.normal.y());
  const int lines = scan_rows ? height_of(frame) : width_of(frame);
  const int length = scan_rows ? width_of(frame) : height_of(frame);
  const double least_height = options.min_contrast * stray_light(stray_light.dark_counts);
  std::vector<ProfilePoint> profile;
  std::vector<double> counts(static_cast<std::size_t>(length));
  for (int across = 0; across < lines; ++across) {
    for (int along = 0; along < length; ++along) {
      const int x = scan_rows ? along : across;
      const int y = scan_rows ? across : along;
      const int seen = counts_at(frame, x, y);
      const double lit = fringe_counts(x, y);
      double& above = counts[static_cast<std::size_t>(along)];
      if (seen >= line.white_level) {
        above = seen;  // keeps saturated pixels recognizable
      } else {
        above = lit > stray_light.dark_counts ? std::max(0.0, seen - stray_light(lit)) : 0.0;
      }
    }
    for (const Peak& peak : peaks_of(counts, line.white_level, noise, least_height, options)) {
      ProfilePoint found;
      found.pixel = scan_rows ? Eigen::Vector2d(peak.center_px, across)
                              : Eigen::Vector2d(across, peak.center_px);
      found.sigma_px = peak.sigma_px;
      const Eigen::Vector2d ray = rig.reference().model.ray(found.pixel);
      const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
      const double depth = plane.offset_mm / plane.normal.dot(direction);
      if (!(depth > 0.0) || std::isinf(depth)) continue;
      found.point_mm = depth * direction;
      profile.push_back(found);
    }
  }
  return profile;
}

}  // namespace frangia
