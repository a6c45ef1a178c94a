#include "frangia/pipeline/decode_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "frangia/phase/check_indirect_light.h"
#include "frangia/phase/decode_gray_alone.h"
#include "frangia/phase/decode_sequence.h"
#include "frangia/phase/estimate_noise.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/frame_samples.h"
#include "frangia/phase/systematic_phase.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/pipeline/internal/correct_view_orders.h"
#include "frangia/pipeline/internal/fringe_directions.h"
#include "frangia/pipeline/internal/select_stacks.h"
#include "frangia/pipeline/internal/unwrap_direction.h"
#include "frangia/pipeline/internal/wrap_pattern.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

/// The camera's noise: from rig.toml, else from the survey of several views, else from this view.
/// Lossy compression adds its own.
NoiseModel noise_of(std::span<const FrameStack> stacks,
                    const Rig& rig,
                    const DecodeOptions& options) {
  NoiseModel noise = rig.camera.noise       ? *rig.camera.noise
                     : options.survey.noise ? *options.survey.noise
                                            : estimate_noise(stacks);
  noise.floor_counts2 += stacks.front().compression_counts2;
  return noise;
}

/// Whether several patterns have unwrapping levels that are all safe for each single pixel that
/// wrapping keeps.
bool is_pixelwise_safe(std::span<const Pattern> patterns,
                       const Projector& projector,
                       const DecodeOptions& options) {
  constexpr double kMaxWrongOrder = 1e-6;  // probability per pixel
  return patterns.size() > 1 &&
         is_safe(
             find_unwrap_levels(patterns, projector), options.wrap.max_sigma_rad, kMaxWrongOrder);
}

/// The systematic uncertainty of the slope of phase over frequency through all maps, whose
/// modulations are taken as equal.
SystematicPhase sequence_systematic(std::span<const FrameStack* const> fringes,
                                    std::span<const FittedAlgorithm> fits) {
  const double top = fringes.back()->pattern.fringes_per_unit();
  double weights = 0.0;
  double square = 0.0;
  double differing = 0.0;
  for (std::size_t m = 0; m < fits.size(); ++m) {
    const double ratio = fringes[m]->pattern.fringes_per_unit() / top;
    const double weight = ratio / std::pow(fits[m].algorithm.noise_gain, 2);
    weights += weight * ratio;
    const SystematicPhase part = systematic_phase(fits[m]);
    square += std::pow(weight * part.rad, 2);
    differing += std::pow(weight * part.rad, 2) * part.differing_share;
  }
  if (square == 0.0) return {};
  return {std::sqrt(square) / weights, differing / square};
}

/// Decodes all patterns in one pass; the assessments are computed from a sample of rows.
void decode_in_one_pass(std::span<const FrameStack* const> fringes,
                        std::span<const FittedAlgorithm> fits,
                        const Rig& rig,
                        const DecodeOptions& options,
                        DecodedView& out) {
  constexpr std::size_t kAssessedPixels = 200'000;
  std::vector<SequenceFrames> maps;
  for (std::size_t m = 0; m < fringes.size(); ++m) {
    const FrameStack* stack = fringes[m];
    const FittedAlgorithm& fitted = fits[m];
    const FrameStack some = sample_rows(*stack, kAssessedPixels);
    const WrappedPhase map = wrap_phase(some, fitted.algorithm, out.noise, options.wrap);
    out.assessments.push_back(assess_frames(some, fitted, map, out.noise));
    maps.push_back({stack, fitted.algorithm});
  }
  out.checks = {
      check_sequence(maps, out.noise, rig.projector, options.wrap, options.sequence_check)};
  out.phase = decode_sequence(maps, out.noise, rig.projector, {options.wrap, options.temporal});
  const SystematicPhase systematic = sequence_systematic(fringes, fits);
  out.phase.systematic_rad = uniform_systematic(systematic.rad, out.phase.status);
  out.phase.differing_share = static_cast<float>(systematic.differing_share);
}

bool are_unprocessed_frames(std::span<const FrameStack* const> fringes,
                            std::span<const FittedAlgorithm> fits,
                            const DecodeOptions& options) {
  const bool has_harmonics = std::any_of(fits.begin(), fits.end(), [](const FittedAlgorithm& fit) {
    return fit.waveform.largest_harmonic() > 0;
  });
  return !options.own.any() && !options.recover_saturated && !options.response &&
         options.waveforms.empty() && !(options.undo_own_response && has_harmonics) &&
         std::all_of(fringes.begin(), fringes.end(), [](const FrameStack* stack) {
           return stack->pattern.exposure_count() == 1;
         });
}

/// Decodes the Gray code of one direction of a scan without fringes.
DecodedView decode_code_alone(std::span<const FrameStack> stacks,
                              FringeDirection direction,
                              const Rig& rig,
                              const DecodeOptions& options,
                              const Run& run) {
  const auto gray = gray_of(stacks, direction);
  const auto find = [&](PatternKind kind) -> const FrameStack* {
    const auto found = std::find_if(stacks.begin(), stacks.end(), [&](const FrameStack& stack) {
      return stack.pattern.kind == kind;
    });
    return found == stacks.end() ? nullptr : &*found;
  };
  run.check();
  DecodedView out;
  out.noise = rig.camera.noise ? *rig.camera.noise : estimate_gray_noise(gray.front());
  out.noise.floor_counts2 += stacks.front().compression_counts2;
  Image<float> threshold;
  if (gray.front().pattern.inverted == InvertedFrames::None)
    threshold = gray_threshold(gray.front(), find(PatternKind::White), find(PatternKind::Ambient));
  GrayAloneOptions limits;
  limits.max_wrong_stripe = options.temporal.max_wrong_order;
  out.phase = decode_gray_alone(gray, threshold, out.noise, limits);
  out.coarsest = out.phase.pattern;
  return out;
}

/// Decodes the fringes of one direction.
DecodedView decode_direction(std::span<const FrameStack> stacks,
                             FringeDirection direction,
                             const Rig& rig,
                             const Image<Eigen::Vector2f>& rays,
                             const DecodeOptions& options,
                             const Run& run) {
  const auto fringes = fringes_of(stacks, direction);
  if (fringes.empty()) return decode_code_alone(stacks, direction, rig, options, run);
  DecodedView out;
  out.noise = noise_of(stacks, rig, options);
  out.coarsest = fringes.front()->pattern;
  const auto patterns = patterns_of(fringes);
  const auto gray = gray_of(stacks, out.coarsest.direction);
  const bool pixelwise_safe = gray.empty() && is_pixelwise_safe(patterns, rig.projector, options);
  const std::vector<FittedAlgorithm> fits = fit_all(fringes, out.noise, options, run);
  if (pixelwise_safe && !options.keep_maps && are_unprocessed_frames(fringes, fits, options)) {
    decode_in_one_pass(fringes, fits, rig, options, out);
    correct_view_orders(fringes, fits, options, run, out);
    fill_enclosed(out.phase, options.fill);
    return out;
  }
  const bool unwraps_temporally =
      gray.empty() && !pixelwise_safe && is_absolute(out.coarsest, rig.projector);
  std::vector<SequenceFrames> maps;
  for (std::size_t m = 0; m < fringes.size(); ++m) {
    run.check();
    wrap_pattern(*fringes[m], fits[m], options, run, out);
    maps.push_back({fringes[m], fits[m].algorithm});
    if (options.keep_maps || !unwraps_temporally || options.own.any()) continue;
    // Only the assessment needs them; the next pattern uses their memory.
    out.wrapped.back().modulation_counts = {};
    out.wrapped.back().mean_counts = {};
  }
  out.checks = {
      check_sequence(maps, out.noise, rig.projector, options.wrap, options.sequence_check)};
  unwrap_direction({stacks, gray, rig, rays, unwraps_temporally}, options, run, out);
  if (gray.empty() && fringes.size() > 1 && !out.relative && !options.own.any())
    correct_view_orders(fringes, fits, options, run, out);
  if (options.keep_maps && out.checks.front().consistent && !out.relative) {
    const IndirectLightCheck indirect = check_indirect_light(out.wrapped, out.phase);
    if (indirect.found) run.warn(describe(indirect));
  }
  if (!options.keep_maps) out.wrapped.clear();
  fill_enclosed(out.phase, options.fill);
  return out;
}

}  // namespace

bool has_absolute_phase(std::span<const Pattern> patterns, const Projector& projector) {
  const bool line = std::any_of(patterns.begin(), patterns.end(), [](const Pattern& pattern) {
    return pattern.kind == PatternKind::Line;
  });
  return line || is_absolute_direction(patterns, FringeDirection::Vertical, projector) ||
         is_absolute_direction(patterns, FringeDirection::Horizontal, projector);
}

DecodeOptions options_of_view(const DecodeOptions& options, std::size_t view) {
  DecodeOptions out = options;
  if (out.phase_files) out.own = stages_from_files(*out.phase_files, view);
  return out;
}

DecodedView decode_view(std::span<const FrameStack> stacks,
                        const Rig& rig,
                        const Image<Eigen::Vector2f>& rays,
                        const DecodeOptions& options,
                        const Run& run) {
  std::vector<Pattern> patterns;
  for (const FrameStack& stack : stacks)
    patterns.push_back(stack.pattern);
  const auto directions = directions_to_decode(patterns, rig.projector, options.directions);
  DecodedView out = decode_direction(stacks, directions.front(), rig, rays, options, run);
  if (directions.size() == 1) return out;
  DecodedView second = decode_direction(stacks, directions.back(), rig, rays, options, run);
  out.second_phase = std::move(second.phase);
  out.checks.insert(out.checks.end(), second.checks.begin(), second.checks.end());
  std::move(out.wrapped.begin(), out.wrapped.end(), std::back_inserter(second.wrapped));
  out.wrapped = std::move(second.wrapped);
  out.assessments.insert(
      out.assessments.begin(), second.assessments.begin(), second.assessments.end());
  return out;
}

}  // namespace frangia
