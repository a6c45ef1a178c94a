#include "frangia/decode/internal/wrap_pattern.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "frangia/decode/select_stacks.h"
#include "frangia/phase/waveform/contradicting_frames.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/phase/waveform/share_waveforms.h"
#include "frangia/phase/waveform/systematic_phase.h"
#include "frangia/phase/wrap/merge_exposures.h"

namespace frangia {
namespace {

/// The algorithm for one pattern's frames.
FittedAlgorithm fit(const FrameStack& taken,
                    const NoiseModel& noise,
                    const DecodeOptions& options,
                    const Run& run) {
  if (options.own_algorithm) return fit_algorithm(*options.own_algorithm, taken, noise);
  Run warnings = run;  // no notes: the frame assessment names the algorithm
  warnings.on_note = nullptr;
  std::optional<double> gain_error;
  const auto known = options.survey.gain_error.find(taken.pattern.name);
  if (known != options.survey.gain_error.end()) gain_error = known->second;
  return fit_algorithm(options.algorithm, taken, noise, warnings, gain_error);
}

/// The algorithm of a map that was merged from several exposures; its shifts are those that were
/// fitted.
FittedAlgorithm algorithm_of(const Pattern& pattern, const FittedAlgorithm& fitted) {
  FittedAlgorithm used = fitted;
  if (pattern.exposure_count() == 1) return used;
  used.algorithm = least_squares(fitted.shifts_rad);
  used.algorithm.name = fitted.algorithm.name;
  used.waveform.count_gains();  // its weights compensate none
  return used;
}

/// Removes the effect of the projector's response from the last wrapped map, where the options ask
/// for it, and sets its systematic uncertainty.
void finish_wrapped(const FittedAlgorithm& of_frames,
                    const DecodeOptions& options,
                    DecodedDirection& out) {
  WrappedPhase& map = out.wrapped.back();
  if (options.own.wrap && !map.systematic_rad.empty()) return;
  const FittedAlgorithm fitted = algorithm_of(map.pattern, of_frames);
  const auto table = correction_of(map.pattern, of_frames, options);
  if (table) correct_response(*table, map);
  const ResponseTable* applied = table ? &*table : nullptr;
  const SystematicPhase systematic = systematic_phase(fitted, applied);
  map.systematic_rad = uniform_systematic(systematic.rad, map.status);
  map.differing_share = static_cast<float>(systematic.differing_share);
  FrameAssessment& assessment = out.assessments.back();
  assessment.harmonics_corrected = table.has_value();
  assessment.harmonic_error_rad = harmonic_phase_error(fitted, applied);
  // Of merged exposures it is counted, whatever their frames could compensate.
  assessment.flicker = fitted.waveform.flicker();
  assessment.flicker_error_rad = fitted.waveform.flicker_error_rad;
  assessment.is_flicker = fitted.waveform.is_flicker;
}

/// Adds to sigma, pixel by pixel, what the frames leave unexplained.
void count_places(const FrameStack& stack,
                  const FittedAlgorithm& fitted,
                  const DecodeOptions& options,
                  const Run& run,
                  DecodedDirection& out) {
  if (!out.assessments.back().exceeds_noise || options.own.wrap) return;
  WrappedPhase& map = out.wrapped.back();
  const Image<float> unexplained_rad = unexplained_phase(stack, fitted, out.noise);
  const double discarded =
      count_unexplained(unexplained_rad,
                        {fitted.unexplained_rad, options.wrap.max_sigma_rad},
                        {map.phase_rad, map.sigma_rad, map.status, map.systematic_rad});
  const std::string warning =
      describe_contradicting(stack.pattern.name,
                             discarded,
                             place_of_unexplained(unexplained_rad, options.wrap.max_sigma_rad));
  if (warning.empty()) return;
  run.warn(warning);
  if (out.check && out.check->consistent && out.check->finding.empty())
    out.check->finding = warning;
}

/// The wrapped phase that the caller's function finds.
WrappedPhase own_wrapped(const FrameStack& stack,
                         const FittedAlgorithm& fitted,
                         const NoiseModel& noise,
                         const DecodeOptions& options) {
  WrappedPhase map = options.own.wrap(stack, fitted, noise);
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const auto fits = [&](const auto& image) {
    return image.width() == width && image.height() == height;
  };
  if (!fits(map.phase_rad) || !fits(map.sigma_rad) || !fits(map.modulation_counts) ||
      !fits(map.mean_counts) || !fits(map.status)) {
    throw Error(
        ErrorKind::Input,
        fmt::format(
            "your own wrapping function returned images of {} x {} pixels for pattern \"{}\"; "
            "return them in the size of the frames, {} x {}",
            map.phase_rad.width(),
            map.phase_rad.height(),
            stack.pattern.name,
            width,
            height));
  }
  map.pattern = stack.pattern;
  return map;
}

}  // namespace

bool undoes_own_response(const DecodeOptions& options) {
  return options.undo_own_response && !options.response && options.waveforms.empty() &&
         !options.own.wrap;
}

std::optional<ResponseTable> correction_of(const Pattern& pattern,
                                           const FittedAlgorithm& of_frames,
                                           const DecodeOptions& options) {
  const FittedAlgorithm fitted = algorithm_of(pattern, of_frames);
  const PhaseAlgorithm& algorithm = fitted.algorithm;
  const std::vector<double>& shifts = fitted.shifts_rad;
  if (const FringeWaveform* waveform = find_waveform(options.waveforms, pattern))
    return response_table(*waveform, algorithm, shifts, fitted.waveform.gains);
  if (options.response)
    return response_table(*options.response, algorithm, shifts, fitted.waveform.gains);
  if (!undoes_own_response(options)) return {};
  return own_correction(fitted);
}

std::vector<FittedAlgorithm> fit_all(std::span<const FrameStack* const> fringes,
                                     const NoiseModel& noise,
                                     const DecodeOptions& options,
                                     const Run& run) {
  std::vector<FittedAlgorithm> fits;
  for (const FrameStack* stack : fringes) {
    run.check();
    fits.push_back(fit(*stack, noise, options, run));
  }
  share_waveforms(fits);
  return fits;
}

void wrap_pattern(const FrameStack& taken,
                  const FittedAlgorithm& fitted,
                  const DecodeOptions& options,
                  const Run& run,
                  DecodedDirection& out) {
  if (taken.pattern.exposure_count() > 1 && !options.own.wrap) {
    out.wrapped.push_back(
        merge_exposures(exposures_of(&taken), fitted.shifts_rad, out.noise, options.wrap));
    out.assessments.push_back(assess_frames(taken, fitted, out.wrapped.back(), out.noise));
    finish_wrapped(fitted, options, out);
    return;
  }
  FrameStack recovered;
  if (options.recover_saturated) {
    recovered = taken;
    const std::size_t pixels = recover_saturated(recovered);
    run.note(fmt::format(
        "pattern \"{}\": one saturated frame of {} pixels recovered", taken.pattern.name, pixels));
  }
  const FrameStack& stack = options.recover_saturated ? recovered : taken;
  out.wrapped.push_back(options.own.wrap
                            ? own_wrapped(stack, fitted, out.noise, options)
                            : wrap_phase(stack, fitted.algorithm, out.noise, options.wrap));
  out.assessments.push_back(assess_frames(stack, fitted, out.wrapped.back(), out.noise));
  finish_wrapped(fitted, options, out);
  count_places(stack, fitted, options, run, out);
}

}  // namespace frangia
