#include "frangia/decode/explain/internal/frame_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

constexpr int kGrid = 80;              ///< pixels along the longer side of the image
constexpr double kLeastChange = 0.25;  ///< least change of a pixel over the large changes

double median_of(const Eigen::ArrayXd& values) {
  return median(std::vector<double>(values.begin(), values.end()));
}

}  // namespace

std::vector<Shown> sequence_of(std::span<const FrameStack> stacks) {
  std::vector<Shown> out;
  for (const FrameStack& stack : stacks)
    for (const Frame& frame : stack.frames)
      out.push_back({&frame, &stack});
  return out;
}

bool are_alike(const std::vector<Shown>& sequence) {
  return std::all_of(sequence.begin(), sequence.end(), [&](const Shown& one) {
    return width_of(*one.frame) == width_of(*sequence.front().frame) &&
           height_of(*one.frame) == height_of(*sequence.front().frame);
  });
}

bool has_fringes(const FrameStack& stack) {
  return stack.pattern.kind == PatternKind::Fringe &&
         stack.frames.size() == stack.pattern.shifts_rad.size() &&
         stack.frames.size() >= kFewestFrames;
}

LitCounts lit_counts(const std::vector<Shown>& sequence) {
  const int width = width_of(*sequence.front().frame);
  const int height = height_of(*sequence.front().frame);
  const double step = std::max(1.0, static_cast<double>(std::max(width, height)) / kGrid);
  std::vector<Eigen::ArrayXd> pixels;
  std::vector<double> changes;
  std::vector<double> rows_px;
  for (int row = 0; (row + 1) * step <= height; ++row) {
    for (int column = 0; (column + 1) * step <= width; ++column) {
      // At equal distances all pixels might see the same phase.
      const std::uint64_t place =
          hash(hash(static_cast<std::uint64_t>(row)), static_cast<std::uint64_t>(column));
      const int x = static_cast<int>((column + uniform_from(place)) * step);
      const int y = static_cast<int>((row + uniform_from(hash(place))) * step);
      Eigen::ArrayXd pixel(std::ssize(sequence));
      double least = INFINITY;
      double most = 0.0;
      bool saturated = false;
      for (std::size_t j = 0; j < sequence.size(); ++j) {
        const double counts = counts_at(*sequence[j].frame, x, y);
        pixel(static_cast<Eigen::Index>(j)) = counts;
        if (!has_fringes(*sequence[j].stack)) continue;
        saturated = saturated || counts >= sequence[j].stack->white_level;
        least = std::min(least, counts);
        most = std::max(most, counts);
      }
      if (saturated) continue;
      pixels.push_back(std::move(pixel));
      changes.push_back(most - least);
      rows_px.push_back(y);
    }
  }
  if (pixels.empty()) return {};
  std::vector<double> ordered = changes;
  const auto high = ordered.begin() + std::ssize(ordered) * 9 / 10;
  std::nth_element(ordered.begin(), high, ordered.end());
  LitCounts out{Eigen::ArrayXXd(std::ssize(pixels), std::ssize(sequence)),
                Eigen::ArrayXd(std::ssize(pixels))};
  Eigen::Index kept = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (changes[i] <= std::max(kLeastChange * *high, 1.0)) continue;
    out.counts.row(kept) = pixels[i];
    out.rows_px(kept++) = rows_px[i];
  }
  out.counts.conservativeResize(kept, Eigen::NoChange);
  out.rows_px.conservativeResize(kept);
  return out;
}

Fitted fit(const Eigen::ArrayXXd& counts, const Placed& pattern) {
  const auto& [places, shifts_rad] = pattern;
  const PhaseAlgorithm weights = least_squares(shifts_rad);
  const auto sum = [&](const std::vector<double>& of) {
    Eigen::ArrayXd out = Eigen::ArrayXd::Zero(counts.rows());
    for (std::size_t k = 0; k < places.size(); ++k)
      out += of[k] * counts.col(places[k]);
    return out;
  };
  const Eigen::ArrayXd mean = sum(weights.mean);
  const Eigen::ArrayXd cosine = sum(weights.cosine);
  const Eigen::ArrayXd sine = sum(weights.sine);
  Fitted out{mean, (cosine.square() + sine.square()).sqrt(), {}};
  if (places.size() == kFewestFrames) return out;
  out.rest = Eigen::ArrayXd::Zero(counts.rows());
  for (std::size_t k = 0; k < places.size(); ++k)
    out.rest += (counts.col(places[k]) - mean - std::cos(shifts_rad[k]) * cosine +
                 std::sin(shifts_rad[k]) * sine)
                    .square();
  out.rest /= static_cast<double>(places.size() - kFewestFrames);
  return out;
}

std::optional<double> misfit_of(const std::vector<Fitted>& fits) {
  if (fits.size() < 2) return std::nullopt;
  constexpr double kLeast_counts2 = 1.0;  // of the modulation: less is none
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(fits.front().mean.size());
  int terms = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fitted& one = fits[i];
    if (one.rest.size() > 0) {
      sum += one.rest / one.modulation.square().max(kLeast_counts2);
      ++terms;
    }
    if (i == 0) continue;
    const Fitted& last = fits[i - 1];  // fine fringes have less contrast, by one factor
    const double factor =
        median_of(one.modulation / last.modulation.max(std::sqrt(kLeast_counts2)));
    const Eigen::ArrayXd other = factor * last.modulation;
    sum += ((one.mean - last.mean).square() + 0.5 * (one.modulation - other).square()) /
           (0.5 * (one.modulation.square() + other.square())).max(kLeast_counts2);
    ++terms;
  }
  return median_of(sum / terms);
}

std::vector<Placed> placed_at(std::span<const FrameStack> stacks,
                              std::ptrdiff_t frames,
                              std::ptrdiff_t lag) {
  std::vector<Placed> out;
  std::ptrdiff_t begin = lag;
  for (const FrameStack& stack : stacks) {
    Placed one;
    for (std::size_t k = 0; has_fringes(stack) && k < stack.frames.size(); ++k) {
      const std::ptrdiff_t place = begin + static_cast<std::ptrdiff_t>(k);
      if (place < 0 || place >= frames) continue;
      one.places.push_back(place);
      one.shifts_rad.push_back(stack.pattern.shifts_rad[k]);
    }
    if (one.places.size() >= kFewestFrames) out.push_back(std::move(one));
    begin += std::ssize(stack.frames);
  }
  return out;
}

std::vector<Fitted> fit_all(const Eigen::ArrayXXd& counts, const std::vector<Placed>& patterns) {
  std::vector<Fitted> out;
  for (const Placed& one : patterns)
    out.push_back(fit(counts, one));
  return out;
}

}  // namespace frangia
