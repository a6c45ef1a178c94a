#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/phase/gray/check_gray_code.h"
#include "frangia/phase/gray/internal/gray_trials.h"
#include "frangia/phase/internal/fringe_frequency.h"

namespace frangia {

/// Limits and sampling of `check_gray_code`.
struct GrayCodeCheckLimits {
  int lines = 64;  ///< sampled rows, or columns for horizontal stripes
  /// Distance of a bright or dark pixel from the mean of the fringes, over their modulation; pixels
  /// nearer to it are on the border of two stripes.
  double min_level = 0.3;
  std::size_t min_pixels = 300;  ///< fewer decide nothing
  std::size_t min_borders = 12;  ///< borders of a frame's stripes; fewer say nothing about it
  double margin_rad = 0.5;       ///< added to half a stripe when stripes are compared with fringes
  /// Shares of pixels that agree with the fringes, and of borders that lie between neighbouring
  /// stripes, below which the code does not fit. Sound codes have more than 0.95 of both, except
  /// for borders at depth edges.
  double min_agreement = 0.75;
  double min_gain = 0.2;  ///< by which another declaration must raise the smaller share
  double tie = 0.03;      ///< shares that differ by less are equal
  /// Start of the fringes at the borders of the stripes that a sound code may show: blur and
  /// harmonics move borders and phases. Half a projector pixel is 0.2 for fringes of 16 px.
  double max_start_rad = 0.25;
  double max_start_three_rad = 0.45;  ///< the same for three frames, which harmonics affect more
};
inline constexpr GrayCodeCheckLimits kGrayCodeLimits;

inline constexpr int kBorderGap = 3;  ///< px between the two sides of a border

/// A border is a depth edge where the step of the phase across it differs by this much from the
/// step that the slope of the phase next to it predicts.
inline constexpr double kSmooth_rad = 0.8;
/// Depth edges whose phases agree by chance, relative to those that are recognized.
inline constexpr double kByChance = kSmooth_rad / (kPi - kSmooth_rad);

/// One sampled pixel: which frames are bright, and the wrapped phase.
struct CodedPixel {
  std::uint64_t bright = 0;  ///< one bit per frame
  float phase_rad = 0.0F;
  int line = 0;
  int place = 0;  ///< along the line
};

/// Sampled pixels of a Gray code and its fringes, and how well trials agree with them.
class GrayCodeSample {
 public:
  GrayCodeSample(const FrameStack& gray, const WrappedPhase& fringes)
      : gray_(gray), fringes_(fringes) {
    const bool columns = gray.pattern.direction == FringeDirection::Horizontal;
    const int across = columns ? fringes.status.width() : fringes.status.height();
    const int along = columns ? fringes.status.height() : fringes.status.width();
    const int stride = std::max(1, across / kGrayCodeLimits.lines);
    for (int line = stride / 2; line < across; line += stride) {
      for (int place = 0; place < along; ++place) {
        CodedPixel pixel{.line = line, .place = place};
        if (read(columns ? line : place, columns ? place : line, pixel)) pixels.push_back(pixel);
      }
    }
  }

  /// The least of the shares that agree with the fringes, that lie between neighbouring stripes,
  /// and whose stripes rise with the phase.
  [[nodiscard]] double score(const GrayTrial& trial) const {
    std::vector<std::uint32_t> stripes;
    stripes.reserve(pixels.size());
    for (const CodedPixel& pixel : pixels)
      stripes.push_back(stripe_of(trial, pixel));
    return std::min({fringe_agreement(trial, stripes),
                     border_agreement(stripes),
                     rising_agreement(trial, stripes)});
  }
  /// Whether a frame is bright, or dark, at nearly every pixel.
  [[nodiscard]] bool is_blank(std::size_t frame) const {
    const auto bright = static_cast<double>(
        std::count_if(pixels.begin(), pixels.end(), [&](const CodedPixel& pixel) {
          return (pixel.bright >> frame & 1U) != 0;
        }));
    const double share = bright / static_cast<double>(pixels.size());
    return share < 0.005 || share > 0.995;
  }
  /// Whether two frames are bright at the same pixels.
  [[nodiscard]] bool are_equal(std::size_t a, std::size_t b) const {
    const auto different = static_cast<double>(
        std::count_if(pixels.begin(), pixels.end(), [&](const CodedPixel& pixel) {
          return ((pixel.bright >> a ^ pixel.bright >> b) & 1U) != 0;
        }));
    return different < 0.005 * static_cast<double>(pixels.size());
  }

  /// Share of the pixels that contradict the fringes, or of the borders where the number falls
  /// while the phase rises, that fit if this frame showed the opposite there.
  ///
  /// Where a frame is wrong the number falls at all borders. One that falls between others that
  /// rise is a depth edge.
  [[nodiscard]] double contradiction_of(const GrayTrial& declared, std::size_t frame) const {
    GrayTrial opposite = declared;
    opposite.inverted[frame] = !opposite.inverted[frame];
    double wrong = 0.0;
    double falling = 0.0;
    double borders = 0.0;
    int line_of_last = -1;
    int run = 0;  // borders of this line that fall, one after the other
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool agrees = agrees_with_fringes(declared, pixels[i], stripe_of(declared, pixels[i]));
      if (!agrees && agrees_with_fringes(opposite, pixels[i], stripe_of(opposite, pixels[i])))
        wrong += 1.0;
      if (i == 0 || pixels[i].line != pixels[i - 1].line ||
          pixels[i].place - pixels[i - 1].place > kBorderGap || !is_smooth(i))
        continue;
      const int step = step_along_phase(declared, i);
      if (step == 0) continue;
      borders += 1.0;
      const bool falls = step < 0 && step_along_phase(opposite, i) > 0;
      run = !falls ? 0 : pixels[i].line == line_of_last ? run + 1 : 1;
      line_of_last = pixels[i].line;
      if (run > 1) falling += run == 2 ? 2.0 : 1.0;
    }
    return std::max(wrong / static_cast<double>(std::max<std::size_t>(1, pixels.size())),
                    falling / std::max(borders, static_cast<double>(kGrayCodeLimits.min_borders)));
  }

  /// The phases of the fringes at the borders of neighbouring stripes.
  struct Borders {
    std::vector<double> columns;
    std::vector<float> phases_rad;
  };
  [[nodiscard]] Borders borders(const GrayTrial& trial) const {
    Borders found;
    for (std::size_t i = 1; i < pixels.size(); ++i) {
      const CodedPixel& a = pixels[i - 1];
      const CodedPixel& b = pixels[i];
      if (a.line != b.line || b.place - a.place > kBorderGap || !is_smooth(i)) continue;
      const std::uint32_t first = stripe_of(trial, a);
      const std::uint32_t second = stripe_of(trial, b);
      if (first + 1 != second && second + 1 != first) continue;
      const double step = wrap_rad(static_cast<double>(b.phase_rad - a.phase_rad));
      found.columns.push_back(std::max(first, second) * trial.code.stripe_px - 0.5 -
                              trial.code.offset_px);
      found.phases_rad.push_back(a.phase_rad + static_cast<float>(0.5 * step));
    }
    return found;
  }

  /// The start of the fringes relative to the declared one, from their phases at the borders of
  /// the stripes; `scattered` where these say nothing of it.
  struct Start {
    double offset_rad = kMissing;
    bool scattered = false;
  };
  [[nodiscard]] Start start_offset(const GrayTrial& trial) const {
    const double period = trial.period_px;
    const Borders at = borders(trial);
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t i = 0; i < at.columns.size(); ++i) {
      const double found = static_cast<double>(at.phases_rad[i]) - kTwoPi * at.columns[i] / period;
      cosine += std::cos(found);
      sine += std::sin(found);
    }
    constexpr double kMinConcentration = 0.7;
    const auto count = static_cast<double>(at.columns.size());
    if (at.columns.size() < kGrayCodeLimits.min_pixels) return {};
    if (std::hypot(cosine, sine) < kMinConcentration * count) return {kMissing, true};
    return {std::atan2(sine, cosine), false};
  }
  /// The period that the fringes show at the borders of the stripes, if the code is as declared; 0
  /// if none fits. It is rounded as far as the borders allow.
  [[nodiscard]] double shown_period_px(const GrayTrial& trial) const {
    const Borders at = borders(trial);
    if (at.columns.size() < kGrayCodeLimits.min_pixels) return 0.0;
    const auto [low, high] = std::minmax_element(at.columns.begin(), at.columns.end());
    const double field = *high - *low;
    if (!(field > 0.0)) return 0.0;
    // A stripe is no wider than a fringe; borders alone do not tell narrower fringes from wider
    // ones.
    constexpr double kFinest = 4.0;  // of the frequency that `best_frequency` expects
    const double most = 1.02 / trial.code.stripe_px;
    const double frequency = best_frequency(at.columns, at.phases_rad, most / kFinest, field);
    if (!(frequency > 0.0)) return 0.0;
    const double declared = 1.0 / fringes_.pattern.period_px;
    const double odds =
        log_odds_of_frequency(at.columns, at.phases_rad, frequency, declared, 5.0 * most * field);
    if (odds < std::log(100.0)) return 0.0;
    constexpr double kSame = 0.1;  // fringes over the field
    for (const double unit : {1.0, 0.5, 0.1, 0.01}) {
      const double rounded = unit * std::round(1.0 / frequency / unit);
      if (rounded > 0.0 && std::abs(1.0 / rounded - frequency) * field < kSame) return rounded;
    }
    return 1.0 / frequency;
  }

  std::vector<CodedPixel> pixels;

 private:
  bool read(int x, int y, CodedPixel& pixel) const {
    if (fringes_.status(x, y) != PixelStatus::Measured) return false;
    pixel.phase_rad = fringes_.phase_rad(x, y);
    const double mean = fringes_.mean_counts(x, y);
    const double level =
        kGrayCodeLimits.min_level * static_cast<double>(fringes_.modulation_counts(x, y));
    for (std::size_t k = 0; k < gray_.frames.size(); ++k) {
      const double above = counts_at(gray_.frames[k], x, y) - mean;
      if (std::abs(above) < level) return false;
      if (above > 0.0) pixel.bright |= std::uint64_t{1} << k;
    }
    return true;
  }
  [[nodiscard]] static std::uint32_t stripe_of(const GrayTrial& trial, const CodedPixel& pixel) {
    const std::uint32_t shown = shown_stripe(trial, pixel.bright);
    if (!trial.missing) return shown;
    const std::uint32_t other =
        shown_stripe(trial, pixel.bright ^ std::uint64_t{1} << *trial.missing);
    return distance_rad(trial, pixel, other) < distance_rad(trial, pixel, shown) ? other : shown;
  }
  /// The distance of the measured phase from that of the middle of a stripe.
  [[nodiscard]] static double distance_rad(const GrayTrial& trial,
                                           const CodedPixel& pixel,
                                           std::uint32_t stripe) {
    const double column = (stripe + 0.5) * trial.code.stripe_px - 0.5 - trial.code.offset_px;
    const auto measured = static_cast<double>(pixel.phase_rad);
    const double phase = (trial.reversed ? -measured : measured) - trial.start_rad;
    return std::abs(wrap_rad(phase - kTwoPi * column / trial.period_px));
  }
  [[nodiscard]] double fringe_agreement(const GrayTrial& trial,
                                        const std::vector<std::uint32_t>& stripes) const {
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (agrees_with_fringes(trial, pixels[i], stripes[i])) ++agreeing;
    return static_cast<double>(agreeing) / static_cast<double>(pixels.size());
  }
  [[nodiscard]] bool agrees_with_fringes(const GrayTrial& trial,
                                         const CodedPixel& pixel,
                                         std::uint32_t stripe) const {
    return distance_rad(trial, pixel, stripe) <=
           kPi * trial.code.stripe_px / trial.period_px + kGrayCodeLimits.margin_rad;
  }
  /// 1 where the number of the stripe rises by one with the phase from pixel `i - 1` to `i`, -1
  /// where it falls, 0 elsewhere.
  [[nodiscard]] int step_along_phase(const GrayTrial& trial, std::size_t i) const {
    const auto step = static_cast<std::int64_t>(stripe_of(trial, pixels[i])) -
                      static_cast<std::int64_t>(stripe_of(trial, pixels[i - 1]));
    if (std::abs(step) != 1) return 0;
    const double change =
        wrap_rad(static_cast<double>(pixels[i].phase_rad - pixels[i - 1].phase_rad));
    return (change > 0.0) == (step > 0) ? 1 : -1;
  }
  /// Whether the phase continues from pixel `i - 1` to pixel `i`: both are on one surface. Depth
  /// edges are no borders, and may be all of what a frame with wide stripes shows.
  [[nodiscard]] bool is_smooth(std::size_t i) const {
    const auto slope_from = [&](std::size_t k, double& sum, double& count) {
      const CodedPixel& a = pixels[k];
      const CodedPixel& b = pixels[k + 1];
      if (a.line != b.line || b.place - a.place > kBorderGap) return;
      sum += wrap_rad(static_cast<double>(b.phase_rad - a.phase_rad)) / (b.place - a.place);
      count += 1.0;
    };
    double sum = 0.0;
    double count = 0.0;
    if (i >= 2) slope_from(i - 2, sum, count);
    if (i + 1 < pixels.size()) slope_from(i, sum, count);
    if (count == 0.0) return true;
    const double predicted = sum / count * (pixels[i].place - pixels[i - 1].place);
    const auto change = static_cast<double>(pixels[i].phase_rad - pixels[i - 1].phase_rad);
    return std::abs(wrap_rad(change - predicted)) < kSmooth_rad;
  }
  /// The least share, over the frames, of the borders of their stripes that lie between
  /// neighbouring stripes, without those at depth edges.
  [[nodiscard]] double border_agreement(const std::vector<std::uint32_t>& stripes) const {
    std::vector<double> edges(gray_.frames.size());
    std::vector<double> good(gray_.frames.size());
    std::vector<double> bad(gray_.frames.size());
    for (std::size_t i = 1; i < pixels.size(); ++i) {
      const CodedPixel& a = pixels[i - 1];
      const CodedPixel& b = pixels[i];
      const std::uint64_t changed = a.bright ^ b.bright;
      if (changed == 0 || a.line != b.line || b.place - a.place > kBorderGap) continue;
      const bool neighbours = std::abs(static_cast<std::int64_t>(stripes[i]) -
                                       static_cast<std::int64_t>(stripes[i - 1])) <= 1;
      std::vector<double>& kind = neighbours ? good : is_smooth(i) ? bad : edges;
      for (std::size_t frame = 0; frame < good.size(); ++frame)
        if ((changed >> frame & 1U) != 0) kind[frame] += 1.0;
    }
    double least = 1.0;
    for (std::size_t frame = 0; frame < good.size(); ++frame) {
      const double by_chance = kByChance * edges[frame];
      constexpr double kSure = 3.0;  // standard deviations of a count
      const double wrong = std::max(0.0, bad[frame] - by_chance - kSure * std::sqrt(by_chance));
      const double borders = good[frame] + wrong;
      if (borders < static_cast<double>(kGrayCodeLimits.min_borders)) continue;
      least = std::min(least, good[frame] / borders);
    }
    return least;
  }

  /// Share of the borders between neighbouring stripes where number and phase rise together.
  [[nodiscard]] double rising_agreement(const GrayTrial& trial,
                                        const std::vector<std::uint32_t>& stripes) const {
    std::size_t borders = 0;
    std::size_t rising = 0;
    for (std::size_t i = 1; i < pixels.size(); ++i) {
      const CodedPixel& a = pixels[i - 1];
      const CodedPixel& b = pixels[i];
      if (a.line != b.line || b.place - a.place > kBorderGap) continue;
      const auto step =
          static_cast<std::int64_t>(stripes[i]) - static_cast<std::int64_t>(stripes[i - 1]);
      if (std::abs(step) != 1) continue;
      const double change = wrap_rad(static_cast<double>(b.phase_rad - a.phase_rad));
      ++borders;
      rising += ((change > 0.0) != trial.reversed) == (step > 0) ? 1 : 0;
    }
    if (borders < kGrayCodeLimits.min_borders) return 1.0;
    return static_cast<double>(rising) / static_cast<double>(borders);
  }

  const FrameStack& gray_;
  const WrappedPhase& fringes_;
};

}  // namespace frangia
