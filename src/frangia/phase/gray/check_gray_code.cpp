#include "frangia/phase/gray/check_gray_code.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/phase/gray/internal/gray_code_sample.h"
#include "frangia/phase/gray/internal/gray_faults.h"
#include "frangia/phase/gray/internal/gray_trials.h"

namespace frangia {

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
    if (!(std::abs(start.offset_rad) > max_start_of(shown, options))) return out;
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
      if (score >= best - options.tie) out.fits.push_back(std::move(fault));
  }
  constexpr double kWhole = 0.9;  // less leaves stripes that the declaration does not explain
  if (!missing.empty() && (out.fits.empty() || best < kWhole)) out.fits = std::move(missing);
  if (out.fits.empty()) out.fits = std::move(scales);
  return out;
}

}  // namespace frangia
