#include "frangia/phase/gray/check_gray_inverses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

constexpr int kMinBits = 3;        ///< of two that differ, none is at fault
constexpr double kLitShare = 0.2;  ///< least contrast of a lit pixel over that of bright ones
/// Least contrast over the standard deviation of the sum of two frames: half of it is then four of
/// them.
constexpr double kMinLitSigmas = 8.0;
constexpr double kRoundingOfSum =
    0.41;                             ///< counts: standard deviation of the sum of two whole ones
constexpr std::size_t kMinLit = 300;  ///< pixels; fewer decide nothing
constexpr double kOff = 0.5;          ///< of the contrast: a wrong stripe is off by all of it
constexpr double kMaxWrongShare = 0.05;  ///< of the lit pixels: edges of stripes and highlights
constexpr double kPixels = 60'000.0;     ///< that are looked at, on a grid

/// Light of a bit and its inverse at one pixel: sum and difference of each bit.
struct BitLight {
  std::vector<double> sums;
  double contrast = 0.0;  ///< median over the bits
};

/// The standard deviation of a sum, by how the sums of the bits differ at the pixels with at least
/// this contrast. A bit of several that is at fault does not change their median.
double sigma_of_sum(const std::vector<BitLight>& pixels, double least_contrast) {
  constexpr double kSigmaOfMedian = 0.6745;  // median of the absolute values of normal errors
  std::vector<double> off;
  for (const BitLight& pixel : pixels) {
    if (pixel.contrast < least_contrast) continue;
    std::vector<double> ordered = pixel.sums;
    const double sum = median_in_place(std::span(ordered));
    for (const double one : pixel.sums)
      off.push_back(std::abs(one - sum));
  }
  if (off.empty()) return kRoundingOfSum;
  return std::max(kRoundingOfSum, median_in_place(std::span(off)) / kSigmaOfMedian);
}

}  // namespace

SequenceCheck check_gray_inverses(const FrameStack& gray) {
  const Pattern& code = gray.pattern;
  require(static_cast<int>(gray.frames.size()) == code.frame_count(),
          "check_gray_inverses: the number of frames differs from the pattern");
  SequenceCheck out;
  out.patterns = {code.name};
  if (code.inverted == InvertedFrames::None || code.bits < kMinBits) return out;
  const int width = width_of(gray.frames.front());
  const int height = height_of(gray.frames.front());
  const double each = static_cast<double>(width) * height / kPixels;
  const int stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(each))));
  std::vector<BitLight> pixels;
  std::vector<double> contrasts;
  for (int y = 0; y < height; y += stride) {
    for (int x = 0; x < width; x += stride) {
      BitLight pixel;
      std::vector<double> differences;
      for (int bit = 0; bit < code.bits; ++bit) {
        const auto counts = [&](bool inverted) {
          const auto frame = static_cast<std::size_t>(frame_of_bit(code, bit, inverted));
          return counts_at(gray.frames[frame], x, y);
        };
        pixel.sums.push_back(counts(false) + counts(true));
        differences.push_back(std::abs(counts(false) - counts(true)));
      }
      pixel.contrast = median_in_place(std::span(differences));
      contrasts.push_back(pixel.contrast);
      pixels.push_back(std::move(pixel));
    }
  }
  std::sort(contrasts.begin(), contrasts.end());
  const double bright = contrasts[contrasts.size() * 99 / 100];
  const double of_bright = kLitShare * bright;
  const double least = std::max(kMinLitSigmas * sigma_of_sum(pixels, of_bright), of_bright);
  std::vector<double> wrong(static_cast<std::size_t>(code.bits));
  std::size_t lit = 0;
  for (const BitLight& pixel : pixels) {
    if (pixel.contrast < least) continue;
    ++lit;
    std::vector<double> ordered = pixel.sums;
    const double sum = median_in_place(std::span(ordered));
    for (std::size_t bit = 0; bit < wrong.size(); ++bit)
      if (std::abs(pixel.sums[bit] - sum) > kOff * pixel.contrast) wrong[bit] += 1.0;
  }
  if (lit < kMinLit) return out;
  out.decided = true;
  std::vector<int> frames;
  for (int bit = 0; bit < code.bits; ++bit) {
    if (wrong[static_cast<std::size_t>(bit)] > kMaxWrongShare * static_cast<double>(lit))
      frames.push_back(frame_of_bit(code, bit, false));
  }
  out.consistent = frames.empty();
  if (out.consistent) return out;
  out.finding = fmt::format(
      "pattern \"{}\": {} {} and {} not complement each other, so that one of them is lost, "
      "repeated, inverted or in another place; correct the order of the frames, or capture them "
      "again",
      code.name,
      frames.size() == 1 ? "frame" : "frames",
      fmt::join(frames, ", "),
      frames.size() == 1 ? "its inverse do" : "their inverses do");
  return out;
}

}  // namespace frangia
