#include "frangia/decode/explain/internal/frame_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "frangia/core/median.h"

namespace frangia {
namespace {

constexpr int kBlock = 3;         ///< px along each side of a block
constexpr int kBlocksAlong = 20;  ///< blocks along the longer side of the image
constexpr double kLit = 0.25;  ///< least change of a lit pixel over that of the most changing ones
constexpr double kMinCounts = 4.0;  ///< least scale: less light says nothing

struct Place {
  int x;
  int y;
  int block;
};

std::vector<Place> places_in(int width, int height) {
  const int step = std::max(kBlock + 1, std::max(width, height) / kBlocksAlong);
  std::vector<Place> places;
  int block = 0;
  for (int y = step / 2; y + kBlock <= height; y += step) {
    for (int x = step / 2; x + kBlock <= width; x += step, ++block) {
      for (int dy = 0; dy < kBlock; ++dy)
        for (int dx = 0; dx < kBlock; ++dx)
          places.push_back({x + dx, y + dy, block});
    }
  }
  return places;
}

/// Frames that are saturated nearly everywhere, while most others are not: white ones.
std::vector<bool> white_frames(const Eigen::ArrayXXd& counts, double white_level) {
  const Eigen::ArrayXd shares = (counts >= white_level).cast<double>().colwise().mean().transpose();
  std::vector<double> all(shares.begin(), shares.end());
  constexpr double kWhite = 0.9;
  constexpr double kOthers = 0.5;
  const bool others = median(all) < kOthers;
  std::vector<bool> out;
  for (const double share : shares)
    out.push_back(others && share > kWhite);
  return out;
}

}  // namespace

FrameSample sample_blocks(const FrameStack& stack, const NoiseModel& noise) {
  const std::vector<Place> places =
      places_in(width_of(stack.frames.front()), height_of(stack.frames.front()));
  const Eigen::Index frames = std::ssize(stack.frames);
  Eigen::ArrayXXd counts(std::ssize(places), frames);
  for (Eigen::Index k = 0; k < frames; ++k) {
    std::visit(
        [&](const auto& image) {
          for (std::size_t i = 0; i < places.size(); ++i)
            counts(static_cast<Eigen::Index>(i), k) =
                static_cast<double>(image(places[i].x, places[i].y));
        },
        stack.frames[static_cast<std::size_t>(k)]);
  }
  const std::vector<bool> white = white_frames(counts, stack.white_level);
  std::vector<Eigen::Index> usable;
  std::vector<double> scales;
  std::vector<double> changes;
  for (Eigen::Index i = 0; i < counts.rows(); ++i) {
    double scale = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < frames; ++k) {
      if (white[static_cast<std::size_t>(k)]) continue;
      scale = std::max(scale, counts(i, k));
      least = std::min(least, counts(i, k));
    }
    if (scale >= stack.white_level || scale < kMinCounts) continue;
    usable.push_back(i);
    scales.push_back(scale);
    changes.push_back(scale - least);
  }
  FrameSample out;
  if (usable.empty()) return out;
  std::vector<double> ordered = changes;
  const auto high = ordered.begin() + std::ssize(ordered) * 9 / 10;
  std::nth_element(ordered.begin(), high, ordered.end());
  const double least = kLit * *high;
  std::vector<Eigen::Index> kept;
  std::vector<double> kept_scales;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (changes[i] < least) continue;
    kept.push_back(usable[i]);
    kept_scales.push_back(scales[i]);
    out.blocks.push_back(places[static_cast<std::size_t>(usable[i])].block);
  }
  out.counts = counts(kept, Eigen::all);
  out.scale_counts = Eigen::Map<const Eigen::ArrayXd>(kept_scales.data(), std::ssize(kept_scales));
  out.variance = out.counts.rowwise().mean().unaryExpr(
      [&](double mean) { return noise.variance(mean) + 1e-3; });
  return out;
}

}  // namespace frangia
