#include "frangia/decode/decode_view.h"

#include <algorithm>

#include "frangia/decode/internal/decode_direction.h"
#include "frangia/decode/select_stacks.h"

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

DecodedView decode_view(std::span<const FrameStack> stacks,
                        const DecodePlan& plan,
                        const Rig& rig,
                        const Image<Eigen::Vector2f>& rays,
                        const DecodeOptions& options,
                        const Run& run) {
  DecodedView out;
  out.directions.clear();
  for (const DirectionPlan& direction : plan.directions)
    out.directions.push_back(decode_direction({stacks, direction, rig, rays, options, run}));
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
