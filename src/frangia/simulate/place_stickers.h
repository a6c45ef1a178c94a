#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/target_set.h"

namespace frangia {

/// A printed target on the surface of a part.
///
/// @units    mm, frame of the part
struct Sticker {
  int code = -1;                                        ///< -1: a disc
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< on the surface
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();    ///< unit, outwards
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();     ///< unit, along the rows of a marker
};

/// Reflectance of a part with stickers at a point of its surface; NaN beside them.
[[nodiscard]] double sticker_albedo(const TargetSet& targets,
                                    const std::vector<Sticker>& stickers,
                                    const Eigen::Vector3d& point_mm);

/// Places stickers on flat places of a part, as far from each other as they can be: first discs,
/// then coded ones with the codes 0, 1, ...
///
/// @errors   Error(Input) when the part has not enough flat places
[[nodiscard]] std::vector<Sticker> place_stickers(const Mesh& part,
                                                  const TargetSet& targets,
                                                  std::size_t discs,
                                                  std::size_t coded,
                                                  std::uint64_t seed,
                                                  const Run& run = {});

}  // namespace frangia
