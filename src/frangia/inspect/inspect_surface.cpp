#include "frangia/inspect/inspect_surface.h"

namespace frangia {

SurfaceInspection inspect_surface(const Mesh& mesh,
                                  const RayScene& reference,
                                  const SurfaceRule& rule,
                                  const DeviationOptions& options,
                                  const Run& run) {
  rule.check();
  SurfaceInspection found;
  found.deviations = deviations_of(mesh, reference, options, run);
  found.summary = summarize(mesh, found.deviations);
  found.verdict = judge_surface(mesh, found.deviations, reference, rule, run);
  return found;
}

}  // namespace frangia
