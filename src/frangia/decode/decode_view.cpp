#include "frangia/decode/decode_view.h"

#include <iterator>
#include <utility>

#include "frangia/decode/internal/decode_direction.h"
#include "frangia/decode/select_stacks.h"

namespace frangia {

DecodeOptions options_of_view(const DecodeOptions& options, std::size_t view) {
  DecodeOptions out = options;
  if (out.phase_files) out.own = stages_from_files(*out.phase_files, view);
  return out;
}

DecodedView decode_view(std::span<const FrameStack> stacks,
                        const DecodePlan& plan,
                        const Rig& rig,
                        const Image<Eigen::Vector2f>& rays,
                        const DecodeOptions& options,
                        const Run& run) {
  const auto decode = [&](const DirectionPlan& direction) {
    return decode_direction({stacks, direction, rig, rays, options, run});
  };
  DecodedView out = decode(plan.directions.front());
  if (plan.directions.size() == 1) return out;
  DecodedView second = decode(plan.directions.back());
  out.second_phase = std::move(second.phase);
  out.checks.insert(out.checks.end(), second.checks.begin(), second.checks.end());
  std::move(second.frames.begin(), second.frames.end(), std::back_inserter(out.frames));
  std::move(out.wrapped.begin(), out.wrapped.end(), std::back_inserter(second.wrapped));
  out.wrapped = std::move(second.wrapped);
  out.assessments.insert(
      out.assessments.begin(), second.assessments.begin(), second.assessments.end());
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
