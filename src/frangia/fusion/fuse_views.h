#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/view_weights.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/sigma_terms.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Resolution, memory and thresholds of the fusion of views into one surface.
struct FusionOptions {
  double voxel_mm = 0.0;          ///< edge of a voxel; 0 derives it from the sampling of the views
  std::size_t max_memory_mb = 0;  ///< of the surface during fusion; 0 is half of the machine's
  std::vector<SigmaTerm> terms;   ///< systematic parts that are not stored with the views
  std::size_t min_component_triangles = 100;  ///< smaller connected components are removed
  FusionParameters parameters;                ///< heuristic thresholds
};

/// The views of one camera.
struct CameraViews {
  const ViewStore& views;     ///< its points
  const CameraModel& camera;  ///< in whose frame the points of the views are
};

/// A surface, and how much each view counted in it.
struct FusedSurface {
  Mesh mesh;            ///< as of `fuse_views`
  ViewWeights weights;  ///< by the number of a view in the store of its camera
};

/// Fuses all views into one mesh with normals, sigma and the number of views at each vertex.
///
/// Where a systematic part of the uncertainty is known of any view, the mesh holds both parts of
/// sigma and their combination. The weights are those of noise, so that the systematic part does
/// not change the shape. Noise falls with the number of observations; the systematic part of a
/// vertex is the weighted mean of those of the observations, projected onto the normal.
///
/// The views are averaged as signed distances near the surface, each weighted by cos^2/sigma^2.
/// Where the average crosses zero on an edge of the voxel grid, each view is sampled again: views
/// that observed the surface there contribute its position and normal, views that observed free
/// space there vote against it. Dual contouring places the vertices and preserves sharp edges.
/// Memory holds one view, the range of the next one, and the surface.
/// @units    mm, object frame
/// @missing  the mesh stays open where no view observed the surface
/// @errors   Error(Input) when no view holds a point, and when the voxels need more memory than
///          allowed; the message then names a voxel size that fits
/// @source   signed distance in a hashed grid: Curless & Levoy 1996, Niessner et al. 2013;
/// vertices:
///          Ju et al. 2002
[[nodiscard]] Mesh fuse_views(const ViewStore& views,
                              const CameraModel& camera,
                              const FusionOptions& options = {},
                              const Run& run = {});

/// Fuses the views of several cameras. Their poses are those of the object in the frame of their
/// camera.
///
/// @errors   as for one camera; Error(Input) when there is no camera
[[nodiscard]] Mesh fuse_views(std::span<const CameraViews> cameras,
                              const FusionOptions& options = {},
                              const Run& run = {});

/// The same, with the weights that it used.
[[nodiscard]] FusedSurface fuse_with_weights(std::span<const CameraViews> cameras,
                                             const FusionOptions& options = {},
                                             const Run& run = {});

}  // namespace frangia
