#pragma once

#include "frangia/inspect/deviation.h"
#include "frangia/inspect/surface_verdict.h"

namespace frangia {

/// Deviations of a surface from its reference, and the decision about them.
struct SurfaceInspection {
  Deviations deviations;     ///< of each vertex
  DeviationSummary summary;  ///< of the vertices, unfiltered
  SurfaceVerdict verdict;    ///< by the patches of the reference
};

/// Compares a mesh with a reference in the same frame and decides by a rule: what the program, the
/// app and Python state about a surface.
///
/// @units    mm
/// @errors   Error(Input) as deviations_of and judge_surface, and for a mesh that lies beside the
///           reference, or of which no point lies on it; Error(Cancelled)
[[nodiscard]] SurfaceInspection inspect_surface(const Mesh& mesh,
                                                const RayScene& reference,
                                                const SurfaceRule& rule = {},
                                                const DeviationOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
