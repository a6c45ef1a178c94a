#include "frangia/phase/gray/check_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/gray/internal/gray_code_sample.h"
#include "frangia/phase/gray/internal/gray_trials.h"

namespace frangia {
namespace {

/// Shares that differ by less are equal.
constexpr double kTie = 0.03;

/// The same for three frames, which harmonics affect more.
constexpr double kMaxStartThree_rad = 0.45;

/// Start of the fringes at the borders of the stripes that a sound code may show: blur and
/// harmonics move borders and phases. Half a projector pixel is 0.2 for fringes of 16 px.
constexpr double kMaxStart_rad = 0.25;

/// Largest start of the fringes at the borders of the stripes that a sound code may show.
double max_start_of(const Pattern& fringes) {
  return fringes.shifts_rad.size() <= 3 ? kMaxStartThree_rad : kMaxStart_rad;
}

/// Whether code and fringes pass the check with another declaration: they agree, and the fringes
/// begin at the borders of the stripes as it says.
bool passes(const GrayCodeSample& sample,
            const GrayTrial& trial,
            const Pattern& fringes,
            const GrayCodeCheckOptions& options) {
  const GrayCodeSample::Start start = sample.start_offset(trial);
  return !start.scattered &&
         std::abs(wrap_rad(start.offset_rad - trial.start_rad)) <= max_start_of(fringes) &&
         sample.score(trial) >= options.min_agreement;
}

/// Frames that show no stripes, or those of the frame before, where the others and the fringes say
/// that they have stripes of their own: they are missing.
std::vector<SequenceFault> missing_frames(const GrayCodeSample& sample,
                                          const Pattern& code,
                                          const Pattern& fringes) {
  constexpr double kContradicted = 0.02;  // wrong codes at edges and of saturated pixels are fewer
  std::vector<SequenceFault> out;
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(code.frame_count()); ++frame) {
    const bool repeats = frame > 0 && sample.are_equal(frame, frame - 1);
    if (!repeats && !sample.is_blank(frame)) continue;
    if (sample.contradiction_of(declared_trial(code, fringes), frame) < kContradicted) continue;
    out.push_back({SequenceFaultKind::Missing,
                   {code.name},
                   repeats
                       ? fmt::format("a missing frame: frame {} repeats frame {}", frame, frame - 1)
                       : fmt::format("a missing frame: frame {} shows no stripes", frame),
                   {},
                   fmt::format("capture {}-{}.png again", code.name, frame)});
  }
  return out;
}

/// Widths of the stripes and periods of the fringes with which the fringes lie at the borders of
/// the stripes where they should.
std::vector<SequenceFault> other_scales(const GrayCodeSample& sample,
                                        const Pattern& code,
                                        const Pattern& fringes,
                                        const GrayCodeCheckOptions& options) {
  std::vector<SequenceFault> fits;
  for (const double factor : {2.0, 0.5, 4.0, 0.25}) {
    GrayTrial trial = declared_trial(code, fringes);
    trial.code.stripe_px *= factor;
    if (!passes(sample, trial, fringes, options)) continue;
    fits.push_back(
        {SequenceFaultKind::Period,
         {code.name},
         fmt::format("stripes of {:g} px, not {:g} px", trial.code.stripe_px, code.stripe_px),
         {},
         fmt::format("stripe_px = {:g}", trial.code.stripe_px)});
    break;
  }
  const double period_px = sample.shown_period_px(declared_trial(code, fringes));
  GrayTrial other = declared_trial(code, fringes);
  other.period_px = period_px;
  if (period_px > 0.0 && std::abs(period_px - fringes.period_px) > 1e-3 * fringes.period_px &&
      passes(sample, other, fringes, options)) {
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
  const GrayCodeSample sample(gray, fringes, options);
  if (sample.pixels.size() < options.min_pixels) return out;
  const Pattern& shown = fringes.pattern;
  const GrayTrial as_declared = declared_trial(code, shown);
  const double declared = sample.score(as_declared);
  out.decided = true;
  out.agreement = declared;
  const bool agrees = declared >= options.min_agreement;
  const GrayCodeSample::Start start = sample.start_offset(as_declared);
  std::vector<SequenceFault> missing = missing_frames(sample, code, shown);
  if (agrees && !missing.empty()) {
    out.consistent = false;
    out.fits = std::move(missing);
    return out;
  }
  if (agrees && !start.scattered) {
    if (!(std::abs(start.offset_rad) > max_start_of(shown))) return out;
    out.consistent = false;
    GrayTrial later = as_declared;
    later.start_rad = start.offset_rad;
    if (passes(sample, later, shown, options))
      out.fits.push_back(start_fault(shown, start.offset_rad));
    return out;
  }
  std::vector<SequenceFault> scales = other_scales(sample, code, shown, options);
  if (agrees && scales.empty()) return out;
  out.consistent = false;
  std::vector<GrayTrial> trials = gray_trials(code, shown);
  double best = std::max(options.min_agreement, declared + options.min_gain);
  std::vector<std::pair<double, SequenceFault>> found;
  for (GrayTrial& trial : trials) {
    const double score = sample.score(trial);
    best = std::max(best, score);
    found.emplace_back(score, std::move(trial.fault));
  }
  if (!agrees) {
    for (auto& [score, fault] : found)
      if (score >= best - kTie) out.fits.push_back(std::move(fault));
  }
  constexpr double kWhole = 0.9;  // less leaves stripes that the declaration does not explain
  if (!missing.empty() && (out.fits.empty() || best < kWhole)) out.fits = std::move(missing);
  if (out.fits.empty()) out.fits = std::move(scales);
  return out;
}

}  // namespace frangia
