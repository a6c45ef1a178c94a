#include "frangia/decode/decode_view.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <variant>

#include "frangia/core/held_messages.h"
#include "frangia/decode/explain/explain_lag.h"
#include "frangia/decode/explain/judge_frames.h"
#include "frangia/decode/internal/decode_direction.h"
#include "frangia/decode/internal/judge_direction.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/frames/storage_loss.h"
#include "frangia/phase/blur/find_sharpening.h"
#include "frangia/phase/blur/undo_sharpening.h"
#include "frangia/phase/waveform/frame_mixing.h"
#include "frangia/phase/waveform/light_bands.h"

namespace frangia {

DecodeOptions options_of_view(const DecodeOptions& options, std::size_t view) {
  DecodeOptions out = options;
  if (out.phase_files) out.own = stages_from_files(*out.phase_files, view);
  return out;
}

std::vector<FrameAssessment> assessments_of(const DecodedView& view) {
  std::vector<FrameAssessment> all;
  for (const DecodedDirection& direction : view.directions)
    all.insert(all.begin(), direction.assessments.begin(), direction.assessments.end());
  return all;
}

std::vector<FrameAssessment> assessments_of_used(const DecodedView& view) {
  std::vector<FrameAssessment> used;
  for (const DecodedDirection& direction : view.directions) {
    if (!leaves_out_view(direction.frames))
      used.insert(used.begin(), direction.assessments.begin(), direction.assessments.end());
  }
  return used;
}

double blur_px_of(const DecodedView& view) {
  double largest_px = 0.0;
  for (const DecodedDirection& direction : view.directions)
    if (direction.blur) largest_px = std::max(largest_px, direction.blur->sigma_px());
  return largest_px;
}

std::vector<std::string> corrections_of(const DecodedView& view) {
  std::vector<std::string> all;
  const std::string response = describe_corrections(assessments_of(view));
  if (!response.empty()) all.push_back(response);
  for (const DecodedDirection& direction : view.directions) {
    if (!direction.blur) continue;
    all.push_back(describe(*direction.blur));
    break;  // the other direction has the same camera
  }
  return all;
}

std::string misfit_of(const DecodedView& view) {
  std::vector<SequenceCheck> checks;
  for (const DecodedDirection& direction : view.directions)
    if (direction.check) checks.push_back(*direction.check);
  return describe(checks);
}

namespace {

/// The arguments of `decode_view`.
struct ViewInput {
  const DecodePlan& plan;
  const Rig& rig;
  const Image<Eigen::Vector2f>& rays;
  const DecodeOptions& options;
};

DecodedView decode_directions(std::span<const FrameStack> stacks,
                              const ViewInput& input,
                              const Run& run) {
  DecodedView out;
  out.directions.clear();
  for (const DirectionPlan& direction : input.plan.directions)
    out.directions.push_back(
        decode_direction({stacks, direction, input.rig, input.rays, input.options, run}));
  return out;
}

/// Decodes frames that are out of step as what they show, where that is wanted and possible.
/// Otherwise the view measures nothing: its checks say so.
DecodedView decode_out_of_step(std::span<const FrameStack> stacks,
                               const FrameLag& lag,
                               const ViewInput& input,
                               const Run& run) {
  const std::vector<FrameStack> moved = in_step(stacks, lag);
  if (input.options.accept_remedy && !moved.empty()) {
    run.warn(describe(lag) + "; decoded as what they show");
    return decode_directions(moved, input, run);
  }
  Run quiet = run;  // other findings would be consequences
  quiet.on_warning = nullptr;
  quiet.on_note = nullptr;
  DecodedView out =
      decode_directions(moved.empty() ? stacks : std::span<const FrameStack>(moved), input, quiet);
  for (std::size_t i = 0; i < out.directions.size(); ++i) {
    DecodedDirection& direction = out.directions[i];
    direction.frames = judge_lag(input.plan.directions[i].maps, lag, !moved.empty());
    if (direction.frames.empty()) continue;  // a Gray code alone
    const FrameVerdict& verdict = direction.frames.front();
    direction.check = SequenceCheck{.decided = true, .consistent = false};
    direction.check->finding = verdict.finding + "; " + verdict.explanation.explanation.remedy;
    for (const FrameVerdict& one : direction.frames)
      direction.check->patterns.push_back(one.explanation.pattern);
  }
  return out;
}

/// Whether a direction whose orders a Gray code gives is not as scan.toml says.
bool contradicts_its_code(const DecodedView& view, const DecodePlan& plan) {
  for (std::size_t i = 0; i < view.directions.size(); ++i) {
    const DecodedDirection& direction = view.directions[i];
    if (!std::holds_alternative<FromGrayCode>(plan.directions[i].orders)) continue;
    const bool is_sound =
        direction.check && direction.check->consistent && direction.check->finding.empty();
    if (leaves_out_view(direction.frames) || !is_sound) return true;
  }
  return false;
}

/// The frames at even light, where a rolling shutter shows bands; empty where none does. A function
/// of the caller that wraps them gets the frames as they were captured.
std::vector<FrameStack> at_even_light(std::span<const FrameStack> stacks,
                                      const DecodeOptions& options,
                                      const Run& run) {
  std::vector<FrameStack> out;
  if (options.own.wrap) return out;
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    if (stacks[i].pattern.fringes_per_degree > 0.0) continue;  // its steps are not exact
    const std::optional<LightBands> bands = find_light_bands(stacks[i]);
    if (!bands) continue;
    if (out.empty()) out.assign(stacks.begin(), stacks.end());
    out[i] = without_bands(stacks[i], *bands);
    run.warn(describe(*bands, stacks[i].pattern.name));
  }
  return out;
}

/// The frames without what they hold of those before; empty where they hold nothing of them. The
/// first one, whose predecessor is not known, is left out where the others determine the phase.
std::vector<FrameStack> each_alone(std::span<const FrameStack> stacks,
                                   const DecodeOptions& options,
                                   const Run& run) {
  if (options.own.wrap) return {};
  const std::optional<FrameMixing> mixing = find_frame_mixing(stacks);
  if (!mixing) return {};
  run.warn(describe(*mixing));
  std::vector<FrameStack> out = without_mixing(stacks, *mixing);
  constexpr std::size_t kEnough = 4;
  FrameStack& first = out.front();
  if (first.pattern.kind == PatternKind::Fringe && first.frames.size() >= kEnough &&
      may_leave_out(first.pattern, options))
    first = without_frames(first, std::array{std::size_t{0}});
  return out;
}

/// Variance that the storage of the frames added to each pixel, counts squared: as stated, else by
/// its traces.
double storage_counts2(std::span<const FrameStack> stacks, const Run& run) {
  const double stated = stacks.empty() ? 0.0 : stacks.front().compression_counts2;
  if (stated > 0.0) return stated;
  const StorageLoss loss = find_storage_loss(stacks);
  const std::string text = describe(loss);
  if (!text.empty()) run.warn(text);
  return loss.variance_counts2;
}

/// The frames before the camera sharpened them; empty where it did not.
std::vector<FrameStack> before_sharpening(std::span<const FrameStack> stacks,
                                          const DecodeOptions& options,
                                          const Run& run) {
  if (options.own.wrap) return {};
  const std::optional<CameraSharpening> sharpening =
      find_sharpening(stacks, options.storage_counts2.value_or(0.0));
  if (!sharpening) return {};
  run.warn(describe(*sharpening));
  std::vector<FrameStack> out;
  for (const FrameStack& stack : stacks)
    out.push_back(without_sharpening(stack, *sharpening));
  return out;
}

}  // namespace

DecodedView decode_view(std::span<const FrameStack> captured,
                        const DecodePlan& plan,
                        const Rig& rig,
                        const Image<Eigen::Vector2f>& rays,
                        const DecodeOptions& options,
                        const Run& run) {
  DecodeOptions of_view = options;
  if (!of_view.storage_counts2) of_view.storage_counts2 = storage_counts2(captured, run);
  const std::vector<FrameStack> unsharp = before_sharpening(captured, of_view, run);
  const std::span<const FrameStack> seen = unsharp.empty() ? captured : unsharp;
  const std::vector<FrameStack> alone = each_alone(seen, options, run);
  // The noise of all views is of frames as they were captured.
  if (!alone.empty() || !unsharp.empty()) of_view.survey.noise.reset();
  const ViewInput input{plan, rig, rays, of_view};
  const std::span<const FrameStack> shown = alone.empty() ? seen : alone;
  const std::vector<FrameStack> evened = at_even_light(shown, options, run);
  const std::span<const FrameStack> stacks = evened.empty() ? shown : evened;
  if (!options.accept_inconsistent) {
    std::optional<FrameLag> lag = explain_torn_frames(stacks);
    if (!lag) lag = explain_lag(stacks);
    if (lag) return decode_out_of_step(stacks, *lag, input, run);
  }
  HeldMessages held;  // of frames that turn out to be late, they would be consequences
  DecodedView out = held.during(
      run, [&](const Run& attempt) { return decode_directions(stacks, input, attempt); });
  if (!options.accept_inconsistent && contradicts_its_code(out, plan)) {
    if (const std::optional<FrameLag> lag = explain_lag_by_code(stacks))
      return decode_out_of_step(stacks, *lag, input, run);
  }
  held.pass_on(run);
  return out;
}

DecodedView decode_view(std::span<const FrameStack> stacks,
                        const Rig& rig,
                        const Image<Eigen::Vector2f>& rays,
                        const DecodeOptions& options,
                        const Run& run) {
  const DecodePlan plan = plan_decoding(patterns_of(stacks), rig, options);
  return decode_view(stacks, plan, rig, rays, options, run);
}

}  // namespace frangia
