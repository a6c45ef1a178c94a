#include "frangia/reconstruct/capabilities.h"

#include <algorithm>

namespace frangia {
namespace {

/// What the scan allows for indirect light that the options ask for.
IndirectLightUse indirect_light_of(const Rig& rig,
                                   const DecodePlan& plan,
                                   std::vector<std::string>& left_out) {
  const bool fringes = std::any_of(plan.directions.begin(),
                                   plan.directions.end(),
                                   [](const DirectionPlan& one) { return !one.maps.empty(); });
  if (!fringes) {
    left_out.emplace_back("indirect light is not looked for, because the scan holds no fringes");
    return IndirectLightUse::Ignored;
  }
  if (rig.projector.is_label) {
    left_out.emplace_back(
        "indirect light is not looked for, because the projector is a label: its phase is off "
        "alike "
        "in all cameras, which leaves the points where they are");
    return IndirectLightUse::Ignored;
  }
  if (rig.cameras.size() > 1) {
    left_out.emplace_back(
        "points are not corrected for indirect light, because several cameras determine them; "
        "sigma counts all of the predicted error");
    return IndirectLightUse::Counted;
  }
  if (plan.directions.size() > 1) {
    left_out.emplace_back(
        "points are not corrected for indirect light, because two directions of fringes determine "
        "them; sigma counts all of the predicted error");
    return IndirectLightUse::Counted;
  }
  return IndirectLightUse::Corrected;
}

}  // namespace

bool removes_background(const Rig& rig, const ReconstructOptions& options) {
  return rig.turntable.has_value() && !options.keep_background;
}

Capabilities capabilities_of(const Rig& rig,
                             const DecodePlan& plan,
                             const ReconstructOptions& options) {
  Capabilities out;
  out.registers_views = options.register_views && rig.turntable.has_value();
  out.removes_turntable_top = !options.keep_turntable_top && rig.turntable.has_value();
  out.removes_background = removes_background(rig, options);
  if (options.indirect_light) out.indirect_light = indirect_light_of(rig, plan, out.left_out);
  out.corrects_before_registration = out.registers_views && rig.cameras.size() == 1 &&
                                     out.indirect_light != IndirectLightUse::Ignored;
  return out;
}

void report(const Capabilities& capabilities, const Run& run) {
  for (const std::string& sentence : capabilities.left_out)
    run.note(sentence);
}

}  // namespace frangia
