#include "frangia/phase/gray/internal/gray_faults.h"

#include <cmath>
#include <cstddef>

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

}  // namespace frangia
