#include "frangia/phase/gray/check_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/phase/gray/internal/gray_code_sample.h"
#include "frangia/phase/gray/internal/gray_faults.h"
#include "frangia/phase/gray/internal/gray_trials.h"

namespace frangia {
namespace {

/// The declarations that fit best, all of those that fit equally well.
std::vector<SequenceFault> best_of(const GrayCodeSample& sample,
                                   std::vector<GrayTrial> trials,
                                   double least,
                                   double tie) {
  std::vector<double> scores;
  for (const GrayTrial& trial : trials)
    scores.push_back(sample.score(trial));
  double best = least;
  for (const double score : scores)
    best = std::max(best, score);
  std::vector<SequenceFault> fits;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (scores[i] >= best - tie) fits.push_back(std::move(trials[i].fault));
  return fits;
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
  out.decided = true;
  out.agreement = sample.score(as_declared);
  const bool agrees = out.agreement >= options.min_agreement;
  const GrayCodeSample::Start start = sample.start_offset(as_declared);
  const bool begins_elsewhere =
      agrees && !start.scattered && std::abs(start.offset_rad) > max_start_of(shown, options);
  std::vector<GrayTrial> trials = missing_trials(sample, code, shown);
  const bool misses = !trials.empty();
  const auto add = [&](std::vector<GrayTrial> more) {
    std::move(more.begin(), more.end(), std::back_inserter(trials));
  };
  if (begins_elsewhere) add(start_trials(sample, code, shown, start.offset_rad, options));
  if (!agrees || start.scattered) add(scale_trials(sample, code, shown, options));
  if (agrees && trials.empty() && !begins_elsewhere) return out;
  if (!agrees) add(gray_trials(code, shown));
  out.consistent = false;
  const double gain = agrees ? 0.0 : options.min_gain;
  const double least = std::max(options.min_agreement, out.agreement + gain);
  out.fits = best_of(sample, std::move(trials), least, options.tie);
  // A frame that is missing is no other fault of a code that agrees without it.
  if (agrees && misses && out.fits.empty()) out.consistent = true;
  return out;
}

}  // namespace frangia
