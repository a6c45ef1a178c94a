#include "frangia/phase/waveform/contradicting_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/waveform/internal/residual_model.h"

namespace frangia {
namespace {

constexpr int kReach_px = 3;           ///< of a window to either side
constexpr double kLeastLight = 10.0;   ///< modulation over its noise; 0.1 rad, as `WrapOptions`
constexpr double kNoiseModel = 1.25;   ///< variance over that of the noise model that may be noise
constexpr double kChanceSigmas = 5.0;  ///< of the mean of squares over a window
constexpr std::size_t kWithoutResidual = 3;
constexpr int kSurroundings_px = 10;  ///< reach of the pixels that say whether one is covered
/// Share of the lit pixels around one that contradict each other where it is within a region of
/// them. Beyond a straight border it is half of them at most.
constexpr float kWithin = 0.6F;
/// Limit of the uncertainty over that of a measured pixel from which on something else must have
/// been seen: few levels and compression, where the light is low, leave less.
constexpr float kSomethingElse = 2.0F;

/// What is summed over a window.
struct WindowSum {
  float rest = 0.0F;    ///< squared residuals, counts squared
  float noise = 0.0F;   ///< their expectation
  float square = 0.0F;  ///< squared modulations, counts squared
  float pixels = 0.0F;  ///< with fringes

  void add(const WindowSum& other) {
    rest += other.rest;
    noise += other.noise;
    square += other.square;
    pixels += other.pixels;
  }
};

double counts_of(const Frame& frame, int x, int y) {
  return std::visit([&](const auto& image) { return static_cast<double>(image(x, y)); }, frame);
}

/// Residual and light of a pixel; nothing without fringes.
WindowSum sum_of_pixel(const FrameStack& stack,
                       const ResidualModel& model,
                       const NoiseModel& noise,
                       int x,
                       int y,
                       std::vector<double>& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    counts[k] = counts_of(stack.frames[k], x, y);
    if (counts[k] >= stack.white_level) return {};
  }
  const auto frames = static_cast<double>(counts.size());
  const PixelFringe fringe = model.fringe_of(counts);
  const double variance = noise.variance(std::max(0.0, fringe.mean));
  const double square = fringe.wave.squaredNorm();
  if (square < kLeastLight * kLeastLight * variance * 2.0 / frames) return {};
  const double rest = model.explains_something() ? model.unexplained_residual(counts)
                                                 : model.squared_residual(counts);
  return {.rest = static_cast<float>(rest),
          .noise = static_cast<float>((frames - 3.0) * variance),
          .square = static_cast<float>(square),
          .pixels = 1.0F};
}

/// The uncertainty of the phase by the mean residual of a window.
float unexplained_of(const WindowSum& window, double frames) {
  if (window.pixels == 0.0F || window.square <= 0.0F) return 0.0F;
  const double freedom = window.pixels * (frames - 3.0);
  const double chance = kNoiseModel + kChanceSigmas * std::sqrt(2.0 / freedom);
  if (window.rest <= chance * window.noise) return 0.0F;
  // Errors of variance s^2 in N frames shift the phase by sqrt(2 / N) s / B.
  const double variance = (window.rest - window.noise) / freedom;
  return static_cast<float>(std::sqrt(2.0 / frames * variance * window.pixels / window.square));
}

/// A pixel, or the sum of some.
struct Surroundings {
  float lit = 0.0F;
  float unexplained = 0.0F;  ///< number of pixels that noise does not explain
  float square = 0.0F;       ///< squared uncertainty of these, rad squared

  void add(const Surroundings& one, float sign) {
    lit += sign * one.lit;
    unexplained += sign * one.unexplained;
    square += sign * one.square;
  }
};

/// Sums of windows of `kSurroundings_px` to either side along a line of any length.
void sum_windows(std::vector<Surroundings>& line, std::vector<Surroundings>& sums) {
  const int size = static_cast<int>(line.size());
  Surroundings sum;
  for (int at = 0; at < std::min(size, kSurroundings_px); ++at)
    sum.add(line[static_cast<std::size_t>(at)], 1.0F);
  for (int at = 0; at < size; ++at) {
    if (at + kSurroundings_px < size)
      sum.add(line[static_cast<std::size_t>(at + kSurroundings_px)], 1.0F);
    if (at > kSurroundings_px)
      sum.add(line[static_cast<std::size_t>(at - kSurroundings_px - 1)], -1.0F);
    sums[static_cast<std::size_t>(at)] = sum;
  }
}

/// Counts pixels within a region that contradicts itself as its other pixels. `lit` says which
/// pixels have fringes.
void count_within(const Image<char>& lit, Image<float>& unexplained_rad) {
  const int width = lit.width();
  const int height = lit.height();
  Image<Surroundings> along(width, height, Uninitialized{});
  parallel_rows(height, [&](int y) {
    std::vector<Surroundings> row(static_cast<std::size_t>(width));
    std::vector<Surroundings> sums(row.size());
    for (int x = 0; x < width; ++x) {
      const float found = unexplained_rad(x, y);
      row[static_cast<std::size_t>(x)] = {
          lit(x, y) != 0 ? 1.0F : 0.0F, found > 0.0F ? 1.0F : 0.0F, found * found};
    }
    sum_windows(row, sums);
    for (int x = 0; x < width; ++x)
      along(x, y) = sums[static_cast<std::size_t>(x)];
  });
  parallel_rows(width, [&](int x) {
    std::vector<Surroundings> column(static_cast<std::size_t>(height));
    std::vector<Surroundings> sums(column.size());
    for (int y = 0; y < height; ++y)
      column[static_cast<std::size_t>(y)] = along(x, y);
    sum_windows(column, sums);
    for (int y = 0; y < height; ++y) {
      const Surroundings& sum = sums[static_cast<std::size_t>(y)];
      if (lit(x, y) == 0 || sum.unexplained < kWithin * sum.lit) continue;
      const float around = std::sqrt(std::max(0.0F, sum.square) / std::max(1.0F, sum.unexplained));
      unexplained_rad(x, y) = std::max(unexplained_rad(x, y), around);
    }
  });
}

}  // namespace

Image<float> unexplained_phase(const FrameStack& stack,
                               const FittedAlgorithm& fitted,
                               const NoiseModel& noise) {
  if (fitted.shifts_rad.size() <= kWithoutResidual) return {};
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const ResidualModel model(fitted);
  Image<WindowSum> along(width, height, Uninitialized{});
  Image<char> lit(width, height, Uninitialized{});
  parallel_rows(height, [&](int y) {
    std::vector<double> counts(fitted.shifts_rad.size());
    std::vector<WindowSum> row(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
      row[static_cast<std::size_t>(x)] = sum_of_pixel(stack, model, noise, x, y, counts);
    for (int x = 0; x < width; ++x)
      lit(x, y) = row[static_cast<std::size_t>(x)].pixels > 0.0F ? 1 : 0;
    for (int x = 0; x < width; ++x) {
      WindowSum sum;
      for (int at = std::max(0, x - kReach_px); at <= std::min(width - 1, x + kReach_px); ++at)
        sum.add(row[static_cast<std::size_t>(at)]);
      along(x, y) = sum;
    }
  });
  Image<float> out(width, height, Uninitialized{});
  const auto frames = static_cast<double>(fitted.shifts_rad.size());
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      WindowSum sum;
      for (int at = std::max(0, y - kReach_px); at <= std::min(height - 1, y + kReach_px); ++at)
        sum.add(along(x, at));
      out(x, y) = unexplained_of(sum, frames);
    }
  });
  count_within(lit, out);
  return out;
}

double count_unexplained(const Image<float>& unexplained_rad,
                         const UnexplainedUse& use,
                         const PhaseImages& images) {
  if (unexplained_rad.empty()) return 0.0;
  const std::span<const float> local = unexplained_rad.pixels();
  const std::span<float> phase = images.phase_rad.pixels();
  if (images.systematic_rad.empty()) {
    images.systematic_rad = Image<float>(images.phase_rad.width(), images.phase_rad.height(), 0.0F);
    for (std::size_t i = 0; i < phase.size(); ++i)
      if (std::isnan(phase[i])) images.systematic_rad.pixels()[i] = kMissing;
  }
  const std::span<float> systematic = images.systematic_rad.pixels();
  std::size_t measured = 0;
  std::size_t contradicting = 0;
  for (std::size_t i = 0; i < phase.size(); ++i) {
    if (std::isnan(phase[i])) continue;
    ++measured;
    if (local[i] <= use.counted_rad) continue;
    if (local[i] > use.max_sigma_rad) {
      const bool contradicts = local[i] > kSomethingElse * use.max_sigma_rad;
      if (contradicts) ++contradicting;
      phase[i] = kMissing;
      images.sigma_rad.pixels()[i] = kMissing;
      systematic[i] = kMissing;
      images.status.pixels()[i] =
          contradicts ? PixelStatus::Contradicting : PixelStatus::Unmodulated;
      continue;
    }
    const double more = std::pow(local[i], 2) - use.counted_rad * use.counted_rad;
    systematic[i] =
        static_cast<float>(std::sqrt(std::pow(systematic[i], 2) + use.weight * use.weight * more));
  }
  return static_cast<double>(contradicting) /
         static_cast<double>(std::max<std::size_t>(1, measured));
}

std::string place_of_unexplained(const Image<float>& unexplained_rad, float max_sigma_rad) {
  std::vector<int> columns;
  std::vector<int> rows;
  for (int y = 0; y < unexplained_rad.height(); ++y) {
    for (int x = 0; x < unexplained_rad.width(); ++x) {
      if (!(unexplained_rad(x, y) > kSomethingElse * max_sigma_rad)) continue;
      columns.push_back(x);
      rows.push_back(y);
    }
  }
  if (columns.empty()) return {};
  const auto most_of = [](std::vector<int>& places) {
    std::sort(places.begin(), places.end());
    const std::size_t few = places.size() / 20;
    return std::pair(places[few], places[places.size() - 1 - few]);
  };
  const auto [left, right] = most_of(columns);
  const auto [top, bottom] = most_of(rows);
  return fmt::format("columns {} to {} and rows {} to {}", left, right, top, bottom);
}

std::string describe_contradicting(const std::string& pattern,
                                   double share,
                                   const std::string& place) {
  constexpr double kMaterial = 0.02;  // edges of sound frames are fewer
  if (share < kMaterial) return {};
  return fmt::format(
      "pattern \"{}\": at {:.0f} % of the measured pixels, most of them in {}, the frames "
      "contradict "
      "each other, and these pixels are left out: check that nothing covered the part or shook "
      "while "
      "they were captured",
      pattern,
      100.0 * share,
      place);
}

}  // namespace frangia
