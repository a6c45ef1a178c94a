#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/mesh/internal/patch_mesh.h"

namespace frangia {

/// The triangles of the mesh that touch the boundary of a hole. Vertex indices are those of the
/// patch: boundary vertices first, then `outer_mm`.
struct PatchSurroundings {
  std::vector<Eigen::Vector3d> outer_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Moves the inner vertices of a patch so that the surface continues its surroundings: the mean
/// curvature varies smoothly, and the tangent at the boundary is that of the triangles outside. A
/// hole in a sphere is filled by a part of the sphere.
///
/// A `curvature` below 1 blends the result with the minimal surface; 0 is the minimal surface.
/// Returns false when no such surface exists; the positions are then undefined.
///
/// @errors   Error(Cancelled)
/// @source   Botsch & Kobbelt 2004, An Intuitive Framework for Real-Time Freeform Modeling;
///          Schneider & Kobbelt 2001, Geometric Fairing of Irregular Meshes
[[nodiscard]] bool fair_patch(PatchMesh& patch,
                              const PatchSurroundings& around,
                              double curvature = 1.0,
                              const Run& run = {});

/// The unit normals of the vertices of a patch. Normals at the boundary include the triangles
/// outside.
[[nodiscard]] std::vector<Eigen::Vector3d> normals_of(const PatchMesh& patch,
                                                      const PatchSurroundings& around);

}  // namespace frangia
