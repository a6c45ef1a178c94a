#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/mesh/internal/patch_mesh.h"

namespace frangia {

/// The triangles of the mesh that touch a hole's boundary. Vertices are numbered as in the patch:
/// the corners of the boundary first, then `outer_mm`.
struct PatchSurroundings {
  std::vector<Eigen::Vector3d> outer_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Moves the inner vertices of a patch so that the surface runs on from its surroundings: the mean
/// curvature changes as evenly as it can, and the direction at the boundary is that of the
/// triangles outside. On a sphere the patch comes to lie on the sphere.
///
/// With less than all of the `curvature` it lies so far between that and a film of least area.
///
/// False when there is no such surface; places are then undefined.
/// source   Botsch & Kobbelt 2004, An Intuitive Framework for Real-Time Freeform Modeling;
///          Schneider & Kobbelt 2001, Geometric Fairing of Irregular Meshes
[[nodiscard]] bool fair_patch(PatchMesh& patch,
                              const PatchSurroundings& around,
                              double curvature = 1.0);

/// Unit normals of a patch's vertices, those of the boundary with the triangles outside.
[[nodiscard]] std::vector<Eigen::Vector3d> normals_of(const PatchMesh& patch,
                                                      const PatchSurroundings& around);

}  // namespace frangia
