#include "frangia/range/fuse_directions.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/uncertainty/combined_sigma.h"

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

float known_or_zero(float part) {
  return std::isnan(part) ? 0.0F : part;
}

/// Both measurements of a pixel; `apart_mm` is NaN where one is missing.
DepthPair pair_at(const RangeGrid& first,
                  const RangeGrid& second,
                  const Image<Eigen::Vector2f>& rays,
                  int x,
                  int y) {
  const RangePixel a = first.pixel(x, y);
  const RangePixel b = second.pixel(x, y);
  const Difference found = difference_of(a, b, rays);
  return {
      .x = x,
      .y = y,
      .point_mm = a.depth_mm * rays(x, y).homogeneous(),
      .apart_mm = static_cast<float>(found.mm),
      .sigma_mm = static_cast<float>(found.sigma_mm),
      .systematic_mm = std::hypot(known_or_zero(a.systematic_mm), known_or_zero(b.systematic_mm)),
      .first_rad = a.phase_rad,
      .second_rad = b.phase_rad};
}

/// The pixels of some rows that both directions measured.
std::vector<DepthPair> pairs_of(const RangeGrid& first,
                                const RangeGrid& second,
                                const Image<Eigen::Vector2f>& rays) {
  constexpr int kMost = 300'000;  // pixels
  const int height = first.depth_mm.height();
  const int step = std::max(1, static_cast<int>(first.depth_mm.pixels().size()) / kMost);
  std::vector<DepthPair> pairs;
  for (int y = step / 2; y < height; y += step) {
    for (int x = 0; x < first.depth_mm.width(); ++x) {
      const DepthPair pair = pair_at(first, second, rays, x, y);
      if (!std::isnan(pair.apart_mm)) pairs.push_back(pair);
    }
  }
  return pairs;
}

constexpr int kBlock = 16;  // pixels

/// Square of what the known uncertainties of a block do not explain: of the median of its
/// differences, and `with_rest` of their scatter about it.
///
/// The median is certain to 1.25 sigma over the root of the pixels however well the noise of a
/// pixel is known, so that it shows the smooth part, which averaging does not reduce.
double unexplained2_of(std::span<const DepthPair> members, bool with_rest) {
  constexpr double kMedianError = 1.25;  // of a median over that of a mean
  constexpr double kSignificant = 4.0;   // standard errors
  std::vector<float> apart;
  double variance = 0.0;
  double systematic2 = 0.0;
  for (const DepthPair& pair : members) {
    apart.push_back(pair.apart_mm);
    variance += std::pow(static_cast<double>(pair.sigma_mm), 2);
    systematic2 += std::pow(static_cast<double>(pair.systematic_mm), 2);
  }
  const auto count = static_cast<double>(members.size());
  const double error2 = kMedianError * kMedianError * variance / (count * count);
  const double known2 = systematic2 / count;
  const float middle = median(apart);
  const double found2 = std::pow(static_cast<double>(middle), 2);
  const bool significant = found2 > kSignificant * kSignificant * error2 + known2;
  double out = significant ? found2 - error2 - known2 : 0.0;
  if (!with_rest) return out;
  for (float& one : apart)
    one = std::abs(one - middle);
  const double rest2 = std::pow(static_cast<double>(median(std::move(apart))) / kMedianOfNormal, 2);
  return out + std::max(0.0, rest2 - variance / count - known2);
}

/// What of the disagreement the known uncertainties do not explain, for each block of pixels; empty
/// if nothing is left. A block that hardly any pixel of both directions measured has the median of
/// the others: a wrong rig moves its points as far.
Image<float> unexplained_part(const RangeGrid& first,
                              const RangeGrid& second,
                              const Image<Eigen::Vector2f>& rays,
                              const DepthAgreement& found) {
  if (found.pixels == 0 || found.by_calibration) return {};
  // What is not smooth counts only where it exceeds what an estimate of the noise may be wrong by.
  const bool with_rest = found.chi_squared >= kConsistent;
  constexpr std::size_t kLeast = 32;  // pixels that make a median
  Image<float> out(rays.width() / kBlock + 1, rays.height() / kBlock + 1, kMissing);
  parallel_rows(out.height(), [&](int row) {
    std::vector<DepthPair> members;
    for (int column = 0; column < out.width(); ++column) {
      members.clear();
      for (int y = row * kBlock; y < std::min(rays.height(), (row + 1) * kBlock); ++y) {
        for (int x = column * kBlock; x < std::min(rays.width(), (column + 1) * kBlock); ++x) {
          const DepthPair pair = pair_at(first, second, rays, x, y);
          if (!std::isnan(pair.apart_mm)) members.push_back(pair);
        }
      }
      if (members.size() < kLeast) continue;
      out(column, row) = static_cast<float>(std::sqrt(unexplained2_of(members, with_rest)));
    }
  });
  std::vector<float> known;
  for (const float part : out.pixels())
    if (!std::isnan(part)) known.push_back(part);
  if (std::none_of(known.begin(), known.end(), [](float part) { return part > 0.0F; })) return {};
  const float typical = median(std::move(known));
  for (float& part : out.pixels())
    if (std::isnan(part)) part = typical;
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
  const auto systematic_a = static_cast<double>(known_or_zero(a.systematic_mm));
  const auto systematic_b = static_cast<double>(known_or_zero(b.systematic_mm));
  out.systematic_mm = static_cast<float>((weight_a * systematic_a + weight_b * systematic_b) /
                                         (weight_a + weight_b));
  return out;
}

}  // namespace

void add_unexplained(const Image<float>& unexplained_mm, RangeGrid& range) {
  if (unexplained_mm.empty()) return;
  const Image<float>& depth_mm = range.depth_mm;
  range.differing_share = 0.0F;  // the rig is that of all views
  if (range.systematic_mm.empty())
    range.systematic_mm = Image<float>(depth_mm.width(), depth_mm.height(), 0.0F);
  parallel_rows(depth_mm.height(), [&](int y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      if (std::isnan(depth_mm(x, y))) continue;
      float& systematic = range.systematic_mm(x, y);
      systematic =
          combined_sigma(known_or_zero(systematic), unexplained_mm(x / kBlock, y / kBlock));
    }
  });
}

DirectionDisagreement fuse_directions(const RangeGrid& second,
                                      const Image<Eigen::Vector2f>& rays,
                                      const FuseDirectionsOptions& options,
                                      RangeGrid& first,
                                      Image<PixelStatus>& status) {
  require(same_size(first.depth_mm, second.depth_mm) && same_size(first.depth_mm, status),
          "fuse_directions: the range grids differ in size");
  require(same_size(first.depth_mm, rays), "fuse_directions: range grid and rays differ in size");
  DirectionDisagreement out{measure_agreement(pairs_of(first, second, rays), options.calibration)};
  out.unexplained_mm = unexplained_part(first, second, rays, out);
  if (first.systematic_mm.empty() && !second.systematic_mm.empty())
    first.systematic_mm = Image<float>(first.depth_mm.width(), first.depth_mm.height(), 0.0F);
  const double typical_mm = out.pixels == 0 ? 0.0 : out.median_mm / kMedianOfNormal;
  std::vector<std::size_t> removed(static_cast<std::size_t>(status.height()));
  parallel_rows(status.height(), [&](int y) {
    for (int x = 0; x < status.width(); ++x) {
      const RangePixel a = first.pixel(x, y);
      RangePixel b = second.pixel(x, y);
      if (std::isnan(b.depth_mm)) continue;
      b.systematic_mm = known_or_zero(b.systematic_mm);
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
  add_unexplained(out.unexplained_mm, first);
  return out;
}

}  // namespace frangia
