#include "frangia/decode/explain/internal/frame_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "frangia/core/median.h"

namespace frangia {
namespace {

constexpr int kBlock = 3;              ///< px along each side of a block
constexpr int kFewestBlocks = 20;      ///< along the longer side of the image
constexpr int kMostBlocks = 80;        ///< the same where the part is small
constexpr Eigen::Index kEnough = 900;  ///< pixels
constexpr double kLit = 0.25;          ///< least change of a pixel over the large changes
constexpr double kLitSigmas = 8.0;     ///< least change of a lit pixel over the noise
constexpr double kMinCounts = 4.0;     ///< least scale: less light says nothing

struct Place {
  int x;
  int y;
  int block;
};

std::vector<Place> places_in(int width, int height, int blocks) {
  const int step = std::max(kBlock + 1, std::max(width, height) / blocks);
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

/// Whether the light of each pixel changes over the frames by more than noise.
Eigen::Array<bool, Eigen::Dynamic, 1> lit(const Eigen::ArrayXXd& counts, const NoiseModel& noise) {
  const Eigen::ArrayXd sigma = counts.rowwise().mean().unaryExpr(
      [&](double mean) { return std::sqrt(noise.variance(mean)); });
  return counts.rowwise().maxCoeff() - counts.rowwise().minCoeff() > kLitSigmas * sigma;
}

/// Frames in which nearly all lit pixels are saturated, while in most others they are not.
std::vector<bool> white_frames(const Eigen::ArrayXXd& counts,
                               const Eigen::Array<bool, Eigen::Dynamic, 1>& is_lit,
                               double white_level) {
  const double all = std::max(1.0, static_cast<double>(is_lit.count()));
  std::vector<double> shares;
  for (Eigen::Index k = 0; k < counts.cols(); ++k) {
    const auto saturated = (counts.col(k) >= white_level && is_lit).count();
    shares.push_back(static_cast<double>(saturated) / all);
  }
  constexpr double kWhite = 0.9;
  constexpr double kOthers = 0.5;
  const bool others = median(shares) < kOthers;
  std::vector<bool> out;
  for (const double share : shares)
    out.push_back(others && share > kWhite);
  return out;
}

FrameSample sample_at(const FrameStack& stack,
                      const NoiseModel& noise,
                      const std::vector<Place>& places) {
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
  const Eigen::Array<bool, Eigen::Dynamic, 1> is_lit = lit(counts, noise);
  const std::vector<bool> white = white_frames(counts, is_lit, stack.white_level);
  std::vector<Eigen::Index> usable;
  std::vector<double> scales;
  std::vector<double> changes;
  for (Eigen::Index i = 0; i < counts.rows(); ++i) {
    if (!is_lit(i)) continue;
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

}  // namespace

FrameSample sample_blocks(const FrameStack& stack, const NoiseModel& noise) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  FrameSample out;
  for (int blocks = kFewestBlocks; blocks <= kMostBlocks; blocks *= 2) {
    out = sample_at(stack, noise, places_in(width, height, blocks));
    if (out.counts.rows() >= kEnough) break;
  }
  return out;
}

}  // namespace frangia
