#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/chunked_vector.h"
#include "frangia/fusion/internal/block_index.h"
#include "frangia/local_fit/local_planes.h"

namespace frangia {

/// The truncation of the field around the surface of a view, along its normal, and the weights of
/// unmeasured voxels. `FieldParameters` explains the values.
struct TruncationBand {
  double voxel_mm = 0.0;
  double front_mm = 0.0;             ///< reach towards the camera
  double back_mm = 0.0;              ///< reach into the object
  double falloff_mm = 0.0;           ///< depth at which the weight has fallen to a quarter
  double allocation_mm = 0.0;        ///< blocks are allocated within this distance of a point
  double deepest_mm = 0.0;           ///< reach of `deep_weight` into the object
  double extrapolated_weight = 0.0;  ///< of an extrapolated distance, 1/mm^2
  double deep_weight = 0.0;          ///< of a voxel deeper than `back_mm`, 1/mm^2
};

inline constexpr int kBlockEdge = 8;  ///< voxels along the edge of a block of the distance field

/// Signed distance to the surface in the object frame, positive outside, averaged over the views.
///
/// Stored in blocks of 8^3 voxels, which are allocated near the surface only. Voxel (i, j, k) is
/// the point `voxel_mm * (i, j, k)`; it belongs to block (i >> 3, j >> 3, k >> 3).
struct DistanceField {
  static constexpr std::size_t kVoxels = std::size_t{kBlockEdge} * kBlockEdge * kBlockEdge;

  struct Voxel {
    float weighted_mm;  ///< sum of weight * distance
    float weight;       ///< 0 where no view has contributed
  };
  using Block = std::array<Voxel, kVoxels>;  ///< x runs fastest

  double voxel_mm = 0.0;
  std::vector<Eigen::Vector3i> block_coords;  ///< of each block, in units of blocks
  ChunkedVector<Block> blocks;
  BlockIndex index;
};

/// Adds the distances from one view's surface to the field and allocates the blocks it needs.
///
/// A voxel takes the distance from the plane of the quad that it projects into, never across a
/// depth step, weighted by cos^2/sigma^2. Behind the surface the weight decreases with depth.
/// @source   Curless & Levoy 1996; Niessner et al. 2013
void integrate_view(DistanceField& field,
                    const LocalPlanes& view,
                    const CameraRays& camera,
                    const TruncationBand& band);

}  // namespace frangia
