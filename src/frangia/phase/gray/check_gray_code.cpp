#include "frangia/phase/gray/check_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/gray/internal/gray_code_sample.h"
#include "frangia/phase/gray/internal/gray_trials.h"

namespace frangia {
namespace {

/// Largest start of the fringes at the borders of the stripes that a sound code may show.
double max_start_of(const Pattern& fringes) {
  return fringes.shifts_rad.size() <= 3 ? kGrayCodeLimits.max_start_three_rad
                                        : kGrayCodeLimits.max_start_rad;
}

/// Whether code and fringes pass the check with another declaration: they agree, and the fringes
/// begin at the borders of the stripes as it says.
bool passes(const GrayCodeSample& sample, const GrayTrial& trial, const Pattern& fringes) {
  const GrayCodeSample::Start start = sample.start_offset(trial);
  return !start.scattered &&
         std::abs(wrap_rad(start.offset_rad - trial.start_rad)) <= max_start_of(fringes) &&
         sample.score(trial) >= kGrayCodeLimits.min_agreement;
}

/// Frames that show no stripes, or those of the frame before, where the others and the fringes say
/// that they have stripes of their own: they are missing.
std::vector<GrayTrial> missing_trials(const GrayCodeSample& sample,
                                      const Pattern& code,
                                      const Pattern& fringes) {
  constexpr double kContradicted = 0.02;  // wrong codes at edges and of saturated pixels are fewer
  std::vector<GrayTrial> out;
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(code.frame_count()); ++frame) {
    const bool repeats = frame > 0 && sample.are_equal(frame, frame - 1);
    if (!repeats && !sample.is_blank(frame)) continue;
    GrayTrial trial = declared_trial(code, fringes);
    if (sample.contradiction_of(trial, frame) < kContradicted) continue;
    trial.missing = frame;
    trial.fault.kind = SequenceFaultKind::Missing;
    trial.fault.what =
        repeats ? fmt::format("a missing frame: frame {} repeats frame {}", frame, frame - 1)
                : fmt::format("a missing frame: frame {} shows no stripes", frame);
    trial.fault.keys = fmt::format("capture {}-{}.png again", code.name, frame);
    out.push_back(trial);
    const std::size_t frames = trial.frame_of.size();
    if (!repeats || frame + 1 == frames) continue;
    // The frames after it may be late, too; then the last one was not captured.
    for (std::size_t k = frame; k + 1 < frames; ++k)
      trial.frame_of[k] = k + 1;
    trial.frame_of.back() = frame;
    trial.fault.what = fmt::format("frames that are late by one from frame {} on", frame);
    trial.fault.keys = "capture the frames again";
    out.push_back(std::move(trial));
  }
  return out;
}

/// Widths of the stripes and periods of the fringes with which the fringes lie at the borders of
/// the stripes where they should.
std::vector<GrayTrial> scale_trials(const GrayCodeSample& sample,
                                    const Pattern& code,
                                    const Pattern& fringes) {
  std::vector<GrayTrial> out;
  for (const double factor : {2.0, 0.5, 4.0, 0.25}) {
    GrayTrial trial = declared_trial(code, fringes);
    trial.code.stripe_px *= factor;
    if (!passes(sample, trial, fringes)) continue;
    trial.fault.kind = SequenceFaultKind::Period;
    trial.fault.scale = factor;
    trial.fault.what =
        fmt::format("stripes of {:g} px, not {:g} px", trial.code.stripe_px, code.stripe_px);
    trial.fault.keys = fmt::format("stripe_px = {:g}", trial.code.stripe_px);
    out.push_back(std::move(trial));
    break;
  }
  GrayTrial other = declared_trial(code, fringes);
  other.period_px = sample.shown_period_px(other);
  if (!(other.period_px > 0.0) ||
      std::abs(other.period_px - fringes.period_px) <= 1e-3 * fringes.period_px ||
      !passes(sample, other, fringes))
    return out;
  other.fault.patterns = {fringes.name};
  other.fault.kind = SequenceFaultKind::Period;
  other.fault.scale = other.period_px / fringes.period_px;
  other.fault.what =
      fmt::format("a period of {:.6g} px, not {:.6g} px", other.period_px, fringes.period_px);
  other.fault.keys = fmt::format("period_px = {:.6g}", other.period_px);
  out.push_back(std::move(other));
  return out;
}

/// The fringes began at another phase than declared, if code and fringes pass with it.
std::vector<GrayTrial> start_trials(const GrayCodeSample& sample,
                                    const Pattern& code,
                                    const Pattern& fringes,
                                    double start_rad) {
  GrayTrial trial = declared_trial(code, fringes);
  trial.start_rad = start_rad;
  if (!passes(sample, trial, fringes)) return {};
  const double declared_deg = deg_from_rad(fringes.shifts_rad.front());
  const double start_deg = std::round(declared_deg + deg_from_rad(start_rad));
  trial.fault = {SequenceFaultKind::Start,
                 {fringes.name},
                 fmt::format("a start of {:g} degrees, not {:g} degrees",
                             start_deg - 360.0 * std::floor(start_deg / 360.0),
                             declared_deg),
                 {},
                 "by the Gray code"};
  trial.fault.shifts_rad = fringes.shifts_rad;
  for (double& shift : trial.fault.shifts_rad)
    shift += rad_from_deg(start_deg - declared_deg);
  return {std::move(trial)};
}

/// Adds the declarations that fit best, all of those that fit equally well.
void add_best(const GrayCodeSample& sample,
              std::vector<GrayTrial> trials,
              double least,
              double tie,
              SequenceCheck& out) {
  std::vector<double> scores;
  for (const GrayTrial& trial : trials)
    scores.push_back(sample.score(trial));
  double best = least;
  for (const double score : scores)
    best = std::max(best, score);
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (scores[i] >= best - tie) out.fits.push_back(std::move(trials[i].fault));
  if (!out.fits.empty()) out.fitted_agreement = best;
}

}  // namespace

SequenceCheck check_gray_code(const FrameStack& gray, const WrappedPhase& fringes) {
  const Pattern& code = gray.pattern;
  constexpr int kMaxFrames = 64;  // bits of CodedPixel::bright
  require(static_cast<int>(gray.frames.size()) == code.frame_count() &&
              code.frame_count() <= kMaxFrames,
          "check_gray_code: the number of frames differs from the pattern");
  SequenceCheck out;
  out.patterns = {code.name, fringes.pattern.name};
  const GrayCodeSample sample(gray, fringes);
  if (sample.pixels.size() < kGrayCodeLimits.min_pixels) return out;
  const Pattern& shown = fringes.pattern;
  const GrayTrial as_declared = declared_trial(code, shown);
  out.decided = true;
  out.agreement = sample.score(as_declared);
  const bool agrees = out.agreement >= kGrayCodeLimits.min_agreement;
  const GrayCodeSample::Start start = sample.start_offset(as_declared);
  const bool begins_elsewhere =
      agrees && !start.scattered && std::abs(start.offset_rad) > max_start_of(shown);
  std::vector<GrayTrial> trials = missing_trials(sample, code, shown);
  const bool misses = !trials.empty();
  const auto add = [&](std::vector<GrayTrial> more) {
    std::move(more.begin(), more.end(), std::back_inserter(trials));
  };
  if (begins_elsewhere) add(start_trials(sample, code, shown, start.offset_rad));
  if (!agrees || start.scattered) add(scale_trials(sample, code, shown));
  if (agrees && trials.empty() && !begins_elsewhere) return out;
  if (!agrees) add(gray_trials(code, shown));
  out.consistent = false;
  const double gain = agrees ? 0.0 : kGrayCodeLimits.min_gain;
  const double least = std::max(kGrayCodeLimits.min_agreement, out.agreement + gain);
  add_best(sample, std::move(trials), least, kGrayCodeLimits.tie, out);
  // A frame that is missing is no other fault of a code that agrees without it.
  if (agrees && misses && out.fits.empty()) out.consistent = true;
  return out;
}

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
