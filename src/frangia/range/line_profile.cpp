#include "frangia/range/line_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "frangia/core/error.h"

namespace frangia {
namespace {

struct Peak {
  double centre_px;
  double sigma_px;
};

/// How bright a pixel beside the line is in the line's frame, from how bright it is in the fringe
/// frames: spilled light in proportion, other light in full.
struct Glow {
  double other_counts = 0.0;
  double spilled = 0.0;
  double dark_counts = 0.0;  ///< what the fringes do not light by more than this, the line does not

  [[nodiscard]] double operator()(double lit_counts) const {
    return other_counts + spilled * lit_counts;
  }
};

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A straight line through the medians of equal bins of brightness: the plane of light covers so
/// little of the object that the medians do not see it.
Glow measure_glow(const Frame& line, const Image<float>& lit_counts, const NoiseModel& noise) {
  constexpr std::size_t kBins = 16;
  Glow glow{.dark_counts = 10.0 * std::sqrt(noise.variance(0.0))};
  const float brightest = *std::max_element(lit_counts.pixels().begin(), lit_counts.pixels().end());
  std::array<std::vector<double>, kBins> seen;
  for (int y = 0; y < lit_counts.height(); ++y) {
    for (int x = 0; x < lit_counts.width(); ++x) {
      const double lit = lit_counts(x, y);
      if (lit <= glow.dark_counts) continue;
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
    if (seen[bin].size() < 20) continue;
    const double weight = static_cast<double>(seen[bin].size());
    const double x = (static_cast<double>(bin) + 0.5) * brightest / kBins;
    const double y = median_of(seen[bin]);
    n += weight;
    sx += weight * x;
    sy += weight * y;
    sxx += weight * x * x;
    sxy += weight * x * y;
  }
  if (n == 0.0) return glow;
  const double spread = n * sxx - sx * sx;
  glow.spilled = spread > 0.0 ? std::max(0.0, (n * sxy - sx * sy) / spread) : 0.0;
  glow.other_counts = (sy - glow.spilled * sx) / n;
  if (glow.other_counts < 0.0) glow = {0.0, sxy / sxx, glow.dark_counts};
  return glow;
}

/// Centre of gravity of what stands above a fifth of the peak's height, so that both flanks count
/// alike and the surroundings do not pull.
Peak centre_of(const std::vector<double>& counts,
               std::size_t top,
               double base,
               const NoiseModel& noise,
               int half_width) {
  const double foot = base + 0.2 * (counts[top] - base);
  std::size_t first = top;
  std::size_t last = top;
  const auto reach = static_cast<std::size_t>(half_width);
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
  const double centre = moment / weight;
  double variance = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const double lever = (static_cast<double>(i) - centre) / weight;
    variance += lever * lever * noise.variance(counts[i]);
  }
  return {centre, std::sqrt(variance)};
}

std::vector<Peak> peaks_of(const std::vector<double>& counts,
                           int white_level,
                           const NoiseModel& noise,
                           double least_height,
                           const LineOptions& options) {
  std::vector<Peak> peaks;
  const auto reach = static_cast<std::size_t>(options.half_width_px);
  for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
    // The first of equal values, and the largest within reach: a flank or a speck is no peak.
    if (counts[i] <= counts[i - 1] || counts[i] < counts[i + 1]) continue;
    const auto begin = counts.begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(i - std::min(i, reach));
    const auto here = begin + static_cast<std::ptrdiff_t>(i);
    const auto last = begin + static_cast<std::ptrdiff_t>(std::min(counts.size(), i + reach + 1));
    if (*std::max_element(first, last) > counts[i]) continue;
    if (std::count_if(first, last, [&](double c) { return c >= white_level; }) > 3) continue;
    // The brighter of both sides: one of them may be the dark beyond the object's edge.
    const double base = std::max(*std::min_element(first, here), *std::min_element(here + 1, last));
    const double height = counts[i] - base;
    if (height < options.min_sigmas * std::sqrt(noise.variance(counts[i])) + 2.0) continue;
    if (height < least_height) continue;
    // Two pixels at least share a real line's light; a hot pixel stands alone.
    if (std::max(counts[i - 1], counts[i + 1]) < counts[i] - 0.9 * height) continue;
    peaks.push_back(centre_of(counts, i, base, noise, options.half_width_px));
  }
  return peaks;
}

}  // namespace

std::vector<ProfilePoint> line_profile(const FrameStack& line,
                                       const Image<float>& lit_counts,
                                       const Rig& rig,
                                       const NoiseModel& noise,
                                       const LineOptions& options) {
  require(rig.line.has_value(), "line_profile: the rig has no plane of light");
  require(line.frames.size() == 1, "line_profile: a line pattern has one frame");
  const Frame& frame = line.frames.front();
  require(lit_counts.width() == width_of(frame) && lit_counts.height() == height_of(frame),
          "line_profile: the line and the fringes differ in size");
  const LightPlane& plane = *rig.line;
  const Glow glow = measure_glow(frame, lit_counts, noise);
  // The plane meets the image along normal . (x, y, 1) = 0 at infinity: scan across it.
  const bool scan_rows = std::abs(plane.normal.x()) >= std::abs(plane.normal.y());
  const int lines = scan_rows ? height_of(frame) : width_of(frame);
  const int length = scan_rows ? width_of(frame) : height_of(frame);
  const double least_height = options.min_contrast * glow(glow.dark_counts);
  std::vector<ProfilePoint> profile;
  std::vector<double> counts(static_cast<std::size_t>(length));
  for (int across = 0; across < lines; ++across) {
    for (int along = 0; along < length; ++along) {
      const int x = scan_rows ? along : across;
      const int y = scan_rows ? across : along;
      const int seen = counts_at(frame, x, y);
      const double lit = lit_counts(x, y);
      double& above = counts[static_cast<std::size_t>(along)];
      if (seen >= line.white_level) {
        above = seen;  // stays recognisable
      } else {
        above = lit > glow.dark_counts ? std::max(0.0, seen - glow(lit)) : 0.0;
      }
    }
    for (const Peak& peak : peaks_of(counts, line.white_level, noise, least_height, options)) {
      ProfilePoint found;
      found.pixel = scan_rows ? Eigen::Vector2d(peak.centre_px, across)
                              : Eigen::Vector2d(across, peak.centre_px);
      found.sigma_px = peak.sigma_px;
      const Eigen::Vector2d ray = rig.camera.lens.ray(found.pixel);
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
