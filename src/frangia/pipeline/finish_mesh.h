#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct FinishOptions {
  bool watertight = false;  ///< close what was not seen, every triangle of it marked as synthesized
  double tolerance_mm = 0.0;  ///< fewer triangles, nowhere farther from the measured mesh; 0: all
};

/// What is done to a pasted mesh only when it is asked for. Notes of `run` say what was done.
///
/// errors   as fill_holes and decimate
[[nodiscard]] Mesh finish_mesh(Mesh mesh, const FinishOptions& options, const Run& run = {});

/// The mesh with at most `max_triangles`, for a file that few programs open when it holds more; a
/// note says how far from the mesh that lies. 0 keeps all.
[[nodiscard]] Mesh limit_triangles(const Mesh& mesh,
                                   std::size_t max_triangles,
                                   const Run& run = {});

}  // namespace frangia
