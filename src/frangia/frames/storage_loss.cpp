#include "frangia/frames/storage_loss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/core/statistics.h"
#include "frangia/frames/jpeg_noise.h"

namespace frangia {
namespace {

constexpr int kBlock_px = 8;
using Block = Eigen::Matrix<float, kBlock_px, kBlock_px>;

/// The orthonormal cosine transform of a block.
Block transformed(const Block& block) {
  static const Block kCosines = [] {
    Block out;
    for (int u = 0; u < kBlock_px; ++u) {
      for (int x = 0; x < kBlock_px; ++x) {
        out(u, x) = static_cast<float>((u == 0 ? std::sqrt(0.125) : 0.5) *
                                       std::cos((2 * x + 1) * u * std::numbers::pi / 16.0));
      }
    }
    return out;
  }();
  return kCosines * block * kCosines.transpose();
}

Block block_at(const Frame& frame, int left, int top) {
  return std::visit(
      [&](const auto& image) {
        Block out;
        for (int y = 0; y < kBlock_px; ++y) {
          for (int x = 0; x < kBlock_px; ++x)
            out(y, x) = static_cast<float>(image(left + x, top + y));
        }
        return out;
      },
      frame);
}

struct Place {
  int x = 0;
  int y = 0;
};

/// A block of the grid that begins at (0, 0); it leaves room for a grid that is shifted by less
/// than a block.
struct LitBlock {
  const Frame* frame = nullptr;
  Place at;

  [[nodiscard]] Block waves(const Place& grid) const {
    return transformed(block_at(*frame, at.x + grid.x, at.y + grid.y));
  }
};

/// Blocks of the lit part of a frame, of some thousands that are spread over it.
std::vector<LitBlock> lit_blocks(const Frame& frame) {
  constexpr double kBlocks = 4000.0;
  constexpr double kBright = 0.99;
  constexpr float kLit = 0.3F;  // of the bright ones
  std::vector<LitBlock> out;
  std::vector<float> light;
  const auto light_at = [&](const Place& at) {
    return static_cast<float>(counts_at(frame, at.x + kBlock_px / 2, at.y + kBlock_px / 2));
  };
  const double all =
      static_cast<double>(width_of(frame)) * height_of(frame) / std::pow(kBlock_px, 2);
  const int step_px = kBlock_px * std::max(1, static_cast<int>(std::sqrt(all / kBlocks)));
  for (int y = 0; y + 2 * kBlock_px <= height_of(frame); y += step_px) {
    for (int x = 0; x + 2 * kBlock_px <= width_of(frame); x += step_px) {
      out.push_back({&frame, {x, y}});
      light.push_back(light_at({x, y}));
    }
  }
  if (light.empty()) return out;
  const auto bright =
      light.begin() + static_cast<std::ptrdiff_t>(kBright * static_cast<double>(light.size() - 1));
  std::nth_element(light.begin(), bright, light.end());
  std::erase_if(out, [&](const LitBlock& one) { return light_at(one.at) < kLit * *bright; });
  return out;
}

/// `most` of the blocks, spread evenly over all of them; all where there are fewer.
std::vector<LitBlock> some_of(const std::vector<LitBlock>& blocks, std::size_t most) {
  if (blocks.size() <= most) return blocks;
  std::vector<LitBlock> out;
  for (std::size_t i = 0; i < most; ++i)
    out.push_back(blocks[i * blocks.size() / most]);
  return out;
}

/// Where the grid of a compression may begin; nothing where no grid stands out. Along straight
/// fringes several do.
std::vector<Place> find_grids(const std::vector<LitBlock>& blocks) {
  constexpr std::size_t kFewest = 24;
  constexpr int kHigh = 9;             // sum of both frequencies
  constexpr double kStandsOut = 0.85;  // of the energy of the median grid
  constexpr std::size_t kMost = 8;     // grids
  if (blocks.size() < kFewest) return {};
  std::vector<std::pair<double, Place>> grids;
  for (int y = 0; y < kBlock_px; ++y) {
    for (int x = 0; x < kBlock_px; ++x) {
      std::vector<double> energies;
      for (const LitBlock& block : blocks) {
        const Block waves = block.waves({x, y});
        double energy = 0.0;
        for (int v = 0; v < kBlock_px; ++v) {
          for (int u = std::max(0, kHigh - v); u < kBlock_px; ++u)
            energy += static_cast<double>(waves(v, u) * waves(v, u));
        }
        energies.push_back(energy);
      }
      grids.emplace_back(median(std::move(energies)), Place{x, y});
    }
  }
  std::sort(
      grids.begin(), grids.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Place> out;
  for (std::size_t i = 0; i < kMost; ++i)
    if (grids[i].first < kStandsOut * grids[grids.size() / 2].first) out.push_back(grids[i].second);
  return out;
}

/// The step of which these values are multiples but for the rounding of the pixels, in whole
/// counts; 0 where they are of none.
int step_of(const std::vector<float>& values) {
  constexpr int kSmallest = 3;  // of less, all values are nearly multiples
  constexpr int kLargest = 120;
  constexpr double kZero = 1.3;        // counts; what is less is no multiple but zero
  constexpr double kRounding = 0.6;    // counts: twice the standard deviation of what rounding adds
  constexpr std::size_t kFewest = 25;  // values that are not zero
  constexpr double kMost = 0.7;  // of these, that are multiples; by chance it is 1.2 over the step
  std::vector<double> sizes;
  for (const float value : values) {
    const double size = std::abs(static_cast<double>(value));
    if (size >= kZero) sizes.push_back(size);
  }
  if (sizes.size() < kFewest) return 0;
  const auto fewest = static_cast<std::size_t>(kMost * static_cast<double>(sizes.size())) + 1;
  const std::size_t most_others = sizes.size() - fewest;
  // More values than that lie below every larger step, and are no multiples of it.
  const auto low = sizes.begin() + static_cast<std::ptrdiff_t>(most_others);
  std::nth_element(sizes.begin(), low, sizes.end());
  const int largest = std::min(kLargest, static_cast<int>(*low + kRounding));
  for (int step = largest; step >= kSmallest; --step) {
    std::size_t others = 0;
    for (std::size_t i = 0; i < sizes.size() && others <= most_others; ++i) {
      const double number = std::round(sizes[i] / step);
      if (number == 0.0 || std::abs(sizes[i] - number * step) >= kRounding) ++others;
    }
    if (others <= most_others) return step;
  }
  return 0;
}

/// The quantization steps of each frequency over those of quality 50, for a grid; of those whose
/// values are multiples of one.
std::vector<double> scales_of(const std::vector<LitBlock>& blocks,
                              const Place& grid,
                              double level_counts) {
  std::array<std::vector<float>, std::size_t{kBlock_px} * kBlock_px> values;
  for (const LitBlock& block : blocks) {
    const Block waves = block.waves(grid);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto [v, u] = std::div(static_cast<int>(i), kBlock_px);
      values[i].push_back(waves(v, u) / static_cast<float>(level_counts));
    }
  }
  std::vector<double> out;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const int step = step_of(values[i]);
    if (step > 0) out.push_back(static_cast<double>(step) / jpeg_base_steps()[i]);
  }
  return out;
}

/// The quantization steps of a compression over those of quality 50; 0 where they are not found.
double quality_scale(std::span<const FrameStack> stacks, double level_counts) {
  constexpr std::size_t kFrames = 12;
  constexpr std::size_t kForGrid = 128;   // blocks
  constexpr std::size_t kForSteps = 800;  // blocks
  constexpr std::size_t kFewest = 6;      // frequencies
  constexpr double kAlike = 1.6;          // a step over that of the standard table, over the median
  constexpr double kMost = 0.7;           // of the frequencies
  std::vector<LitBlock> blocks;
  std::size_t frames = 0;
  for (const FrameStack& stack : stacks) {
    for (std::size_t k = 0; k < stack.frames.size() && frames < kFrames; ++k, ++frames) {
      const std::vector<LitBlock> of_frame = lit_blocks(stack.frames[k]);
      blocks.insert(blocks.end(), of_frame.begin(), of_frame.end());
    }
  }
  const std::vector<LitBlock> measured = some_of(blocks, kForSteps);
  std::vector<double> best;
  for (const Place& grid : find_grids(some_of(blocks, kForGrid))) {
    std::vector<double> scales = scales_of(measured, grid, level_counts);
    if (scales.size() > best.size()) best = std::move(scales);
  }
  if (best.size() < kFewest) return 0.0;
  const double scale = median(best);
  const auto alike = std::count_if(best.begin(), best.end(), [&](double one) {
    return one < kAlike * scale && scale < kAlike * one;
  });
  return static_cast<double>(alike) < kMost * static_cast<double>(best.size()) ? 0.0 : scale;
}

/// Counts from one level to the next, 1 where all occur: the median over the samples of the frames.
double level_step(std::span<const Frame> frames, int white_level) {
  constexpr std::size_t kSamples = 100'000;  // of each frame
  constexpr std::size_t kFewest = 4;         // levels that have a distance
  constexpr std::size_t kOften = 20;  // samples at a count that show that its neighbours are none
  std::vector<std::size_t> histogram(static_cast<std::size_t>(white_level) + 1, 0);
  for (const Frame& frame : frames) {
    std::visit(
        [&](const auto& image) {
          const std::size_t stride = std::max<std::size_t>(1, image.pixels().size() / kSamples);
          for (std::size_t i = 0; i < image.pixels().size(); i += stride) {
            if (image.pixels()[i] > 0 && image.pixels()[i] < white_level)
              ++histogram[image.pixels()[i]];
          }
        },
        frame);
  }
  struct Level {
    std::size_t gap = 0;  ///< to the level below
    std::size_t samples = 0;
  };
  std::vector<Level> levels;
  std::size_t all = 0;
  std::size_t seen_often = 0;
  std::size_t before = 0;
  for (std::size_t counts = 1; counts < histogram.size(); ++counts) {
    if (histogram[counts] == 0) continue;
    if (before > 0) {
      levels.push_back({counts - before, histogram[counts]});
      all += histogram[counts];
      if (histogram[counts] >= kOften) seen_often += histogram[counts];
    }
    before = counts;
  }
  if (levels.size() < kFewest || 2 * seen_often < all) return 1.0;
  std::sort(
      levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.gap < b.gap; });
  std::size_t below = 0;
  for (const Level& level : levels) {
    below += level.samples;
    if (2 * below >= all) return static_cast<double>(level.gap);
  }
  return 1.0;
}

}  // namespace

StorageLoss find_storage_loss(std::span<const FrameStack> stacks) {
  constexpr double kFewLevels = 128.0;  // up to the white level; more add little noise
  StorageLoss out;
  if (stacks.empty()) return out;
  const auto fringes = std::find_if(stacks.rbegin(), stacks.rend(), [](const FrameStack& stack) {
    return stack.pattern.kind == PatternKind::Fringe;
  });
  const FrameStack* stack = fringes != stacks.rend() ? &*fringes : &stacks.back();
  if (stack->frames.empty()) return out;
  const double step = level_step(stack->frames, stack->white_level);
  if (step * kFewLevels > stack->white_level && step > 1.0) {
    out.level_counts = step;
    out.variance_counts2 = (step * step - 1.0) / 12.0;
  }
  out.quality_scale = quality_scale(stacks, step);
  if (out.quality_scale > 0.0)
    out.variance_counts2 += step * step * jpeg_noise_of_scale(out.quality_scale);
  return out;
}

std::string describe(const StorageLoss& loss) {
  if (loss.quality_scale > 0.0) {
    return fmt::format(
        "the frames were compressed with loss before they were stored, as JPEG or MJPEG of quality "
        "{:.0f} does it; the noise of {:.1f} counts that this adds is counted in sigma; store them "
        "as the camera takes them",
        jpeg_quality_of_scale(loss.quality_scale),
        std::sqrt(loss.variance_counts2));
  }
  if (loss.level_counts > 0.0) {
    return fmt::format(
        "the frames hold few levels, {:.3g} counts apart; the noise of {:.1f} counts that this "
        "adds "
        "is counted in sigma; store them with all bits of the camera",
        loss.level_counts,
        std::sqrt(loss.variance_counts2));
  }
  return {};
}

}  // namespace frangia
