#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

struct SmoothOptions {
  int iterations = 10;
  /// No vertex moves farther than so many of its sigma, at sharp edges than a seventh of it, and
  /// beside them than two fifths; 0: no bound.
  double max_sigmas = 3.0;
  Selection only;  ///< move the vertices of these triangles alone; empty: all
};

/// Takes away noise and leaves large shapes: each step smooths, then swells back, along the
/// normals. Where nothing bounds it sharp edges get rounder; smooth_keeping_edges keeps them.
///
/// Vertices on the boundary stay. Those that end beyond their sigma from where they were are marked
/// as moved; without sigma there is no bound.
/// errors   Error(Input) for a negative number, or `only` that is not one flag a triangle
/// source   Taubin 1995, A Signal Processing Approach to Fair Surface Design
[[nodiscard]] Mesh smooth_taubin(Mesh mesh, const SmoothOptions& options = {}, const Run& run = {});

struct KeepEdgesOptions {
  SmoothOptions smooth{.iterations = 8, .max_sigmas = 3.0, .only = {}};
  double crease_rad = 0.35;  ///< triangles that turn from each other by much more are not mixed
};

/// Takes away noise and keeps edges: directions of triangles are averaged with those beside them
/// that point alike, then the vertices follow the directions.
///
/// errors   as smooth_taubin
/// source   Zheng, Fu, Au & Tai 2011, Bilateral Normal Filtering for Mesh Denoising (local scheme);
///          vertices by Sun, Rosin, Martin & Langbein 2007
[[nodiscard]] Mesh smooth_keeping_edges(Mesh mesh,
                                        const KeepEdgesOptions& options = {},
                                        const Run& run = {});

}  // namespace frangia
