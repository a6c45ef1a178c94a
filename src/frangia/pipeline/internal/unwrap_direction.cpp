#include "frangia/pipeline/internal/unwrap_direction.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/fringe_order/check_start_by_sheet.h"
#include "frangia/phase/check_gray_code.h"
#include "frangia/phase/decode_gray_code.h"
#include "frangia/phase/phase_algorithm.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/phase/unwrap_sequence.h"
#include "frangia/phase/wrap_phase.h"
#include "frangia/pipeline/internal/select_stacks.h"
#include "frangia/range/check_orientation.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/has_geometry.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

/// Distance at which the camera's axis crosses the centre of the projected field: x0 of the paper.
double crossing_distance(const Pattern& pattern, const Rig& rig) {
  const double middle = phase_range(pattern, rig.projector).center_rad();
  return intersect_fringe({0.0, 0.0}, middle, pattern, rig.projector).depth_mm;
}

/// The fringe orders of a spatially unwrapped phase: from the laser sheet, from the distance, or
/// none for a rig without geometry.
ResolvedPhase resolve_orders(const UnwrapInput& input,
                             const DecodeOptions& options,
                             const Run& run,
                             DecodedView& out) {
  const Rig& rig = input.rig;
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
  const FrameStack* line = line_of(input.stacks);
  if (line == nullptr) {
    return resolve_by_distance(relative, rig, input.rays, crossing_distance(relative.pattern, rig));
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

/// Of several orders of the frames of one pattern that fit, keeps those with which the Gray code
/// agrees: orders that reverse or delay the fringes leave the same residual.
void decide_by_code(const UnwrapInput& input,
                    const Pattern& pattern,
                    const DecodeOptions& options,
                    const NoiseModel& noise,
                    SequenceCheck& check) {
  const auto stack = std::find_if(input.stacks.begin(), input.stacks.end(), [&](const auto& one) {
    return one.pattern.name == pattern.name;
  });
  if (check.consistent || check.fits.size() < 2 || stack == input.stacks.end()) return;
  const auto contradicts = [&](const SequenceFault& fault) {
    if (fault.patterns != std::vector{pattern.name} ||
        fault.shifts_rad.size() != pattern.shifts_rad.size())
      return false;
    FrameStack changed = *stack;
    changed.pattern.shifts_rad = fault.shifts_rad;
    const WrappedPhase map =
        wrap_phase(changed, least_squares(fault.shifts_rad), noise, options.wrap);
    const SequenceCheck code = check_gray_code(input.gray.front(), map);
    return code.decided && !code.consistent;
  };
  std::vector<SequenceFault> fits;
  std::copy_if(
      check.fits.begin(), check.fits.end(), std::back_inserter(fits), [&](const auto& one) {
        return !contradicts(one);
      });
  if (!fits.empty()) check.fits = std::move(fits);
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

}  // namespace

void unwrap_direction(const UnwrapInput& input,
                      const DecodeOptions& options,
                      const Run& run,
                      DecodedView& out) {
  const Rig& rig = input.rig;
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : out.wrapped)
    patterns.push_back(map.pattern);
  if (options.own.unwrap) {
    out.phase = own_unwrapped(out.wrapped, options);
  } else if (!input.gray.empty()) {
    SequenceCheck code = check_gray_code(input.gray.front(), out.wrapped.front());
    decide_by_orientation(out.wrapped.front(), rig, input.rays, code);
    if (out.checks.front().consistent) out.checks = {code};
    decide_by_code(input, out.wrapped.front().pattern, options, out.noise, out.checks.front());
    out.phase = unwrap_finer_levels(
        decode_gray_code(input.gray, out.wrapped.front(), out.noise, options.temporal),
        std::span(out.wrapped).subspan(1),
        options.temporal);
  } else if (input.unwraps_temporally) {
    out.phase = options.keep_maps ? unwrap_temporally(out.wrapped, rig.projector, options.temporal)
                                  : unwrap_temporally_in_place(
                                        std::move(out.wrapped), rig.projector, options.temporal);
  } else if (out.wrapped.size() > 1 && determine_absolute_phase(patterns, rig.projector)) {
    out.phase = unwrap_sequence(out.wrapped, rig.projector, options.temporal);
  } else {
    out.relative = options.own.unwrap_spatially
                       ? own_unwrapped_spatially(out.wrapped.front(), options)
                       : unwrap_spatially(out.wrapped.front(), options.spatial);
    ResolvedPhase resolved = resolve_orders(input, options, run, out);
    const auto finer = std::span(out.wrapped).subspan(1);
    out.phase = unwrap_finer_levels(std::move(resolved.phase), finer, options.temporal);
    out.unresolved = std::move(resolved.unresolved);
  }
}

}  // namespace frangia
