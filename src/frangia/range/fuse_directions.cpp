#include "frangia/range/fuse_directions.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Difference of the two depths of a pixel along the ray, which sigma refers to, and its noise.
struct Difference {
  double mm = kMissing;
  double sigma_mm = kMissing;
};

Difference difference_of(const RangePixel& a,
                         const RangePixel& b,
                         const Image<Eigen::Vector2f>& rays) {
  const double along_ray = std::sqrt(1.0 + static_cast<double>(rays(a.x, a.y).squaredNorm()));
  return {along_ray * (static_cast<double>(a.depth_mm) - static_cast<double>(b.depth_mm)),
          std::hypot(static_cast<double>(a.sigma_mm), static_cast<double>(b.sigma_mm))};
}

DirectionDisagreement measure_disagreement(const RangeGrid& first,
                                           const RangeGrid& second,
                                           const Image<Eigen::Vector2f>& rays) {
  DirectionDisagreement out;
  std::vector<float> differences_mm;
  std::vector<float> over_sigma;
  for (int y = 0; y < first.depth_mm.height(); ++y) {
    for (int x = 0; x < first.depth_mm.width(); ++x) {
      const Difference found = difference_of(first.pixel(x, y), second.pixel(x, y), rays);
      if (std::isnan(found.mm)) continue;
      differences_mm.push_back(static_cast<float>(std::abs(found.mm)));
      over_sigma.push_back(static_cast<float>(std::abs(found.mm) / found.sigma_mm));
    }
  }
  out.pixels = differences_mm.size();
  if (out.pixels == 0) {
    out.median_mm = out.median_over_sigma = kMissing;
    return out;
  }
  out.median_mm = static_cast<double>(median_in_place(std::span(differences_mm)));
  out.median_over_sigma = static_cast<double>(median_in_place(std::span(over_sigma)));
  return out;
}

/// The point of both planes of light.
RangePixel combined(const RangePixel& a, const RangePixel& b, DirectionFusion fusion) {
  if (fusion == DirectionFusion::Best) {
    if (a.sigma_mm <= b.sigma_mm) return a;
    RangePixel best = b;
    best.phase_rad = a.phase_rad;
    return best;
  }
  const double weight_a = std::pow(static_cast<double>(a.sigma_mm), -2);
  const double weight_b = std::pow(static_cast<double>(b.sigma_mm), -2);
  RangePixel out = a;
  out.depth_mm = static_cast<float>(
      (weight_a * static_cast<double>(a.depth_mm) + weight_b * static_cast<double>(b.depth_mm)) /
      (weight_a + weight_b));
  out.sigma_mm = static_cast<float>(1.0 / std::sqrt(weight_a + weight_b));
  // Errors of the rig are common to both directions: they do not average out.
  const double systematic_a =
      std::isnan(a.systematic_mm) ? 0.0 : static_cast<double>(a.systematic_mm);
  const double systematic_b =
      std::isnan(b.systematic_mm) ? 0.0 : static_cast<double>(b.systematic_mm);
  out.systematic_mm = static_cast<float>((weight_a * systematic_a + weight_b * systematic_b) /
                                         (weight_a + weight_b));
  return out;
}

}  // namespace

DirectionDisagreement fuse_directions(const RangeGrid& second,
                                      const Image<Eigen::Vector2f>& rays,
                                      const FuseDirectionsOptions& options,
                                      RangeGrid& first,
                                      Image<PixelStatus>& status) {
  require(same_size(first.depth_mm, second.depth_mm) && same_size(first.depth_mm, status),
          "fuse_directions: the range grids differ in size");
  require(same_size(first.depth_mm, rays), "fuse_directions: range grid and rays differ in size");
  DirectionDisagreement out = measure_disagreement(first, second, rays);
  if (first.systematic_mm.empty() && !second.systematic_mm.empty())
    first.systematic_mm = Image<float>(first.depth_mm.width(), first.depth_mm.height(), 0.0F);
  const double typical_mm = out.pixels == 0 ? 0.0 : out.median_mm / kMedianOfNormal;
  std::vector<std::size_t> removed(static_cast<std::size_t>(status.height()));
  parallel_rows(status.height(), [&](int y) {
    for (int x = 0; x < status.width(); ++x) {
      const RangePixel a = first.pixel(x, y);
      RangePixel b = second.pixel(x, y);
      if (std::isnan(b.depth_mm)) continue;
      if (std::isnan(a.depth_mm)) {
        b.phase_rad = kMissing;
        first.set(b);
        status(x, y) = PixelStatus::Measured;
        continue;
      }
      const Difference found = difference_of(a, b, rays);
      if (std::abs(found.mm) > options.max_sigmas * std::hypot(found.sigma_mm, typical_mm)) {
        first.remove(x, y);
        status(x, y) = PixelStatus::UncertainOrder;
        ++removed[static_cast<std::size_t>(y)];
        continue;
      }
      first.set(combined(a, b, options.fusion));
    }
  });
  for (const std::size_t row : removed)
    out.removed += row;
  return out;
}

}  // namespace frangia
