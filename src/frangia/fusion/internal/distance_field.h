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

/// How far from a measured point the field reaches, along the surface's normal.
struct TruncationBand {
  double voxel_mm = 0.0;
  double front_mm = 0.0;       ///< towards the camera
  double back_mm = 0.0;        ///< into the object
  double falloff_mm = 0.0;     ///< a view's word on what lies deeper than this counts little
  double allocation_mm = 0.0;  ///< blocks are made where the surface may be, no farther than this
  double unit_weight = 1.0;    ///< 1/mm^2; weights of what was not measured are shares of it
};

/// Signed distance to the surface in the object frame, positive outside, averaged over the views.
///
/// Kept in blocks of 8^3 voxels that exist near the surface only. Voxel (i, j, k) is the point
/// `voxel_mm * (i, j, k)`; it belongs to block (i >> 3, j >> 3, k >> 3).
struct DistanceField {
  static constexpr int kEdge = 8;
  static constexpr std::size_t kVoxels = std::size_t{kEdge} * kEdge * kEdge;

  struct Voxel {
    float weighted_mm;  ///< sum of weight * distance
    float weight;       ///< 0 where no view has spoken
  };
  using Block = std::array<Voxel, kVoxels>;  ///< x runs fastest

  double voxel_mm = 0.0;
  std::vector<Eigen::Vector3i> block_coords;  ///< of each block, in blocks
  ChunkedVector<Block> blocks;
  BlockIndex index;
};

/// Adds what one view saw to the blocks within its band, making those that are new.
///
/// A voxel takes the distance from the plane of the quad that it projects into, never across a
/// depth step, weighted by cos^2/sigma^2 and, behind the surface, less and less.
/// source   Curless & Levoy 1996; Niessner et al. 2013
void integrate_view(DistanceField& field,
                    const LocalPlanes& view,
                    const CameraRays& camera,
                    const TruncationBand& band);

}  // namespace frangia
