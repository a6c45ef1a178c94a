#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// By view: the other views that it is compared with, in ascending order. Symmetric.
using ViewPairs = std::vector<std::vector<std::size_t>>;

/// Number of views up to which registration compares all of them with each other and uses as many
/// surfels of each as it can. Beyond it the work grows with the number of views, not with its
/// square, and the number of surfels of all views together stays that of this many views.
inline constexpr std::size_t kMaxFullViews = 24;

/// Every view with every other.
[[nodiscard]] ViewPairs all_view_pairs(std::size_t views);

/// Pairs of views that overlap: all pairs of up to `kMaxFullViews` views, else about a dozen for
/// each view. These are its nearest neighbours by rotation, and further views spread evenly from
/// its neighbours to the most rotated view that still sees the same surface.
///
/// @shape    `maps` and `rig_from_part`: one a view; the poses may be wrong by a small part of the
///          view
[[nodiscard]] ViewPairs choose_view_pairs(std::span<const SurfelMap> maps,
                                          const FastCameraModel& model,
                                          std::span<const Eigen::Isometry3d> rig_from_part);

/// Adds a pair, in both directions, unless it is present.
void add_view_pair(ViewPairs& pairs, std::size_t a, std::size_t b);

/// Number of comparisons of one view with another, both directions counted.
[[nodiscard]] std::size_t count_pairs(const ViewPairs& pairs);

/// Number of surfels of each view when `most` are used of each of up to `kMaxFullViews` views.
[[nodiscard]] std::size_t surfels_per_view(std::size_t most, std::size_t views);

}  // namespace frangia
