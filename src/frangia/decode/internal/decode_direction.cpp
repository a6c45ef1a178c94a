#include "frangia/decode/internal/decode_direction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/decode/internal/check_code.h"
#include "frangia/decode/internal/judge_direction.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/fringe_order/check_start_by_sheet.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/gray/check_gray_code.h"
#include "frangia/phase/gray/check_gray_neighbours.h"
#include "frangia/phase/gray/decode_gray_alone.h"
#include "frangia/phase/gray/decode_gray_code.h"
#include "frangia/phase/temporal/check_indirect_light.h"
#include "frangia/phase/temporal/correct_order_jumps.h"
#include "frangia/phase/temporal/unwrap_sequence.h"
#include "frangia/phase/waveform/frame_samples.h"
#include "frangia/phase/wrap/merge_exposures.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Corrects regions of a wrong fringe order. The wrapped maps may be gone, so the coarse phases are
/// computed again at the few pixels that matter; a correction of the projector's response is not
/// repeated, as it is far smaller than half a fringe.
void correct_view_orders(std::span<const FrameStack* const> fringes,
                         std::span<const FittedAlgorithm> fits,
                         const DecodeOptions& options,
                         const Run& run,
                         DecodedDirection& out) {
  const auto coarse = [&](std::span<const std::uint32_t> pixels) {
    std::vector<WrappedPhase> maps;
    for (std::size_t m = 0; m + 1 < fringes.size(); ++m) {
      std::vector<FrameStack> some;
      for (const FrameStack& stack : exposures_of(fringes[m]))
        some.push_back(sample_pixels(stack, pixels));
      maps.push_back(some.size() > 1
                         ? merge_exposures(some, fits[m].shifts_rad, out.noise, options.wrap)
                         : wrap_phase(some.front(), fits[m].algorithm, out.noise, options.wrap));
    }
    return maps;
  };
  const OrderJumpResult found = correct_order_jumps(coarse, out.phase, options.order_jumps);
  if (found.corrected + found.discarded == 0) return;
  run.note(
      fmt::format("fringe orders of {} pixels corrected and of {} discarded, at whose border "
                  "the order jumps although all phases are smooth, as indirect light causes it",
                  found.corrected,
                  found.discarded));
}

/// Distance at which the camera's axis crosses the centre of the projected field: x0 of the paper.
double crossing_distance(const Pattern& pattern, const Rig& rig) {
  const double middle = phase_range(pattern, rig.projector).center_rad();
  return intersect_fringe({0.0, 0.0}, middle, pattern, rig.projector).depth_mm;
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

/// Wraps the maps and unwraps the coarsest one in space.
DirectionMaps unwrap_in_space(const DirectionInput& input) {
  DirectionMaps maps = wrap_maps(input, fit_maps(input));
  const WrappedPhase& coarsest = maps.view.wrapped.front();
  maps.view.relative = input.options.own.unwrap_spatially
                           ? own_unwrapped_spatially(coarsest, input.options)
                           : unwrap_spatially(coarsest, input.options.spatial);
  return maps;
}

/// Unwraps the finer maps of a direction by the phase of the coarsest one.
void unwrap_finer(const DirectionInput& input, ResolvedPhase resolved, DecodedDirection& view) {
  view.phase = unwrap_finer_levels(
      std::move(resolved.phase), std::span(view.wrapped).subspan(1), input.options.temporal);
  view.unresolved = std::move(resolved.unresolved);
}

/// Corrects regions of a wrong order that several maps show.
void correct_orders(const DirectionInput& input, DirectionMaps& maps) {
  if (maps.fringes.size() < 2 || input.options.own.any()) return;
  correct_view_orders(maps.fringes, maps.fits, input.options, input.run, maps.view);
}

/// Discards pixels whose Gray code names columns or rows that the stated projector does not have.
AbsolutePhase inside_field(const DirectionInput& input, AbsolutePhase phase) {
  const PhaseRange range = phase_range(phase.pattern, input.rig.projector);
  if (!(range.width_rad() > 0.0)) return phase;
  const double margin = kTwoPi * phase.pattern.fringes_per_unit();  // one pixel of the projector
  for (std::size_t i = 0; i < phase.phase_rad.pixels().size(); ++i) {
    const auto found = static_cast<double>(phase.phase_rad.pixels()[i]);
    if (std::isnan(found) || (found >= range.min_rad - margin && found <= range.max_rad + margin))
      continue;
    phase.phase_rad.pixels()[i] = kMissing;
    phase.sigma_rad.pixels()[i] = kMissing;
    if (!phase.systematic_rad.empty()) phase.systematic_rad.pixels()[i] = kMissing;
    phase.status.pixels()[i] = PixelStatus::OutOfField;
  }
  return phase;
}

/// What is left to do with a phase, wherever its orders come from.
DecodedDirection finished(const DirectionInput& input, DirectionMaps maps) {
  DecodedDirection& view = maps.view;
  if (input.options.keep_maps && view.check->consistent && !view.relative) {
    const IndirectLightCheck indirect = check_indirect_light(view.wrapped, view.phase);
    if (indirect.found) input.run.warn(describe(indirect));
  }
  undo_blur(input, maps);
  if (!input.options.keep_maps) view.wrapped.clear();
  fill_enclosed(view.phase, input.options.fill);
  return std::move(view);
}

DecodedDirection decode_from(const FromCallers& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = wrap_maps(input, fit_maps(input));
  maps.view.phase = own_unwrapped(maps.view.wrapped, input.options);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const FromGrayCode& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = wrap_maps(input, fit_maps(input));
  DecodedDirection& view = maps.view;
  const auto gray = gray_of(input.stacks, input.plan.direction);
  const std::string finding = view.check->finding;
  view.check = check_code(input, gray.front(), view);
  if (view.check->consistent) view.check->finding = finding;
  const WrappedPhase& coarsest = view.wrapped.front();
  unwrap_finer(
      input,
      {inside_field(input, decode_gray_code(gray, coarsest, view.noise, input.options.temporal)),
       {}},
      view);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const FromGrayCodeAlone& /*source*/, const DirectionInput& input) {
  const auto gray = gray_of(input.stacks, input.plan.direction);
  require(!gray.empty(), "decode_view: the frames are not those of the plan's patterns");
  const auto find = [&](PatternKind kind) -> const FrameStack* {
    const auto found = std::find_if(input.stacks.begin(), input.stacks.end(), [&](const auto& one) {
      return one.pattern.kind == kind;
    });
    return found == input.stacks.end() ? nullptr : &*found;
  };
  input.run.check();
  DecodedDirection out;
  out.noise = input.rig.reference().noise ? *input.rig.reference().noise
                                          : estimate_gray_noise(gray.front());
  out.noise.floor_counts2 += input.options.storage_counts2.value_or(0.0);
  Image<float> threshold;
  if (gray.front().pattern.inverted == InvertedFrames::None)
    threshold = gray_threshold(gray.front(), find(PatternKind::White), find(PatternKind::Ambient));
  out.check = check_gray_inverses(gray.front());
  if (out.check->consistent) out.check = check_gray_neighbours(gray.front());
  GrayAloneOptions limits;
  limits.max_wrong_stripe = input.options.temporal.max_wrong_order;
  out.phase = inside_field(input, decode_gray_alone(gray, threshold, out.noise, limits));
  out.coarsest = out.phase.pattern;
  return out;
}

DecodedDirection decode_from(const FromCoarserMaps& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = wrap_maps(input, fit_maps(input), WrappedParts::PhaseOnly);
  const Projector& projector = input.rig.projector;
  std::vector<WrappedPhase>& wrapped = maps.view.wrapped;
  maps.view.phase =
      input.options.keep_maps
          ? unwrap_temporally(wrapped, projector, input.options.temporal)
          : unwrap_temporally_in_place(std::move(wrapped), projector, input.options.temporal);
  correct_orders(input, maps);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const FromSlope& source, const DirectionInput& input) {
  DirectionMaps maps = fit_maps(input);
  if (source.safe_for_every_pixel && allow_one_pass(input, maps)) {
    maps = decode_in_one_pass(input, std::move(maps));
  } else {
    maps = wrap_maps(input, std::move(maps));
    maps.view.phase = unwrap_sequence(
        maps.view.wrapped, input.rig.projector, source.method, input.options.temporal);
  }
  correct_orders(input, maps);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const FromLaserSheet& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = unwrap_in_space(input);
  DecodedDirection& view = maps.view;
  const FrameStack* line = line_of(input.stacks);
  require(line != nullptr, "decode_view: the frames are not those of the plan's patterns");
  const WrappedPhase& coarsest = view.wrapped.front();
  view.profile =
      laser_profile(*line, coarsest.mean_counts, input.rig, view.noise, input.options.line);
  const SequenceCheck start = check_start_by_sheet(coarsest, view.profile, input.rig.projector);
  if (!start.consistent) view.check = start;
  unwrap_finer(input,
               resolve_by_laser_sheet(
                   *view.relative, view.profile, input.rig.projector, input.options.fringe_order),
               view);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const FromDistance& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = unwrap_in_space(input);
  const RelativePhase& relative = *maps.view.relative;
  const double depth_mm = crossing_distance(relative.pattern, input.rig);
  unwrap_finer(input, resolve_by_distance(relative, input.rig, input.rays, depth_mm), maps.view);
  return finished(input, std::move(maps));
}

DecodedDirection decode_from(const Unresolved& /*source*/, const DirectionInput& input) {
  DirectionMaps maps = unwrap_in_space(input);
  const RelativePhase& relative = *maps.view.relative;
  input.run.warn(
      "the patterns do not determine fringe orders, and the rig has no geometry that does: the "
      "phase of each region has an offset of its own");
  unwrap_finer(input,
               {{relative.pattern,
                 relative.phase_rad,
                 relative.sigma_rad,
                 relative.status,
                 relative.systematic_rad},
                {}},
               maps.view);
  return finished(input, std::move(maps));
}

DecodedDirection decode_as_planned(const DirectionInput& input) {
  return std::visit([&](const auto& source) { return decode_from(source, input); },
                    input.plan.orders);
}

/// The only declaration that fits the frames, if other shifts of one pattern are all that it needs.
const SequenceFault* remedy_of(const DecodedDirection& view) {
  if (!view.check || view.check->consistent) return nullptr;
  const SequenceCheck& check = *view.check;
  if (check.fits.size() != 1 || check.fits.front().patterns.size() != 1 ||
      check.fits.front().shifts_rad.empty())
    return nullptr;
  return &check.fits.front();
}

/// The direction decoded again with the shifts that fit, if the same check passes.
std::optional<DecodedDirection> remedied(const DirectionInput& input, const SequenceFault& fault) {
  std::vector<FrameStack> stacks(input.stacks.begin(), input.stacks.end());
  for (FrameStack& stack : stacks) {
    const bool concerned = stack.pattern.name == fault.patterns.front() &&
                           stack.pattern.shifts_rad.size() == fault.shifts_rad.size();
    if (concerned) stack.pattern.shifts_rad = fault.shifts_rad;
  }
  auto orders_rad = input.orders_rad;
  orders_rad.erase(fault.patterns.front());
  Run run = input.run;
  if (!input.options.accept_remedy) {  // only tried
    run.on_warning = nullptr;
    run.on_note = nullptr;
  }
  const DirectionInput changed{stacks,
                               input.plan,
                               input.rig,
                               input.rays,
                               input.options,
                               run,
                               input.noise,
                               input.unexplained_rad,
                               std::move(orders_rad)};
  DecodedDirection again = decode_as_planned(changed);
  if (!again.check->consistent) return {};
  return again;
}

/// Applies or offers the shifts that fit where those of scan.toml do not, and with which the same
/// check passes.
void apply_remedy(const DirectionInput& input,
                  DecodedDirection& view,
                  std::vector<FrameVerdict>& verdicts,
                  const Run& run) {
  const SequenceFault* fault = remedy_of(view);
  if (fault == nullptr) return;
  const std::string pattern = fault->patterns.front();
  const bool is_lost = std::any_of(verdicts.begin(), verdicts.end(), [&](const auto& verdict) {
    return verdict.action == FrameAction::LeaveOutView &&
           (verdict.explanation.pattern != pattern || !verdict.remedy_rad.empty());
  });
  if (is_lost) return;  // the verdict says more
  std::optional<DecodedDirection> again = remedied(input, *fault);
  if (!again) return;
  if (!input.options.accept_remedy) {
    view.check->finding =
        describe(*view.check) + "; `accept_remedy` decodes with the shifts that fit";
    return;
  }
  run.warn(describe(*view.check) + "; decoded with the shifts that fit");
  view = *std::move(again);
  // Other patterns decided which frames of the pattern were exchanged, which its own do not tell.
  for (FrameVerdict& verdict : verdicts) {
    const FrameExplanation& found = verdict.explanation;
    if (found.pattern == pattern && found.best.cause == FrameCause::Exchanged)
      verdict.action = FrameAction::Use;
  }
}

}  // namespace

DecodedDirection decode_direction(const DirectionInput& all) {
  JudgedFrames judged = judge_direction(all);
  // The verdict reports the fault of these frames; warnings of later stages would be its
  // consequences.
  Run run = all.run;
  if (leaves_out_view(judged.verdicts) && !all.options.accept_inconsistent)
    run.on_warning = nullptr;
  const DirectionInput input{judged.stacks.empty() ? all.stacks : judged.stacks,
                             all.plan,
                             all.rig,
                             all.rays,
                             all.options,
                             run,
                             judged.noise,
                             std::move(judged.unexplained_rad),
                             std::move(judged.orders_rad)};
  DecodedDirection view = decode_as_planned(input);
  apply_remedy(input, view, judged.verdicts, all.run);
  for (FrameVerdict& by_coarser : view.frames) {
    const auto by_frames =
        std::find_if(judged.verdicts.begin(), judged.verdicts.end(), [&](const FrameVerdict& one) {
          return one.explanation.pattern == by_coarser.explanation.pattern;
        });
    if (by_frames != judged.verdicts.end()) *by_frames = std::move(by_coarser);
  }
  view.frames = std::move(judged.verdicts);
  view.check = report_frames(view.frames, std::move(view.check), all.run);
  view.check = report_outside_field(view.phase, std::move(view.check), run);
  if (all.options.own.any()) return view;
  view.check = report_uncertain_phase(view.phase, std::move(view.check));
  const bool by_maps = std::holds_alternative<FromCoarserMaps>(all.plan.orders) ||
                       std::holds_alternative<FromSlope>(all.plan.orders);
  if (by_maps && is_absolute(view.coarsest, all.rig.projector))
    view.check = report_orders_by_chance(view, std::move(view.check));
  return view;
}

}  // namespace frangia
