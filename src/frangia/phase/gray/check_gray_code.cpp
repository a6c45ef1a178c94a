#include "frangia/phase/gray/check_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/gray/internal/gray_trials.h"
#include "frangia/phase/internal/best_frequency.h"

namespace frangia {
namespace {

constexpr int kGap = 3;  ///< px between the two sides of a border

/// Difference of the phases on both sides of a border from what the slope beside it predicts, from
/// which on the border is a depth edge.
constexpr double kSmooth_rad = 0.8;
/// Depth edges whose phases agree by chance, relative to those that are recognized.
constexpr double kByChance = kSmooth_rad / (kPi - kSmooth_rad);

/// One sampled pixel: which frames are bright, and the wrapped phase.
struct CodedPixel {
  std::uint64_t bright = 0;  ///< one bit per frame
  float phase_rad = 0.0F;
  int line = 0;
  int place = 0;  ///< along the line
};

/// Samples lines of pixels across the stripes, without those at which a frame is neither bright nor
/// dark.
std::vector<CodedPixel> sample_code(const FrameStack& gray,
                                    const WrappedPhase& fringes,
                                    const GrayCodeCheckOptions& options) {
  const bool columns = gray.pattern.direction == FringeDirection::Horizontal;
  const int across = columns ? fringes.status.width() : fringes.status.height();
  const int along = columns ? fringes.status.height() : fringes.status.width();
  const int stride = std::max(1, across / options.lines);
  std::vector<CodedPixel> pixels;
  for (int line = stride / 2; line < across; line += stride) {
    for (int place = 0; place < along; ++place) {
      const int x = columns ? line : place;
      const int y = columns ? place : line;
      if (fringes.status(x, y) != PixelStatus::Measured) continue;
      CodedPixel pixel{.phase_rad = fringes.phase_rad(x, y), .line = line, .place = place};
      const double mean = fringes.mean_counts(x, y);
      const double level = options.min_level * static_cast<double>(fringes.modulation_counts(x, y));
      bool decided = true;
      for (std::size_t k = 0; k < gray.frames.size() && decided; ++k) {
        const double above = counts_at(gray.frames[k], x, y) - mean;
        decided = !(std::abs(above) < level);
        if (above > 0.0) pixel.bright |= std::uint64_t{1} << k;
      }
      if (decided) pixels.push_back(pixel);
    }
  }
  return pixels;
}

class GrayCodeSample {
 public:
  /// `frames`: number of frames of the code; `period_px`: of the fringes.
  GrayCodeSample(std::vector<CodedPixel> coded,
                 std::size_t frames,
                 double period_px,
                 const GrayCodeCheckOptions& options)
      : pixels(std::move(coded)), frames_(frames), period_px_(period_px), options_(options) {}

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
      if (a.line != b.line || b.place - a.place > kGap || !is_smooth(i)) continue;
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
    const Borders at = borders(trial);
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t i = 0; i < at.columns.size(); ++i) {
      const double found =
          static_cast<double>(at.phases_rad[i]) - kTwoPi * at.columns[i] / period_px_;
      cosine += std::cos(found);
      sine += std::sin(found);
    }
    constexpr double kMinConcentration = 0.7;
    const auto count = static_cast<double>(at.columns.size());
    if (at.columns.size() < options_.min_pixels) return {};
    if (std::hypot(cosine, sine) < kMinConcentration * count) return {kMissing, true};
    return {std::atan2(sine, cosine), false};
  }
  /// The period that the fringes show at the borders of the stripes, if the code is as declared; 0
  /// if none fits. It is rounded as far as the borders allow.
  [[nodiscard]] double shown_period_px(const GrayTrial& trial) const {
    const Borders at = borders(trial);
    if (at.columns.size() < options_.min_pixels) return 0.0;
    const auto [low, high] = std::minmax_element(at.columns.begin(), at.columns.end());
    const double field = *high - *low;
    if (!(field > 0.0)) return 0.0;
    // A stripe is no wider than a fringe; borders alone do not tell narrower fringes from wider
    // ones.
    constexpr double kFinest = 4.0;  // of the frequency that `best_frequency` expects
    const double most = 1.02 / trial.code.stripe_px;
    const double frequency = best_frequency(at.columns, at.phases_rad, most / kFinest, field);
    if (!(frequency > 0.0)) return 0.0;
    const double declared = 1.0 / period_px_;
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
  [[nodiscard]] static std::uint32_t stripe_of(const GrayTrial& trial, const CodedPixel& pixel) {
    std::uint32_t code = 0;
    for (int bit = 0; bit < trial.code.bits; ++bit) {
      const auto declared = static_cast<std::size_t>(frame_of_bit(trial.code, bit, false));
      const std::size_t frame = trial.frame_of[declared];
      const bool bright = ((pixel.bright >> frame & 1U) != 0) != trial.inverted[frame];
      code = 2 * code + (bright ? 1U : 0U);
    }
    return stripe_of_code(trial.code, code);
  }
  [[nodiscard]] double fringe_agreement(const GrayTrial& trial,
                                        const std::vector<std::uint32_t>& stripes) const {
    const double limit = kPi * trial.code.stripe_px / period_px_ + options_.margin_rad;
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double column = (stripes[i] + 0.5) * trial.code.stripe_px - 0.5 - trial.code.offset_px;
      const double measured = static_cast<double>(pixels[i].phase_rad);
      const double phase = (trial.reversed ? -measured : measured) - trial.start_rad;
      if (std::abs(wrap_rad(phase - kTwoPi * column / period_px_)) <= limit) ++agreeing;
    }
    return static_cast<double>(agreeing) / static_cast<double>(pixels.size());
  }
  /// Whether the phase continues from pixel `i - 1` to pixel `i`: both are on one surface. Depth
  /// edges are no borders, and may be all of what a frame with wide stripes shows.
  [[nodiscard]] bool is_smooth(std::size_t i) const {
    const auto slope_from = [&](std::size_t k, double& sum, double& count) {
      const CodedPixel& a = pixels[k];
      const CodedPixel& b = pixels[k + 1];
      if (a.line != b.line || b.place - a.place > kGap) return;
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
    std::vector<double> edges(frames_);
    std::vector<double> good(frames_);
    std::vector<double> bad(frames_);
    for (std::size_t i = 1; i < pixels.size(); ++i) {
      const CodedPixel& a = pixels[i - 1];
      const CodedPixel& b = pixels[i];
      const std::uint64_t changed = a.bright ^ b.bright;
      if (changed == 0 || a.line != b.line || b.place - a.place > kGap) continue;
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
      if (borders < static_cast<double>(options_.min_borders)) continue;
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
      if (a.line != b.line || b.place - a.place > kGap) continue;
      const auto step =
          static_cast<std::int64_t>(stripes[i]) - static_cast<std::int64_t>(stripes[i - 1]);
      if (std::abs(step) != 1) continue;
      const double change = wrap_rad(static_cast<double>(b.phase_rad - a.phase_rad));
      ++borders;
      rising += ((change > 0.0) != trial.reversed) == (step > 0) ? 1 : 0;
    }
    if (borders < options_.min_borders) return 1.0;
    return static_cast<double>(rising) / static_cast<double>(borders);
  }

  std::size_t frames_;
  double period_px_;
  const GrayCodeCheckOptions& options_;
};

/// Frames that show no stripes, or those of the frame before: a frame is missing.
void add_missing_frames(const GrayCodeSample& sample, const Pattern& code, SequenceCheck& out) {
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(code.frame_count()); ++frame) {
    const bool repeats = frame > 0 && sample.are_equal(frame, frame - 1);
    if (!repeats && !sample.is_blank(frame)) continue;
    out.fits.push_back(
        {SequenceFaultKind::Missing,
         {code.name},
         repeats ? fmt::format("a missing frame: frame {} repeats frame {}", frame, frame - 1)
                 : fmt::format("a missing frame: frame {} shows no stripes", frame),
         {},
         fmt::format("capture {}-{}.png again", code.name, frame)});
  }
}

/// Widths of the stripes and periods of the fringes with which the fringes lie at the borders of
/// the stripes where they should.
std::vector<SequenceFault> other_scales(const GrayCodeSample& sample,
                                        const Pattern& code,
                                        const Pattern& fringes,
                                        const GrayCodeCheckOptions& options) {
  std::vector<SequenceFault> fits;
  for (const double factor : {2.0, 0.5, 4.0, 0.25}) {
    GrayTrial trial = declared_trial(code);
    trial.code.stripe_px *= factor;
    if (!(std::abs(sample.start_offset(trial).offset_rad) <= options.max_start_rad) ||
        sample.score(trial) < options.min_agreement)
      continue;
    fits.push_back(
        {SequenceFaultKind::Period,
         {code.name},
         fmt::format("stripes of {:g} px, not {:g} px", trial.code.stripe_px, code.stripe_px),
         {},
         fmt::format("stripe_px = {:g}", trial.code.stripe_px)});
    break;
  }
  const double period_px = sample.shown_period_px(declared_trial(code));
  if (period_px > 0.0 && std::abs(period_px - fringes.period_px) > 1e-3 * fringes.period_px) {
    fits.push_back(
        {SequenceFaultKind::Period,
         {fringes.name},
         fmt::format("a period of {:.6g} px, not {:.6g} px", period_px, fringes.period_px),
         {},
         fmt::format("period_px = {:.6g}", period_px)});
  }
  return fits;
}

/// The fringes began at another phase than declared.
SequenceFault start_fault(const Pattern& fringes, double start_rad) {
  const double declared_deg = deg_from_rad(fringes.shifts_rad.front());
  const double start_deg = std::round(declared_deg + deg_from_rad(start_rad));
  SequenceFault fault{SequenceFaultKind::Start,
                      {fringes.name},
                      fmt::format("a start of {:g} degrees, not {:g} degrees",
                                  start_deg - 360.0 * std::floor(start_deg / 360.0),
                                  declared_deg),
                      {},
                      "by the Gray code"};
  fault.shifts_rad = fringes.shifts_rad;
  for (double& shift : fault.shifts_rad)
    shift += rad_from_deg(start_deg - declared_deg);
  return fault;
}

}  // namespace

SequenceCheck check_gray_code(const FrameStack& gray,
                              const WrappedPhase& fringes,
                              const GrayCodeCheckOptions& options) {
  const Pattern& code = gray.pattern;
  constexpr int kMaxFrames = 64;  // bits of CodedPixel::bright
  require(static_cast<int>(gray.frames.size()) == code.frame_count() &&
              code.frame_count() <= kMaxFrames,
          "check_gray_code: the number of frames differs from the pattern");
  SequenceCheck out;
  out.patterns = {code.name, fringes.pattern.name};
  const GrayCodeSample sample(
      sample_code(gray, fringes, options), gray.frames.size(), fringes.pattern.period_px, options);
  if (sample.pixels.size() < options.min_pixels) return out;
  const double declared = sample.score(declared_trial(code));
  out.decided = true;
  out.agreement = declared;
  const bool agrees = declared >= options.min_agreement;
  const GrayCodeSample::Start start = sample.start_offset(declared_trial(code));
  if (agrees && !start.scattered) {
    const bool few = fringes.pattern.shifts_rad.size() <= 3;
    const double allowed = few ? options.max_start_three_rad : options.max_start_rad;
    if (!(std::abs(start.offset_rad) > allowed)) return out;
    out.consistent = false;
    out.fits.push_back(start_fault(fringes.pattern, start.offset_rad));
    return out;
  }
  std::vector<SequenceFault> scales = other_scales(sample, code, fringes.pattern, options);
  if (agrees && scales.empty()) return out;
  out.consistent = false;
  std::vector<GrayTrial> trials = gray_trials(code, fringes.pattern);
  double best = std::max(options.min_agreement, declared + options.min_gain);
  std::vector<std::pair<double, SequenceFault>> found;
  for (GrayTrial& trial : trials) {
    const double score = sample.score(trial);
    best = std::max(best, score);
    found.emplace_back(score, std::move(trial.fault));
  }
  if (!agrees) {
    for (auto& [score, fault] : found)
      if (score >= best - options.tie) out.fits.push_back(std::move(fault));
  }
  if (out.fits.empty()) out.fits = std::move(scales);
  if (out.fits.empty()) add_missing_frames(sample, code, out);
  return out;
}

}  // namespace frangia
