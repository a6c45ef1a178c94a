#include "frangia/decode/explain/internal/frame_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

constexpr int kBlock = 3;              ///< px along each side of a block
constexpr int kFewestBlocks = 14;      ///< along the longer side of the image
constexpr int kMostBlocks = 112;       ///< the same where the part is small
constexpr Eigen::Index kEnough = 900;  ///< pixels
constexpr Eigen::Index kEnoughResiduals = 4500;
constexpr double kLit = 0.25;       ///< least change of a pixel over the large changes
constexpr double kLitSigmas = 8.0;  ///< least change of a lit pixel over the noise
constexpr double kMinCounts = 4.0;  ///< least scale: less light says nothing

struct Place {
  int x;
  int y;
  int block;
};

/// One block at random in each square of a grid: at equal distances, all blocks would see the same
/// phase of fringes whose period divides them.
std::vector<Place> places_in(int width, int height, int blocks) {
  const int step = std::max(kBlock + 1, std::max(width, height) / blocks);
  std::vector<Place> places;
  int block = 0;
  for (int row = 0; row + kBlock <= height; row += step) {
    for (int column = 0; column + kBlock <= width; column += step, ++block) {
      const auto shifted = [&](int from, int size, std::size_t axis) {
        const int room = std::min(step, size - from) - kBlock;
        const double share = uniform_from(hash(hash(axis), static_cast<std::size_t>(block)));
        return from + static_cast<int>(share * (room + 1));
      };
      const int x = shifted(column, width, 0);
      const int y = shifted(row, height, 1);
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

/// Change of each pixel over its frames without the one that changes it most; over all frames where
/// three leave nothing.
double change_of(const Eigen::ArrayXd& counts) {
  std::vector<double> ordered(counts.begin(), counts.end());
  std::sort(ordered.begin(), ordered.end());
  const std::size_t last = ordered.size() - 1;
  if (ordered.size() <= 3) return ordered[last] - ordered[0];
  return std::min(ordered[last] - ordered[1], ordered[last - 1] - ordered[0]);
}

/// Pixels of the background that a single frame, or a lamp from one frame on, changes and nothing
/// else: many pixels with the same change over the frames, while fringes change each in its own
/// way.
std::vector<bool> changed_by_one_cause(const Eigen::ArrayXXd& counts,
                                       const std::vector<Eigen::Index>& usable,
                                       const NoiseModel& noise) {
  const Eigen::Index frames = counts.cols();
  constexpr double kAlone = 0.15;  // change beside the cause, over the whole change
  std::vector<std::vector<bool>> by_cause;
  std::vector<double> shares;
  const auto look_at = [&](const auto& change_without) {
    std::vector<bool> changed(usable.size());
    for (std::size_t i = 0; i < usable.size(); ++i) {
      const Eigen::ArrayXd pixel = counts.row(usable[i]);
      const double all = pixel.maxCoeff() - pixel.minCoeff();
      const double sigma = std::sqrt(noise.variance(pixel.mean()));
      changed[i] = change_without(pixel) < std::max(kAlone * all, kLitSigmas * sigma);
    }
    const auto count = std::count(changed.begin(), changed.end(), true);
    shares.push_back(static_cast<double>(count) / static_cast<double>(usable.size()));
    by_cause.push_back(std::move(changed));
  };
  const auto range = [](const auto& some) { return some.maxCoeff() - some.minCoeff(); };
  for (Eigen::Index k = 0; k < frames; ++k) {
    look_at([&](const Eigen::ArrayXd& pixel) {
      Eigen::ArrayXd others(frames - 1);
      others << pixel.head(k), pixel.tail(frames - 1 - k);
      return range(others);
    });
  }
  for (Eigen::Index from = 2; from + 1 < frames; ++from) {
    look_at([&](const Eigen::ArrayXd& pixel) {
      return std::max(range(pixel.head(from)), range(pixel.tail(frames - from)));
    });
  }
  std::vector<double> ordered = shares;
  std::sort(ordered.begin(), ordered.end(), std::greater<>());
  // Two of three frames are alike on a good part of one coarse fringe, too.
  const double least = frames > 3 ? 0.05 : 0.4;
  constexpr double kOverOthers = 3.0;  // square fringes look like each of the causes alike
  if (ordered[0] < least || ordered[0] < kOverOthers * ordered[1])
    return std::vector<bool>(usable.size());
  constexpr double kAll = 0.9;  // without fringes elsewhere it is the frames that are alike
  if (ordered[0] > kAll) return std::vector<bool>(usable.size());
  const auto most = std::max_element(shares.begin(), shares.end()) - shares.begin();
  return by_cause[static_cast<std::size_t>(most)];
}

/// Places of the pixels, and slopes of the frames by central differences over 3 x 3 pixels.
void add_places(const FrameStack& stack,
                const std::vector<Place>& places,
                const std::vector<Eigen::Index>& kept,
                FrameSample& out) {
  out.slope_x.resize(out.counts.rows(), out.counts.cols());
  out.slope_y.resize(out.counts.rows(), out.counts.cols());
  out.x.resize(out.counts.rows());
  out.y.resize(out.counts.rows());
  for (Eigen::Index i = 0; i < out.counts.rows(); ++i) {
    const Place& place = places[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];
    out.x(i) = 2.0 * place.x / width_of(stack.frames.front()) - 1.0;
    out.y(i) = 2.0 * place.y / height_of(stack.frames.front()) - 1.0;
  }
  for (Eigen::Index k = 0; k < out.counts.cols(); ++k) {
    std::visit(
        [&](const auto& image) {
          const auto at = [&](int x, int y) {
            return static_cast<double>(
                image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)));
          };
          for (std::size_t i = 0; i < kept.size(); ++i) {
            const Place& place = places[static_cast<std::size_t>(kept[i])];
            const auto row = static_cast<Eigen::Index>(i);
            double along_x = 0.0;
            double along_y = 0.0;
            for (const int d : {-1, 0, 1}) {
              along_x += at(place.x + 1, place.y + d) - at(place.x - 1, place.y + d);
              along_y += at(place.x + d, place.y + 1) - at(place.x + d, place.y - 1);
            }
            out.slope_x(row, k) = along_x / 6.0;
            out.slope_y(row, k) = along_y / 6.0;
          }
        },
        stack.frames[static_cast<std::size_t>(k)]);
  }
}

/// Finds the pattern whose number of fringes is the smallest integer multiple or part of that of
/// this one; null without any.
const FrameStack* nearest_multiple(std::span<const FrameStack* const> references,
                                   const Pattern& pattern,
                                   FrameSample& out) {
  constexpr double kInteger = 0.01;
  const FrameStack* nearest = nullptr;
  double least = 0.0;
  for (const FrameStack* stack : references) {
    const double ratio = pattern.fringes_per_unit() / stack->pattern.fringes_per_unit();
    const double larger = std::max(ratio, 1.0 / ratio);
    if (!(std::abs(larger - std::round(larger)) < kInteger)) continue;
    if (nearest != nullptr && larger >= least) continue;
    nearest = stack;
    least = larger;
    out.periods = ratio < 1.0 ? std::round(larger) : 1.0;
    out.reference_periods = ratio < 1.0 ? 1.0 : std::round(larger);
  }
  return nearest;
}

/// Adds mean and modulation of the kept pixels by other patterns, and the phase of one of them.
void add_references(std::span<const FrameStack* const> references,
                    const Pattern& pattern,
                    const std::vector<Place>& places,
                    const std::vector<Eigen::Index>& kept,
                    FrameSample& out) {
  if (references.empty()) return;
  const FrameStack* of_phase = nearest_multiple(references, pattern, out);
  out.reference_mean = Eigen::ArrayXd::Zero(std::ssize(kept));
  out.reference_modulation = Eigen::ArrayXd::Zero(std::ssize(kept));
  if (of_phase != nullptr) out.reference_phase_rad.resize(std::ssize(kept));
  for (const FrameStack* stack : references) {
    const PhaseAlgorithm fit = least_squares(stack->pattern.shifts_rad);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Place& place = places[static_cast<std::size_t>(kept[i])];
      double mean = 0.0;
      double cosine = 0.0;
      double sine = 0.0;
      bool saturated = false;
      for (std::size_t k = 0; k < stack->frames.size(); ++k) {
        const double counts = counts_at(stack->frames[k], place.x, place.y);
        saturated = saturated || counts >= stack->white_level;
        mean += fit.mean[k] * counts;
        cosine += fit.cosine[k] * counts;
        sine += fit.sine[k] * counts;
      }
      const double modulation = std::hypot(cosine, sine);
      const bool measured = !saturated && mean > kMinCounts && modulation > kMinCounts;
      const double share = measured ? 1.0 / static_cast<double>(references.size()) : kMissing;
      const auto row = static_cast<Eigen::Index>(i);
      out.reference_mean(row) += share * mean;
      out.reference_modulation(row) += share * modulation;
      if (stack == of_phase) out.reference_phase_rad(row) = std::atan2(sine, cosine);
    }
  }
}

FrameSample sample_at(const FrameStack& stack,
                      const NoiseModel& noise,
                      std::span<const FrameStack* const> references,
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
    for (Eigen::Index k = 0; k < frames; ++k) {
      if (white[static_cast<std::size_t>(k)]) continue;
      scale = std::max(scale, counts(i, k));
    }
    if (scale >= stack.white_level || scale < kMinCounts) continue;
    usable.push_back(i);
    scales.push_back(scale);
    changes.push_back(change_of(counts.row(i)));
  }
  FrameSample out;
  if (usable.empty()) return out;
  const std::vector<bool> background = changed_by_one_cause(counts, usable, noise);
  std::vector<double> ordered;
  for (std::size_t i = 0; i < usable.size(); ++i)
    if (!background[i]) ordered.push_back(changes[i]);
  if (ordered.empty()) return out;
  const auto high = ordered.begin() + std::ssize(ordered) * 9 / 10;
  std::nth_element(ordered.begin(), high, ordered.end());
  const double least = kLit * *high;
  std::vector<Eigen::Index> kept;
  std::vector<double> kept_scales;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (background[i] || changes[i] < least) continue;
    kept.push_back(usable[i]);
    kept_scales.push_back(scales[i]);
    out.blocks.push_back(places[static_cast<std::size_t>(usable[i])].block);
  }
  out.counts = counts(kept, Eigen::all);
  add_places(stack, places, kept, out);
  add_references(references, stack.pattern, places, kept, out);
  out.scale_counts = Eigen::Map<const Eigen::ArrayXd>(kept_scales.data(), std::ssize(kept_scales));
  out.variance = out.counts.rowwise().mean().unaryExpr(
      [&](double mean) { return noise.variance(mean) + 1e-3; });
  return out;
}

}  // namespace

FrameSample every_nth_block(const FrameSample& sample, int n) {
  std::vector<Eigen::Index> kept;
  FrameSample out;
  // By the order in which blocks occur: by their number, whole columns of blocks would be left out.
  int rank = 0;
  for (std::size_t i = 0; i < sample.blocks.size(); ++i) {
    if (i > 0 && sample.blocks[i] != sample.blocks[i - 1]) ++rank;
    if (rank % n != 0) continue;
    kept.push_back(static_cast<Eigen::Index>(i));
    out.blocks.push_back(sample.blocks[i]);
  }
  out.counts = sample.counts(kept, Eigen::all);
  out.slope_x = sample.slope_x(kept, Eigen::all);
  out.slope_y = sample.slope_y(kept, Eigen::all);
  out.x = sample.x(kept);
  out.y = sample.y(kept);
  out.scale_counts = sample.scale_counts(kept);
  out.variance = sample.variance(kept);
  if (!sample.has_reference()) return out;
  out.reference_mean = sample.reference_mean(kept);
  out.reference_modulation = sample.reference_modulation(kept);
  out.periods = sample.periods;
  out.reference_periods = sample.reference_periods;
  if (sample.reference_phase_rad.size() > 0)
    out.reference_phase_rad = sample.reference_phase_rad(kept);
  return out;
}

FrameSample sample_blocks(const FrameStack& stack,
                          const NoiseModel& noise,
                          std::span<const FrameStack* const> references) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  FrameSample out;
  for (int blocks = kFewestBlocks; blocks <= kMostBlocks; blocks *= 2) {
    out = sample_at(stack, noise, references, places_in(width, height, blocks));
    if (out.counts.rows() >= kEnough) break;
  }
  const Eigen::Index freedom = std::max<Eigen::Index>(1, std::ssize(stack.frames) - 3);
  const Eigen::Index every = out.counts.rows() / std::min(kEnough, kEnoughResiduals / freedom);
  return every > 1 ? every_nth_block(out, static_cast<int>(every)) : out;
}

}  // namespace frangia
