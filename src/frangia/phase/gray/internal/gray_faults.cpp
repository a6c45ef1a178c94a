#include "frangia/phase/gray/internal/gray_faults.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

double max_start_of(const Pattern& fringes, const GrayCodeCheckOptions& options) {
  return fringes.shifts_rad.size() <= 3 ? options.max_start_three_rad : options.max_start_rad;
}

bool passes(const GrayCodeSample& sample,
            const GrayTrial& trial,
            const Pattern& fringes,
            const GrayCodeCheckOptions& options) {
  const GrayCodeSample::Start start = sample.start_offset(trial);
  return !start.scattered &&
         std::abs(wrap_rad(start.offset_rad - trial.start_rad)) <= max_start_of(fringes, options) &&
         sample.score(trial) >= options.min_agreement;
}

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

std::vector<GrayTrial> scale_trials(const GrayCodeSample& sample,
                                    const Pattern& code,
                                    const Pattern& fringes,
                                    const GrayCodeCheckOptions& options) {
  std::vector<GrayTrial> out;
  for (const double factor : {2.0, 0.5, 4.0, 0.25}) {
    GrayTrial trial = declared_trial(code, fringes);
    trial.code.stripe_px *= factor;
    if (!passes(sample, trial, fringes, options)) continue;
    trial.fault.kind = SequenceFaultKind::Period;
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
      !passes(sample, other, fringes, options))
    return out;
  other.fault.patterns = {fringes.name};
  other.fault.kind = SequenceFaultKind::Period;
  other.fault.what =
      fmt::format("a period of {:.6g} px, not {:.6g} px", other.period_px, fringes.period_px);
  other.fault.keys = fmt::format("period_px = {:.6g}", other.period_px);
  out.push_back(std::move(other));
  return out;
}

std::vector<GrayTrial> start_trials(const GrayCodeSample& sample,
                                    const Pattern& code,
                                    const Pattern& fringes,
                                    double start_rad,
                                    const GrayCodeCheckOptions& options) {
  GrayTrial trial = declared_trial(code, fringes);
  trial.start_rad = start_rad;
  if (!passes(sample, trial, fringes, options)) return {};
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

}  // namespace frangia
