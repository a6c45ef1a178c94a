#include "frangia/decode/internal/judge_direction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/explain_frames.h"
#include "frangia/decode/explain/judge_coarse_frames.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/phase/waveform/cut_dark_end.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/noise_of_view.h"
#include "frangia/rig/rig.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

/// The camera's noise: from rig.toml, else from the survey of several views unless this view
/// contradicts it, else from this view.
/// Lossy compression adds its own.
NoiseModel noise_of(const DirectionInput& input, std::span<const FrameStack> stacks) {
  NoiseModel noise = input.rig.reference().noise ? *input.rig.reference().noise
                     : input.options.survey.noise
                         ? noise_of_view(stacks, *input.options.survey.noise)
                         : estimate_noise(stacks);
  noise.floor_counts2 += input.options.storage_counts2.value_or(0.0);
  return noise;
}

/// Three frames leave no residual: a part that is within one coarse fringe may look like any
/// fault.
bool may_look_like_a_fault(const Pattern& pattern, const Rig& rig) {
  constexpr double kFewFringes = 4.0;  // over the field
  return pattern.shifts_rad.size() <= 3 &&
         phase_range(pattern, rig.projector).width_rad() < kFewFringes * kTwoPi;
}

/// Marks pixels at a ceiling below the white level as saturated.
void apply_ceiling(const Ceiling& ceiling, const DirectionInput& input, JudgedFrames& out) {
  input.run.warn(fmt::format(
      "the frames are cut off at {} counts, below their white level of {}: {:.1f} % of the "
      "samples "
      "are at it and count as saturated; expose shorter, and set white_level = {} in rig.toml",
      ceiling.counts,
      input.stacks.front().white_level,
      100.0 * ceiling.share,
      ceiling.counts));
  out.stacks.assign(input.stacks.begin(), input.stacks.end());
  for (FrameStack& stack : out.stacks)
    stack.white_level = ceiling.counts;
}

/// The camera's noise by the coarsest fringes alone, whose cut end bends least; `known` where it is
/// less, or stated.
NoiseModel noise_beside_cut(std::span<const FrameStack> stacks,
                            const DirectionInput& input,
                            const NoiseModel& known) {
  constexpr double kBright = 0.25;  // of the white level
  const auto fringes = fringes_of(stacks, input.plan.direction);
  if (fringes.empty() || input.rig.reference().noise) return known;
  NoiseModel out = estimate_noise({fringes.front(), 1});
  out.floor_counts2 += input.options.storage_counts2.value_or(0.0);
  const double bright = kBright * stacks.front().white_level;
  return out.variance(0.0) + out.variance(bright) < known.variance(0.0) + known.variance(bright)
             ? out
             : known;
}

/// Raises the dark end of the fringes, which the camera cuts off. A function of the caller that
/// wraps frames gets them as they were captured.
bool apply_cut(const DirectionInput& input, JudgedFrames& out) {
  if (input.options.own.wrap) return false;
  const std::span<const FrameStack> stacks =
      out.stacks.empty() ? input.stacks : std::span<const FrameStack>(out.stacks);
  const NoiseModel noise = noise_beside_cut(stacks, input, out.noise);
  const std::optional<CutDarkEnd> cut = find_cut_dark_end(stacks, noise);
  if (!cut) return false;
  input.run.warn(fmt::format(
      "the camera cuts the dark end of the fringes off at {} counts: {:.0f} % of their samples are "
      "at it, and the fringes through the others reach {:.0f} counts below it; the phase follows "
      "from the others; raise the black level or the brightness of the camera, or lower its "
      "contrast",
      cut->counts,
      100.0 * cut->share,
      cut->depth_counts));
  RaisedFrames raised = raise_dark_end(stacks, *cut, noise);
  out.stacks = std::move(raised.stacks);
  out.noise = raised.noise;
  return true;
}

/// Whether the frames are in another order, and more than one predicts them.
bool is_undecided_order(const FrameVerdict& verdict) {
  return verdict.action == FrameAction::LeaveOutView && verdict.remedy_rad.empty() &&
         verdict.explanation.has_fault() && verdict.explanation.best.cause == FrameCause::Exchanged;
}

/// Adds the verdict on a pattern whose frames by themselves decide nothing, if the sound patterns
/// name a lost frame.
void judge_by_finer(const FrameStack& stack,
                    const NoiseModel& noise,
                    const JudgeOptions& options,
                    std::vector<FrameVerdict>& verdicts) {
  const auto verdict = std::find_if(verdicts.begin(), verdicts.end(), [&](const auto& one) {
    return one.explanation.pattern == stack.pattern.name;
  });
  const bool is_known = verdict != verdicts.end() && verdict->explanation.decided;
  if (stack.pattern.exposure_count() > 1 || is_known) return;
  std::optional<FrameVerdict> found = judge_coarse_frames(stack, noise, options);
  if (!found) return;
  if (verdict != verdicts.end()) verdicts.erase(verdict);
  verdicts.push_back(*std::move(found));
}

/// Explains each pattern by itself, and those that are not as described again beside the others.
std::vector<FrameVerdict> judge_patterns(std::span<const FrameStack> captured,
                                         std::span<const FrameStack* const> fringes,
                                         const DirectionInput& input,
                                         bool has_other_check,
                                         const NoiseModel& noise) {
  std::vector<const FrameStack*> stacks;
  std::vector<FrameVerdict> verdicts;
  std::vector<const FrameStack*> sound;
  const auto options_of = [&](const FrameStack& stack) -> JudgeOptions {
    return {may_leave_out(stack.pattern, input.options), has_other_check, sound};
  };
  const auto judge = [&](const FrameStack& stack) {
    return judge_frames(stack, noise, options_of(stack));
  };
  std::vector<FrameVerdict> late;  // where the pattern changes: no other cause is asked for
  for (const FrameStack* stack : fringes) {
    if (stack->pattern.exposure_count() > 1) continue;
    if (stack != captured.data()) {
      const FrameStack& before = *std::prev(stack);
      if (auto first = judge_first_frame(*stack, before, noise, options_of(*stack))) {
        late.push_back(*std::move(first));
        continue;
      }
    }
    if (may_look_like_a_fault(stack->pattern, input.rig)) continue;
    stacks.push_back(stack);
    verdicts.push_back(judge(*stack));
  }
  for (std::size_t i = 0; i < stacks.size(); ++i)
    if (is_sound(verdicts[i].explanation)) sound.push_back(stacks[i]);
  for (std::size_t i = 0; i < stacks.size() && !sound.empty(); ++i) {
    const FrameExplanation& found = verdicts[i].explanation;
    if (found.decided && !is_sound(found)) verdicts[i] = judge(*stacks[i]);
  }
  std::move(late.begin(), late.end(), std::back_inserter(verdicts));
  for (const FrameStack* stack : fringes)
    if (!sound.empty()) judge_by_finer(*stack, noise, options_of(*stack), verdicts);
  return verdicts;
}

std::vector<double> degrees_of(const std::vector<double>& shifts_rad) {
  std::vector<double> degrees;
  for (const double shift : shifts_rad)
    degrees.push_back(deg_from_rad(shift));
  return degrees;
}

}  // namespace

bool may_leave_out(const Pattern& pattern, const DecodeOptions& options) {
  return pattern.fringes_per_degree == 0.0 && !options.own_algorithm && !options.own.any() &&
         !options.recover_saturated &&
         (options.algorithm == "auto" || options.algorithm == "least-squares");
}

JudgedFrames judge_direction(const DirectionInput& input) {
  JudgedFrames out;
  if (input.plan.maps.empty()) return out;
  out.noise = noise_of(input, input.stacks);
  if (const std::optional<Ceiling> ceiling = find_ceiling(input.stacks, out.noise))
    apply_ceiling(*ceiling, input, out);
  const bool is_cut = apply_cut(input, out);
  const std::span<const FrameStack> stacks =
      out.stacks.empty() ? input.stacks : std::span<const FrameStack>(out.stacks);
  const auto fringes = fringes_of(stacks, input.plan.direction);
  const bool has_other_check = fringes.size() > 1 || !gray_of(stacks, input.plan.direction).empty();
  bool changed = false;
  for (FrameVerdict& verdict : judge_patterns(stacks, fringes, input, has_other_check, out.noise)) {
    out.unexplained_rad[verdict.explanation.pattern] = verdict.explanation.unexplained_rad;
    if (is_undecided_order(verdict)) {
      for (const FrameHypothesis& one : verdict.explanation.alike)
        out.orders_rad[verdict.explanation.pattern].push_back(one.shifts_rad);
    }
    if (!verdict.remedy_rad.empty() && input.options.accept_remedy)
      verdict.action = FrameAction::Use;
    changed = changed || verdict.action == FrameAction::LeaveOutFrames ||
              (verdict.action == FrameAction::Use && !verdict.remedy_rad.empty());
    out.verdicts.push_back(std::move(verdict));
  }
  if (!changed) return out;
  if (out.stacks.empty()) out.stacks.assign(input.stacks.begin(), input.stacks.end());
  for (FrameStack& stack : out.stacks) {
    for (const FrameVerdict& verdict : out.verdicts) {
      if (verdict.explanation.pattern != stack.pattern.name) continue;
      if (!verdict.left_out.empty()) stack = without_frames(stack, verdict.left_out);
      if (verdict.action == FrameAction::Use && !verdict.remedy_rad.empty())
        stack.pattern.shifts_rad = verdict.remedy_rad;
    }
  }
  if (!is_cut) out.noise = noise_of(input, out.stacks);  // filled samples have less
  return out;
}

std::optional<SequenceCheck> report_frames(const std::vector<FrameVerdict>& verdicts,
                                           std::optional<SequenceCheck> check,
                                           const Run& run) {
  for (const FrameVerdict& verdict : verdicts) {
    const FrameExplanation& found = verdict.explanation;
    if (verdict.action == FrameAction::LeaveOutFrames) {
      run.warn(fmt::format("{}; {} left out, and the phase is computed from the others; {}",
                           verdict.finding,
                           verdict.left_out.size() == 1 ? "it is" : "these frames are",
                           found.explanation.remedy));
    }
    if (verdict.action == FrameAction::Use && !verdict.remedy_rad.empty())
      run.warn(fmt::format("{}; decoded with the shifts that fit", verdict.finding));
    if (verdict.action == FrameAction::Use && found.best.cause == FrameCause::Covered)
      run.warn(fmt::format("{}; the pixels where the frames contradict each other are left out; {}",
                           verdict.finding,
                           found.explanation.remedy));
    if (verdict.action != FrameAction::LeaveOutView || !check) continue;
    // The other patterns decide which of these orders it is.
    if (is_undecided_order(verdict) && !check->consistent) continue;
    check = SequenceCheck{.decided = true, .consistent = false};
    check->patterns = {found.pattern};
    check->finding = verdict.finding;
    if (!found.explanation.remedy.empty() && found.are_fringes)
      check->finding += "; " + found.explanation.remedy;
    if (!verdict.remedy_rad.empty())
      check->finding += fmt::format(", or set `accept_remedy` to decode with shifts_deg = [{:.6g}]",
                                    fmt::join(degrees_of(verdict.remedy_rad), ", "));
    return check;
  }
  return check;
}

std::optional<SequenceCheck> report_uncertain_phase(const AbsolutePhase& phase,
                                                    std::optional<SequenceCheck> check) {
  constexpr float kMost_rad = 0.5F;
  constexpr double kMostPixels = 0.5;
  if (!check || !check->consistent) return check;
  std::size_t measured = 0;
  std::size_t uncertain = 0;
  for (std::size_t i = 0; i < phase.sigma_rad.pixels().size(); ++i) {
    const float noise = phase.sigma_rad.pixels()[i];
    if (std::isnan(noise)) continue;
    const float systematic = phase.systematic_rad.empty() ? 0.0F : phase.systematic_rad.pixels()[i];
    ++measured;
    if (combined_sigma(noise, systematic) > kMost_rad) ++uncertain;
  }
  const double share =
      static_cast<double>(uncertain) / static_cast<double>(std::max<std::size_t>(1, measured));
  if (share <= kMostPixels) return check;
  check = SequenceCheck{.decided = true, .consistent = false};
  check->patterns = {phase.pattern.name};
  check->finding = fmt::format(
      "pattern \"{}\": the phase of {:.0f} % of the pixels is uncertain by more than {:g} rad, "
      "because the frames differ from fringes with its shifts and no known cause explains it; "
      "check that they are the frames of this pattern, and that nothing moved",
      phase.pattern.name,
      100.0 * share,
      kMost_rad);
  return check;
}

std::optional<SequenceCheck> report_outside_field(const AbsolutePhase& phase,
                                                  std::optional<SequenceCheck> check,
                                                  const Run& run) {
  constexpr double kWarned = 0.02;  // wrong codes in shadows are fewer
  constexpr double kMost = 0.5;
  std::size_t measured = 0;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < phase.status.pixels().size(); ++i) {
    if (phase.status.pixels()[i] == PixelStatus::OutOfField) ++outside;
    if (!std::isnan(phase.phase_rad.pixels()[i])) ++measured;
  }
  const double share = static_cast<double>(outside) /
                       static_cast<double>(std::max<std::size_t>(1, measured + outside));
  if (share <= kWarned) return check;
  const char* const places =
      phase.pattern.direction == FringeDirection::Vertical ? "columns" : "rows";
  if (share <= kMost || !check || !check->consistent) {
    run.warn(
        fmt::format("the Gray code of {:.0f} % of the measured pixels names {} outside the "
                    "projector of rig.toml, and they are not measured; check size_px there, "
                    "and bits, stripe_px and offset_px of the code",
                    100.0 * share,
                    places));
    return check;
  }
  check = SequenceCheck{.decided = true, .consistent = false};
  check->patterns = {phase.pattern.name};
  check->finding = fmt::format(
      "the Gray code of {:.0f} % of the measured pixels names {} outside the projector of "
      "rig.toml; check size_px there, and bits, stripe_px and offset_px of the code",
      100.0 * share,
      places);
  return check;
}

std::optional<SequenceCheck> report_orders_by_chance(const DecodedDirection& view,
                                                     std::optional<SequenceCheck> check) {
  constexpr double kFar_rad = 0.5 * kPi;  // half of what the nearest order leaves at most
  constexpr double kMostFar = 0.25;       // of the pixels; by chance it is half of them
  constexpr double kMostSigma_rad = 0.4;  // of a pixel that says something: a quarter of that
  constexpr std::size_t kLeast = 300;     // pixels; fewer decide nothing
  if (!check || !check->consistent) return check;
  const Image<float>& absolute_rad = view.phase.phase_rad;
  const double finest = view.phase.pattern.fringes_per_unit();
  for (std::size_t m = 0; m + 1 < view.thinned.size(); ++m) {
    const WrappedPhase& coarse = view.thinned[m];
    const WrappedPhase& fine = view.thinned[m + 1];
    const double ratio = fine.pattern.fringes_per_unit() / coarse.pattern.fringes_per_unit();
    std::size_t compared = 0;
    std::size_t far = 0;
    for (int y = 0; y < coarse.phase_rad.height(); ++y) {
      for (int x = 0; x < coarse.phase_rad.width(); ++x) {
        const double known_rad = absolute_rad(x * view.thinning_px, y * view.thinning_px);
        const double sigma_rad = std::hypot(ratio * coarse.sigma_rad(x, y), fine.sigma_rad(x, y));
        if (std::isnan(known_rad) || !(sigma_rad < kMostSigma_rad)) continue;
        // How far each map is from the place that all of them gave.
        const auto off_rad = [&](const WrappedPhase& map) {
          return wrap_rad(static_cast<double>(map.phase_rad(x, y)) -
                          map.pattern.fringes_per_unit() / finest * known_rad);
        };
        ++compared;
        if (std::abs(ratio * off_rad(coarse) - off_rad(fine)) > kFar_rad) ++far;
      }
    }
    const double share =
        static_cast<double>(far) / static_cast<double>(std::max<std::size_t>(1, compared));
    if (compared < kLeast || share <= kMostFar) continue;
    check = SequenceCheck{.decided = true, .consistent = false};
    check->patterns = {coarse.pattern.name};
    check->finding = fmt::format(
        "pattern \"{}\": at {:.0f} % of the pixels its phase is off by more than a quarter of a "
        "fringe of pattern \"{}\", so that the fringe orders are little better than chance; check "
        "that they are its frames, in the order of its shifts",
        coarse.pattern.name,
        100.0 * share,
        fine.pattern.name);
    return check;
  }
  return check;
}

}  // namespace frangia
