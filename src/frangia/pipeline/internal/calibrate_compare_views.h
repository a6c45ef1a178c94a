#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/rig/rig.h"

namespace frangia {

/// The grid of points of one view, and what is needed to compare another view with it.
struct PartView {
  std::vector<Eigen::Vector3d> points;  ///< by site, rig frame; NaN where missing
  Eigen::Isometry3d rig_from_zero = Eigen::Isometry3d::Identity();
};

struct SiteGrid {
  int step = 1;
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Distances between the surfaces of two views, averaged over patches.
struct PatchDistances {
  std::vector<double> mean_mm;   ///< signed, along the normal
  std::vector<double> sigma_mm;  ///< standard deviation of the mean
};

/// Distances of the points of one view from the surface of another, along its normals. Averaging
/// over patches of 8 x 8 sites reduces the noise and leaves what is wrong with the rig.
///
/// @units    mm
void compare_views(const PartView& from,
                   const PartView& to,
                   const SiteGrid& grid,
                   const Rig& rig,
                   double match_share,
                   PatchDistances& out);

}  // namespace frangia
