#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/gray/decode_gray_alone.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// The difference of bright and dark of one bit at one pixel.
struct Margin {
  double counts = 0.0;  ///< at the first exposure; positive where the bit is set
  double sigma = 1.0;
};

/// The border of two neighbouring stripes on a line of pixels.
struct StripeBorder {
  std::size_t at_pixel = 0;  ///< the last pixel before it
  double at = 0.0;           ///< pixels along the line
  double column = 0.0;       ///< of the projector
  double noise_px = 0.0;     ///< standard deviation of `at` by the camera's noise
  /// Step of the light between the two pixels over that between the stripes.
  double sharpness = 0.0;
  double width_px = 0.0;  ///< standard deviation of `at` by the unknown place between two pixels
};

/// A border of which the pixel on either side is fully bright or dark.
inline constexpr double kSharp = 0.9;

/// Least standard deviation of a border's place by the shape of the pixels, whose light is not
/// quite that of their width; tests/phase/decode_gray_alone_test.cpp measures it.
inline constexpr double kPlace_px = 0.025;

/// A column of the projector and its uncertainty, in projector pixels.
struct Located {
  double column = 0.0;
  double noise = 0.0;
  double shared = 0.0;     ///< error that neighbouring pixels share
  double curvature = 0.0;  ///< what a steady curvature and an edge between faces leave open
};

/// Decodes one line of pixels across the stripes.
class GrayLineDecoder {
 public:
  GrayLineDecoder(std::span<const FrameStack> gray,
                  const Image<float>& threshold_counts,
                  const NoiseModel& noise,
                  const GrayAloneOptions& options)
      : gray_(gray),
        threshold_(threshold_counts),
        noise_(noise),
        options_(options),
        shown_(gray.front().pattern),
        code_(shown_),
        bits_(static_cast<std::size_t>(code_.bits)),
        rows_(code_.direction == FringeDirection::Vertical) {}

  /// Leaves out the last bits: the first ones of a Gray or binary code are that of stripes twice,
  /// four times, ... as wide.
  void use_bits(int bits) {
    code_.stripe_px = std::ldexp(shown_.stripe_px, shown_.bits - bits);
    code_.bits = bits;
    bits_ = static_cast<std::size_t>(bits);
  }

  /// The contrast of each bit at the pixels of a line, as shares of the largest one of the pixel.
  /// Unlit pixels are left out.
  void add_contrasts(int line, int count, std::vector<std::vector<float>>& contrasts) {
    read(line, count);
    for (std::size_t i = 0; i < status_.size(); ++i) {
      if (status_[i] == PixelStatus::Unmodulated) continue;
      double largest = 0.0;
      for (std::size_t bit = 0; bit < bits_; ++bit)
        largest = std::max(largest, std::abs(margins_[i * bits_ + bit].counts));
      for (std::size_t bit = 0; bit < bits_; ++bit)
        contrasts[bit].push_back(
            static_cast<float>(std::abs(margins_[i * bits_ + bit].counts) / largest));
    }
  }

  /// Counts the neighbouring pixels of a line whose stripes differ by one and by two. More is the
  /// edge of a part.
  void add_steps(int line, int count, std::array<std::size_t, 2>& steps) {
    read(line, count);
    for (std::size_t i = 0; i + 1 < stripes_.size(); ++i) {
      if (stripes_[i] < 0 || stripes_[i + 1] < 0) continue;
      const std::int64_t step = std::abs(stripes_[i] - stripes_[i + 1]);
      if (step == 1 || step == 2) ++steps[static_cast<std::size_t>(step - 1)];
    }
  }

  /// Sets the share of the pixels that do not integrate light over their width.
  void set_point_like(double share) { point_like_ = share; }

  /// Sets the standard deviation of a border's place by the shape of the pixels.
  void set_place_px(double place_px) { place_px_ = place_px; }

  /// The borders on a line.
  [[nodiscard]] std::vector<StripeBorder> borders(int line, int count) {
    read(line, count);
    find_borders();
    std::vector<StripeBorder> found;
    for (const auto& border : borders_)
      if (border) found.push_back(*border);
    return found;
  }

  /// Decodes line `line` into `phase`, whose pattern gives the length of its fringe.
  void decode(int line, AbsolutePhase& phase) {
    const int count = rows_ ? phase.status.width() : phase.status.height();
    read(line, count);
    find_borders();
    const double rad_per_px = kTwoPi / phase.pattern.period_px;
    for (std::size_t i = 0; i < stripes_.size(); ++i) {
      const int x = rows_ ? static_cast<int>(i) : line;
      const int y = rows_ ? line : static_cast<int>(i);
      phase.status(x, y) = status_[i];
      if (stripes_[i] < 0) continue;
      const Located found = locate(i);
      // Half of the variance of shared errors is not reduced by the mean of pixels.
      const double half = 0.5 * found.shared * found.shared;
      phase.phase_rad(x, y) = static_cast<float>(rad_per_px * found.column);
      phase.sigma_rad(x, y) =
          static_cast<float>(rad_per_px * std::sqrt(found.noise * found.noise + half));
      phase.systematic_rad(x, y) =
          static_cast<float>(rad_per_px * std::hypot(std::sqrt(half), found.curvature));
    }
  }

 private:
  [[nodiscard]] Margin margin(int bit, int x, int y) const {
    Margin best;
    for (const FrameStack& stack : gray_) {
      const auto counts_of = [&](bool is_inverse) {
        const auto frame = static_cast<std::size_t>(frame_of_bit(shown_, bit, is_inverse));
        return static_cast<double>(counts_at(stack.frames[frame], x, y));
      };
      const double counts = counts_of(false);
      double other = 0.0;
      double variance = noise_.variance(counts);
      if (code_.inverted != InvertedFrames::None) {
        other = counts_of(true);
        variance += noise_.variance(other);
      } else {
        other = stack.gain() * static_cast<double>(threshold_(x, y));
        variance += noise_.variance(other);
      }
      const Margin found{(counts - other) / stack.gain(), std::sqrt(variance) / stack.gain()};
      if (std::abs(found.counts) * best.sigma >= std::abs(best.counts) * found.sigma) best = found;
    }
    return best;
  }

  /// Reads the bits of all pixels; a pixel without a certain stripe is -1.
  void read(int line, int count) {
    const auto size = static_cast<std::size_t>(count);
    margins_.assign(size * bits_, {});
    stripes_.assign(size, -1);
    status_.assign(size, PixelStatus::Unmodulated);
    for (std::size_t i = 0; i < size; ++i) {
      const int x = rows_ ? static_cast<int>(i) : line;
      const int y = rows_ ? line : static_cast<int>(i);
      std::uint32_t code = 0;
      double contrast = 0.0;
      for (int bit = 0; bit < code_.bits; ++bit) {
        Margin& found = margins_[i * bits_ + static_cast<std::size_t>(bit)];
        found = margin(bit, x, y);
        contrast = std::max(contrast, std::abs(found.counts) / found.sigma);
        code = 2 * code + (found.counts > 0.0 ? 1U : 0U);
      }
      if (!(contrast >= options_.min_contrast)) continue;
      const bool sure = chance_of_wrong_stripe(i, code) <= options_.max_wrong_stripe;
      status_[i] = sure ? PixelStatus::Measured : PixelStatus::UncertainOrder;
      if (sure) stripes_[i] = stripe_of_code(code_, code);
    }
  }

  [[nodiscard]] double chance_of_wrong_stripe(std::size_t i, std::uint32_t code) const {
    const auto stripe = static_cast<std::int64_t>(stripe_of_code(code_, code));
    double chance = 0.0;
    for (int bit = 0; bit < code_.bits; ++bit) {
      const std::uint32_t other = code ^ (1U << static_cast<unsigned>(code_.bits - 1 - bit));
      if (std::abs(static_cast<std::int64_t>(stripe_of_code(code_, other)) - stripe) <= 1) continue;
      const Margin& read = margins_[i * bits_ + static_cast<std::size_t>(bit)];
      chance += 0.5 * std::erfc(std::abs(read.counts) / (read.sigma * std::numbers::sqrt2));
    }
    return chance;
  }

  /// Finds the borders between each pixel and the next one.
  void find_borders() {
    borders_.assign(stripes_.size(), std::nullopt);
    for (std::size_t i = 0; i + 1 < stripes_.size(); ++i) {
      if (stripes_[i] < 0 || stripes_[i + 1] < 0 || std::abs(stripes_[i] - stripes_[i + 1]) != 1)
        continue;
      borders_[i] = border_after(i);
    }
  }

  /// The border between pixel `i` and the next one, whose stripes are neighbours.
  [[nodiscard]] StripeBorder border_after(std::size_t i) const;

  /// Places a border by the light of the pixels around it: each integrates light over its width and
  /// has a share of the stripe before the border, and the shares sum up to its place whatever the
  /// blur. False where the blur is wider than these pixels.
  ///
  /// @source   Tabatabai and Mitchell 1984, edges that preserve moments
  bool place_by_light(std::size_t i, std::size_t bit, StripeBorder& out) const;

  /// Standard deviation of a border's place between two pixels, `exact_px` where these integrate
  /// light over their width. Otherwise it lies anywhere between two that differ by the contrast.
  [[nodiscard]] double place_sigma_px(double sharpness, double exact_px) const {
    constexpr double kUniform_px2 = 1.0 / 12.0;
    if (sharpness < kSharp) return exact_px;
    return std::sqrt(point_like_ * kUniform_px2 + (1.0 - point_like_) * exact_px * exact_px);
  }

  /// The border before (-1) or after (+1) the stripe that holds pixel `i`; none at the end of the
  /// measured pixels.
  [[nodiscard]] const StripeBorder* border(std::size_t i, int side) const {
    std::size_t pixel = i;
    for (;;) {
      if (side < 0 && pixel == 0) return nullptr;
      const std::size_t between = side < 0 ? pixel - 1 : pixel;
      if (borders_[between]) return &*borders_[between];
      const std::size_t next = side < 0 ? pixel - 1 : pixel + 1;
      if (next >= stripes_.size() || stripes_[next] != stripes_[i]) return nullptr;
      pixel = next;
    }
  }

  /// The rate of columns over pixels from one border to another.
  [[nodiscard]] static double rate_between(const StripeBorder& a, const StripeBorder& b) {
    return (b.column - a.column) / (b.at - a.at);
  }

  /// How far the column within a stripe may be from the straight line between its borders.
  struct Bend {
    double smooth = 0.0;  ///< of a surface that curves steadily through the next borders
    double crease = 0.0;  ///< where the rates of both next stripes continue to an edge between them
  };

  [[nodiscard]] Bend bend_at(const StripeBorder& left, const StripeBorder& right, double t) const;

  /// The column in a stripe with one border, at the end of the measured pixels, with the rate of
  /// the stripe beyond the border; none if there is no such stripe, or the result leaves the own
  /// one.
  [[nodiscard]] std::optional<Located> extrapolate(std::size_t i,
                                                   const StripeBorder& near,
                                                   bool is_left) const;

  [[nodiscard]] Located locate(std::size_t i) const;

  std::span<const FrameStack> gray_;
  const Image<float>& threshold_;
  const NoiseModel& noise_;
  const GrayAloneOptions& options_;
  const Pattern& shown_;
  Pattern code_;  ///< `shown_` without its unused bits
  std::size_t bits_;
  bool rows_;  ///< lines are image rows
  double point_like_ = 0.0;
  double place_px_ = kPlace_px;
  std::vector<Margin> margins_;
  std::vector<std::int64_t> stripes_;
  std::vector<PixelStatus> status_;
  std::vector<std::optional<StripeBorder>> borders_;  ///< between a pixel and the next one
};

}  // namespace frangia
