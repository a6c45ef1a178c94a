#include "frangia/phase/gray/decode_gray_alone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/gray/internal/gray_line_decoder.h"

namespace frangia {
namespace {

constexpr int kMostBits = 24;

void check_code(std::span<const FrameStack> gray, const Image<float>& threshold_counts) {
  require(!gray.empty(), "decode_gray_alone: no Gray code is given");
  const Pattern& code = gray.front().pattern;
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("pattern \"{}\": {}", code.name, why));
  };
  if (code.bits < 1 || code.bits > kMostBits)
    fail(fmt::format("has {} bits; Gray code takes 1 to {}", code.bits, kMostBits));
  for (const FrameStack& stack : gray) {
    if (static_cast<int>(stack.frames.size()) != code.frame_count())
      fail(fmt::format("has {} frames instead of {}", stack.frames.size(), code.frame_count()));
  }
  const bool same = threshold_counts.width() == width_of(gray.front().frames.front()) &&
                    threshold_counts.height() == height_of(gray.front().frames.front());
  if (code.inverted == InvertedFrames::None && !same)
    fail("has no inverted frames, and no threshold of the size of its frames is given");
}

/// The number of bits whose stripes the camera resolves: of a finer bit, most pixels see bright and
/// dark stripes at once.
int resolved_bits(GrayLineDecoder decoder, int bits, int lines, int count) {
  constexpr int kLines = 32;
  constexpr float kLeast = 0.4F;  // median contrast of a bit; 0.5 for runs as wide as a pixel
  std::vector<std::vector<float>> contrasts(static_cast<std::size_t>(bits));
  for (int line = 0; line < lines; line += std::max(1, lines / kLines))
    decoder.add_contrasts(line, count, contrasts);
  int resolved = bits;
  while (resolved > 1) {
    std::vector<float>& last = contrasts[static_cast<std::size_t>(resolved - 1)];
    if (last.empty() || median(std::move(last)) >= kLeast) break;
    --resolved;
  }
  return resolved;
}

/// The number of bits whose stripes are wider than pixels. From one pixel to the next, the number
/// of narrower ones changes by two here and there: such pixels have no border to be located by.
int locatable_bits(GrayLineDecoder decoder, int bits, int lines, int count) {
  constexpr int kLines = 32;
  constexpr double kMostOfTwo = 0.03;  // of the steps: at the edges of a part there are fewer
  while (bits > 1) {
    decoder.use_bits(bits);
    std::array<std::size_t, 2> steps{};
    for (int line = 0; line < lines; line += std::max(1, lines / kLines))
      decoder.add_steps(line, count, steps);
    if (static_cast<double>(steps[1]) <= kMostOfTwo * static_cast<double>(steps[0] + steps[1]))
      break;
    --bits;
  }
  return bits;
}

/// The share of the pixels that do not integrate light over their width. Of pixels that do, a fifth
/// of the borders is so near to the edge of a pixel that both sides are fully bright or dark.
double point_like_share(GrayLineDecoder decoder, int lines, int count) {
  constexpr int kLines = 64;
  constexpr double kOfIntegrating = 2.0 * (1.0 - kSharp);
  std::size_t all = 0;
  std::size_t sharp = 0;
  for (int line = 0; line < lines; line += std::max(1, lines / kLines)) {
    for (const StripeBorder& border : decoder.borders(line, count)) {
      ++all;
      sharp += border.sharpness >= kSharp ? 1U : 0U;
    }
  }
  if (all == 0) return 1.0;
  const double share = static_cast<double>(sharp) / static_cast<double>(all);
  return std::clamp((share - kOfIntegrating) / (1.0 - kOfIntegrating), 0.0, 1.0);
}

/// Standard deviation of the borders' places beyond noise, by how far each is from the middle of
/// the same border on the lines before and after: pixels that are the mean of a few rays, or have
/// gaps between them, place a border in steps.
double scatter_px(GrayLineDecoder decoder, int lines, int count) {
  constexpr int kTriples = 48;
  constexpr double kSameBorder_px = 3.0;
  constexpr double kMedianOfNormal = 0.6745;
  std::vector<double> off;
  std::vector<double> noise;
  for (int line = 1; line + 1 < lines; line += std::max(1, lines / kTriples)) {
    const std::vector<StripeBorder> before = decoder.borders(line - 1, count);
    const std::vector<StripeBorder> after = decoder.borders(line + 1, count);
    for (const StripeBorder& border : decoder.borders(line, count)) {
      const auto same = [&](const StripeBorder& other) {
        return other.column == border.column && std::abs(other.at - border.at) < kSameBorder_px;
      };
      const auto first = std::find_if(before.begin(), before.end(), same);
      const auto last = std::find_if(after.begin(), after.end(), same);
      if (first == before.end() || last == after.end()) continue;
      off.push_back(std::abs(border.at - 0.5 * (first->at + last->at)));
      noise.push_back(border.noise_px);
    }
  }
  if (off.empty()) return 0.0;
  const double all = median(std::move(off)) / kMedianOfNormal / std::sqrt(1.5);
  const double known = median(std::move(noise));
  return std::sqrt(std::max(0.0, all * all - known * known));
}

}  // namespace

AbsolutePhase decode_gray_alone(std::span<const FrameStack> gray,
                                const Image<float>& threshold_counts,
                                const NoiseModel& noise,
                                const GrayAloneOptions& options) {
  check_code(gray, threshold_counts);
  const Pattern& code = gray.front().pattern;
  const int width = width_of(gray.front().frames.front());
  const int height = height_of(gray.front().frames.front());
  AbsolutePhase out{{.name = code.name,
                     .direction = code.direction,
                     .period_px = std::ldexp(code.stripe_px, code.bits)},
                    Image<float>(width, height, kMissing),
                    Image<float>(width, height, kMissing),
                    Image<PixelStatus>(width, height, PixelStatus::Unmodulated),
                    Image<float>(width, height, kMissing)};
  const bool rows = code.direction == FringeDirection::Vertical;
  const int lines = rows ? height : width;
  const int count = rows ? width : height;
  GrayLineDecoder decoder(gray, threshold_counts, noise, options);
  const int resolved = resolved_bits(decoder, code.bits, lines, count);
  decoder.use_bits(locatable_bits(decoder, resolved, lines, count));
  decoder.set_point_like(point_like_share(decoder, lines, count));
  decoder.set_place_px(std::max(kPlace_px, scatter_px(decoder, lines, count)));
  parallel_rows(lines, [&](int line) { GrayLineDecoder(decoder).decode(line, out); });
  return out;
}

}  // namespace frangia
