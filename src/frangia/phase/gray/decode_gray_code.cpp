#include "frangia/phase/gray/decode_gray_code.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

constexpr int kMaxBits = 24;  ///< wider than any projector; codes stay exact in 32 bits

void check(std::span<const FrameStack> gray, const WrappedPhase& fringes) {
  require(!gray.empty(), "decode_gray_code: no Gray code is given");
  const Pattern& code = gray.front().pattern;
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("pattern \"{}\": {}", code.name, why));
  };
  if (code.bits < 1 || code.bits > kMaxBits)
    fail(fmt::format("has {} bits; Gray code takes 1 to {}", code.bits, kMaxBits));
  if (code.direction != fringes.pattern.direction)
    fail(fmt::format("has another direction than the fringes \"{}\"", fringes.pattern.name));
  if (!(code.stripe_px <= fringes.pattern.period_px)) {
    fail(
        fmt::format("its stripes of {:g} px are wider than the fringes of \"{}\", {:g} px; take "
                    "more bits",
                    code.stripe_px,
                    fringes.pattern.name,
                    fringes.pattern.period_px));
  }
  for (const FrameStack& stack : gray) {
    if (static_cast<int>(stack.frames.size()) != code.frame_count())
      fail(fmt::format("has {} frames instead of {}", stack.frames.size(), code.frame_count()));
    for (const Frame& frame : stack.frames) {
      if (width_of(frame) != fringes.phase_rad.width() ||
          height_of(frame) != fringes.phase_rad.height())
        fail("its frames differ in size from those of the fringes");
    }
  }
}

/// One decoded bit.
struct Bit {
  bool bright = false;
  double chance = 0.5;  ///< probability that the bit is misread
};

class GrayCodeReader {
 public:
  GrayCodeReader(std::span<const FrameStack> gray,
                 const WrappedPhase& fringes,
                 const NoiseModel& noise)
      : gray_(gray), fringes_(fringes), noise_(noise), code_(gray.front().pattern) {}

  /// The absolute phase of a measured pixel and the probability of a wrong order.
  struct DecodedPixel {
    double rad;
    double chance;
  };
  [[nodiscard]] DecodedPixel decode(int x, int y) const {
    std::array<Bit, kMaxBits> bits;
    std::uint32_t code = 0;
    for (int i = 0; i < code_.bits; ++i) {
      bits[static_cast<std::size_t>(i)] = read(i, x, y);
      code = 2 * code + (bits[static_cast<std::size_t>(i)].bright ? 1U : 0U);
    }
    const double wrapped = fringes_.phase_rad(x, y);
    const double sigma = fringes_.sigma_rad(x, y);
    const double expected = expected_rad(code);
    const double order = std::round((expected - wrapped) / kTwoPi);
    // The distance from the stripe's centre is geometry, not noise; the rest of the half fringe is
    // margin.
    const double off = std::abs(wrapped + kTwoPi * order - expected);
    double chance = 0.5 * std::erfc((kPi - off) / (sigma * std::numbers::sqrt2));
    for (int i = 0; i < code_.bits; ++i) {
      const std::uint32_t other = code ^ (1U << static_cast<unsigned>(code_.bits - 1 - i));
      if (std::round((expected_rad(other) - wrapped) / kTwoPi) == order) continue;
      chance += bits[static_cast<std::size_t>(i)].chance;
    }
    return {wrapped + kTwoPi * order, chance};
  }

 private:
  /// Phase at the centre of the stripe with this code.
  [[nodiscard]] double expected_rad(std::uint32_t code) const {
    return kTwoPi * column_of_code(code_, code) / fringes_.pattern.period_px;
  }
  [[nodiscard]] Bit read(int i, int x, int y) const {
    double best = 0.0;  // of the exposure with the largest margin
    for (const FrameStack& stack : gray_) {
      const auto counts_of = [&](bool is_inverse) {
        const auto frame = static_cast<std::size_t>(frame_of_bit(code_, i, is_inverse));
        return static_cast<double>(counts_at(stack.frames[frame], x, y));
      };
      const double counts = counts_of(false);
      double threshold = 0.0;
      double variance = noise_.variance(counts);
      if (code_.inverted != InvertedFrames::None) {
        threshold = counts_of(true);
        variance += noise_.variance(threshold);
      } else {
        threshold = stack.gain() * static_cast<double>(fringes_.mean_counts(x, y));
      }
      const double sigmas = (counts - threshold) / std::sqrt(variance);
      if (std::abs(sigmas) > std::abs(best)) best = sigmas;
    }
    return {best > 0.0, 0.5 * std::erfc(std::abs(best) / std::numbers::sqrt2)};
  }

  std::span<const FrameStack> gray_;
  const WrappedPhase& fringes_;
  const NoiseModel& noise_;
  const Pattern& code_;
};

}  // namespace

AbsolutePhase decode_gray_code(std::span<const FrameStack> gray,
                               const WrappedPhase& fringes,
                               const NoiseModel& noise,
                               const TemporalUnwrapOptions& options) {
  check(gray, fringes);
  const GrayCodeReader reader(gray, fringes, noise);
  AbsolutePhase out{fringes.pattern,
                    fringes.phase_rad,
                    fringes.sigma_rad,
                    fringes.status,
                    fringes.systematic_rad,
                    fringes.differing_share};
  parallel_rows(out.status.height(), [&](int y) {
    for (int x = 0; x < out.status.width(); ++x) {
      if (out.status(x, y) != PixelStatus::Measured) continue;
      const auto found = reader.decode(x, y);
      const bool sure = found.chance <= options.max_wrong_order;
      out.phase_rad(x, y) = sure ? static_cast<float>(found.rad) : kMissing;
      if (sure) continue;
      out.sigma_rad(x, y) = kMissing;
      if (!out.systematic_rad.empty()) out.systematic_rad(x, y) = kMissing;
      out.status(x, y) = PixelStatus::UncertainOrder;
    }
  });
  return out;
}

}  // namespace frangia
