#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// More iterations are a slip of the hand: they take hours, and a command of the app all the
/// others.
inline constexpr int kMostSmoothIterations = 10'000;

/// Strength and limits of smoothing.
struct SmoothOptions {
  int iterations = 10;  ///< number of smoothing passes; more passes smooth more
  /// Limit of the movement of a vertex in units of its sigma; 0: no limit. Vertices at sharp edges
  /// move by at most 0.15 of it, their neighbours by at most 0.4.
  double max_sigmas = 3.0;
  Selection only;  ///< move only the vertices of these triangles; empty: all
};

/// Smooths a mesh by Taubin's filter: each iteration shrinks, then inflates, along the vertex
/// normals, which removes noise and preserves large shapes. Without a limit, sharp edges get
/// rounder; smooth_keeping_edges keeps them.
///
/// Boundary vertices do not move. Vertices that move beyond their sigma are marked as displaced.
///
/// @missing  a mesh without sigma has no limit; a vertex whose sigma is NaN does not move
/// @errors   Error(Input) for a negative option, for more than kMostSmoothIterations, or when
/// `only` is not one flag per triangle;
///          Error(Cancelled)
/// @source   Taubin 1995, A Signal Processing Approach to Fair Surface Design
[[nodiscard]] Mesh smooth_taubin(Mesh mesh, const SmoothOptions& options = {}, const Run& run = {});

/// Options of smoothing that keeps sharp edges.
struct KeepEdgesOptions {
  /// Iterations, limit of movement and selection.
  SmoothOptions smooth{.iterations = 8, .max_sigmas = 3.0, .only = {}};
  /// Width of the Gaussian weight over the angle between two normals: a larger angle is an edge.
  double crease_rad = 0.35;
};

/// Smooths a mesh and keeps sharp edges: a bilateral filter smooths the triangle normals, then the
/// vertices move to fit them.
///
/// @errors   as smooth_taubin
/// @source   Zheng, Fu, Au & Tai 2011, Bilateral Normal Filtering for Mesh Denoising (local
///          scheme); vertices by Sun, Rosin, Martin & Langbein 2007
[[nodiscard]] Mesh smooth_keeping_edges(Mesh mesh,
                                        const KeepEdgesOptions& options = {},
                                        const Run& run = {});

}  // namespace frangia
