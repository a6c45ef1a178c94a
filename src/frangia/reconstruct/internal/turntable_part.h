#pragma once

#include <vector>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/view_motions.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Adds what the uncertain poses of the views mean for the shape of a fused mesh to the systematic
/// part of its vertices. A vertex moves with the views that measured it, as their weighted mean.
/// The rigid motion that fits the motions of all vertices along their normals best is removed: it
/// moves the part as a whole.
///
/// Returns whether the mesh has such a part.
///
/// @shape    `motions`: one for each view
/// @missing  the mesh stays as it is where the part is below a fifth of sigma at 95 % of the
/// vertices
/// @source   GUM (JCGM 100:2008), 5.2
bool add_turntable_part(FusedSurface& surface, const ViewMotions& motions, const Run& run);

/// Adds the same, along the viewing rays, to the points that `collect_points` collected from the
/// cameras in turn.
void add_turntable_part(PointCloud& cloud,
                        const std::vector<CameraViews>& cameras,
                        const ViewMotions& motions,
                        const Run& run);

/// How uncertain the poses of the views on the turntable are: as the registration found, or without
/// one as the rig states.
[[nodiscard]] ViewMotions motions_of_views(const MeasuredSetup& joined,
                                           const Rig& rig,
                                           const RegisterOptions& options,
                                           const Run& run);

}  // namespace frangia
