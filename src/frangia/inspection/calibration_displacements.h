#pragma once

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// How the independent changes of the parameters of a scan's rig, of one standard deviation each,
/// displace the vertices of its mesh along their normals: what is alike in all points of the mesh
/// because one rig measured them.
///
/// A vertex is displaced by the mean of the views whose camera it faces, weighted by the square of
/// the cosine; occlusion does not count, because the displacements are smooth. The rigid motion of
/// the measured volume is removed (`RigChangeField`). The scan's frame is that of the mesh.
///
/// @shape    a row for each independent change, a column for each vertex
/// @units    mm
/// @missing  no rows when the covariance of the rig is not known, or without a fringe pattern
/// @errors   Error(Cancelled)
/// @source   GUM (JCGM 100:2008), 5.2
[[nodiscard]] Eigen::MatrixXf calibration_displacements(const Mesh& mesh,
                                                        const Scan& scan,
                                                        const Run& run = {});

}  // namespace frangia
