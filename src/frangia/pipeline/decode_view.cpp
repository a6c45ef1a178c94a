// Above 250 lines: the ways from frames to an absolute phase, side by side.
#include "frangia/pipeline/decode_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "frangia/fringe_order/check_start_by_sheet.h"
#include "frangia/phase/check_gray_code.h"
#include "frangia/phase/check_indirect_light.h"
#include "frangia/phase/decode_gray_alone.h"
#include "frangia/phase/decode_gray_code.h"
#include "frangia/phase/decode_sequence.h"
#include "frangia/phase/estimate_noise.h"
#include "frangia/phase/fit_algorithm.h"
#include "frangia/phase/frame_samples.h"
#include "frangia/phase/systematic_phase.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/phase/unwrap_sequence.h"
#include "frangia/pipeline/internal/fringe_directions.h"
#include "frangia/pipeline/internal/select_stacks.h"
#include "frangia/pipeline/internal/wrap_pattern.h"
#include "frangia/range/check_orientation.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/has_geometry.h"
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

/// Distance at which the camera's axis crosses the centre of the projected field: x0 of the paper.
double crossing_distance(const Pattern& pattern, const Rig& rig) {
  const double middle = phase_range(pattern, rig.projector).center_rad();
  return intersect_fringe({0.0, 0.0}, middle, pattern, rig.projector).depth_mm;
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

/// The fringe orders of a spatially unwrapped phase: from the laser sheet, from the distance, or
/// none for a rig without geometry.
ResolvedPhase resolve_orders(std::span<const FrameStack> stacks,
                             const Rig& rig,
                             const Image<Eigen::Vector2f>& rays,
                             const DecodeOptions& options,
                             const Run& run,
                             DecodedView& out) {
  RelativePhase& relative = *out.relative;
  if (!has_geometry(rig)) {
    run.warn(
        "the patterns do not determine fringe orders, and the rig has no geometry that does: the "
        "phase of each region has an offset of its own");
    return {{relative.pattern,
             relative.phase_rad,
             relative.sigma_rad,
             relative.status,
             relative.systematic_rad},
            {}};
  }
  const FrameStack* line = line_of(stacks);
  if (line == nullptr) {
    return resolve_by_distance(relative, rig, rays, crossing_distance(relative.pattern, rig));
  }
  out.profile = laser_profile(*line, out.wrapped.front().mean_counts, rig, out.noise, options.line);
  const SequenceCheck start = check_start_by_sheet(out.wrapped.front(), out.profile, rig.projector);
  if (!start.consistent) out.checks = {start};
  return resolve_by_laser_sheet(relative, out.profile, rig.projector, options.fringe_order);
}

/// Uses the rig where the frames do not decide between shifts in the opposite direction and other
/// suppositions: the direction in which the measured phase rises shows which it is.
void decide_by_orientation(const WrappedPhase& fringes,
                           const Rig& rig,
                           const Image<Eigen::Vector2f>& rays,
                           SequenceCheck& check) {
  if (check.fits.size() < 2 || !has_geometry(rig)) return;
  const OrientationCheck found = check_orientation(
      {fringes.pattern, fringes.phase_rad, fringes.sigma_rad, fringes.status}, rig, rays);
  if (!found.decided) return;
  const auto contradicts = [&](const SequenceFault& fault) {
    return (fault.kind == SequenceFaultKind::Direction) == found.consistent;
  };
  if (!std::all_of(check.fits.begin(), check.fits.end(), contradicts))
    std::erase_if(check.fits, contradicts);
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

/// The absolute phase that the caller's function finds.
AbsolutePhase own_unwrapped(std::span<const WrappedPhase> maps, const DecodeOptions& options) {
  AbsolutePhase phase = options.own.unwrap(maps);
  const Image<float>& size = maps.back().phase_rad;
  require(same_size(phase.phase_rad, size) && same_size(phase.sigma_rad, size) &&
              same_size(phase.status, size),
          "the phase of your own unwrapping function has another size than its maps; return images "
          "of the size "
          "of the frames");
  phase.pattern = maps.back().pattern;
  if (phase.systematic_rad.empty()) phase.systematic_rad = maps.back().systematic_rad;
  return phase;
}

/// The relative phase that the caller's function finds.
RelativePhase own_unwrapped_spatially(const WrappedPhase& map, const DecodeOptions& options) {
  RelativePhase phase = options.own.unwrap_spatially(map);
  require(
      same_size(phase.phase_rad, map.phase_rad) && same_size(phase.sigma_rad, map.phase_rad) &&
          same_size(phase.region, map.phase_rad) && same_size(phase.status, map.phase_rad),
      "the phase of your own spatial unwrapping has another size than its map; return images of "
      "the size of the frames");
  phase.pattern = map.pattern;
  if (phase.systematic_rad.empty()) phase.systematic_rad = map.systematic_rad;
  return phase;
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
  if (options.own.unwrap) {
    out.phase = own_unwrapped(out.wrapped, options);
  } else if (!gray.empty()) {
    SequenceCheck code = check_gray_code(gray.front(), out.wrapped.front());
    decide_by_orientation(out.wrapped.front(), rig, rays, code);
    if (out.checks.front().consistent) out.checks = {code};
    out.phase = unwrap_finer_levels(
        decode_gray_code(gray, out.wrapped.front(), out.noise, options.temporal),
        std::span(out.wrapped).subspan(1),
        options.temporal);
  } else if (unwraps_temporally) {
    out.phase = options.keep_maps ? unwrap_temporally(out.wrapped, rig.projector, options.temporal)
                                  : unwrap_temporally_in_place(
                                        std::move(out.wrapped), rig.projector, options.temporal);
  } else if (patterns.size() > 1 && determine_absolute_phase(patterns, rig.projector)) {
    out.phase = unwrap_sequence(out.wrapped, rig.projector, options.temporal);
  } else {
    out.relative = options.own.unwrap_spatially
                       ? own_unwrapped_spatially(out.wrapped.front(), options)
                       : unwrap_spatially(out.wrapped.front(), options.spatial);
    ResolvedPhase resolved = resolve_orders(stacks, rig, rays, options, run, out);
    const auto finer = std::span(out.wrapped).subspan(1);
    out.phase = unwrap_finer_levels(std::move(resolved.phase), finer, options.temporal);
    out.unresolved = std::move(resolved.unresolved);
  }
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
