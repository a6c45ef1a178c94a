#include "frangia/decode/survey_scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/phase/algorithm/estimate_step.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/noise_of_view.h"

namespace frangia {
namespace {

constexpr std::size_t kViewsForNoise = 3;
constexpr std::size_t kViewsForGain = 8;

/// The patterns to read: those of a phase shifter, or else the finest fringes.
std::vector<Pattern> patterns_of(const Scan& scan) {
  std::vector<Pattern> shifted;
  const Pattern* finest = nullptr;
  for (const Pattern& pattern : scan.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (pattern.fringes_per_degree > 0.0) shifted.push_back(pattern);
    if (finest == nullptr || pattern.fringes_per_unit() > finest->fringes_per_unit())
      finest = &pattern;
  }
  if (shifted.empty() && finest != nullptr && !scan.rig.reference().noise)
    shifted.push_back(*finest);
  return shifted;
}

/// A share in percent, rounded to three decimals; adding 0 turns -0 into 0.
double rounded_percent(double share) {
  return std::round(1e5 * share) / 1e3 + 0.0;
}

void report_gain(const std::string& pattern,
                 double gain_error,
                 const std::vector<StepEstimate>& views,
                 const Run& run) {
  double found = 0.0;
  for (const StepEstimate& view : views)
    found += view.gain_error() / static_cast<double>(views.size());
  run.note(fmt::format(
      "pattern \"{}\": mean step error {:+.3f} % over {} views; {:+.3f} % is the phase shifter's "
      "gain error and is corrected, the rest is scatter",
      pattern,
      rounded_percent(found),
      views.size(),
      rounded_percent(gain_error)));
}

}  // namespace

ScanSurvey survey_scan(const Scan& scan, const Run& run) {
  ScanSurvey out;
  Scan part = scan;
  part.patterns = patterns_of(scan);
  if (scan.views.size() < 2 || part.patterns.empty()) return out;
  const bool shifter = part.patterns.front().fringes_per_degree > 0.0;
  const std::size_t views = std::min(scan.views.size(), shifter ? kViewsForGain : kViewsForNoise);
  std::vector<NoiseSamples> noise(views);
  std::map<std::string, std::vector<StepEstimate>> steps;
  for (std::size_t i = 0; i < views; ++i) {
    run.check();
    for (const FrameStack& stack : read_frames(part, i * scan.views.size() / views)) {
      noise[i].add(stack);
      if (!shifter || stack.exposure > 0) continue;
      const StepEstimate step = estimate_step(stack);
      if (step.found) steps[stack.pattern.name].push_back(step);
    }
  }
  if (!scan.rig.reference().noise) out.noise = common_noise(noise);
  for (const auto& [pattern, found] : steps) {
    const double gain_error = pooled_gain_error(found);
    out.gain_error[pattern] = gain_error;
    report_gain(pattern, gain_error, found, run);
  }
  return out;
}

}  // namespace frangia
