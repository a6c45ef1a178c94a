#include "frangia/range/line_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/error.h"

namespace frangia {
namespace {

struct Peak {
  double centre_px;
  double sigma_px;
};

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
    if (height < options.min_sigmas * std::sqrt(noise.variance(base)) + 2.0) continue;
    // Two pixels at least share a real line's light; a hot pixel stands alone.
    if (std::max(counts[i - 1], counts[i + 1]) < counts[i] - 0.9 * height) continue;
    peaks.push_back(centre_of(counts, i, base, noise, options.half_width_px));
  }
  return peaks;
}

}  // namespace

std::vector<ProfilePoint> line_profile(const FrameStack& line,
                                       const Rig& rig,
                                       const NoiseModel& noise,
                                       const LineOptions& options) {
  require(rig.line.has_value(), "line_profile: the rig has no plane of light");
  require(line.frames.size() == 1, "line_profile: a line pattern has one frame");
  const Frame& frame = line.frames.front();
  const LightPlane& plane = *rig.line;
  // The plane meets the image along normal . (x, y, 1) = 0 at infinity: scan across it.
  const bool scan_rows = std::abs(plane.normal.x()) >= std::abs(plane.normal.y());
  const int lines = scan_rows ? height_of(frame) : width_of(frame);
  const int length = scan_rows ? width_of(frame) : height_of(frame);
  std::vector<ProfilePoint> profile;
  std::vector<double> counts(static_cast<std::size_t>(length));
  for (int across = 0; across < lines; ++across) {
    for (int along = 0; along < length; ++along) {
      counts[static_cast<std::size_t>(along)] =
          scan_rows ? counts_at(frame, along, across) : counts_at(frame, across, along);
    }
    for (const Peak& peak : peaks_of(counts, line.white_level, noise, options)) {
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
