#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A subsampled view: oriented points (surfels) at every `stride`-th pixel where the surface is
/// smooth. The maps of all views fit into memory together.
///
/// @units    mm, rig frame
/// @missing  sigma 0
struct SurfelMap {
  /// An oriented point of the surface; `sigma_mm` 0 marks a missing one.
  struct Surfel {
    /// The pixel's own point: the mean of its window is biased where the surface is curved.
    Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the camera
    float sigma_mm = 0.0F;                             ///< standard deviation along the normal
  };

  int stride = 1;         ///< distance of neighbouring surfels in pixels
  int first_column = 0;   ///< of `surfels`, in strides from the left edge of the view
  int first_row = 0;      ///< of `surfels`, in strides from the top edge of the view
  Image<Surfel> surfels;  ///< surfel (x, y) is pixel ((first_column + x) stride,
                          ///< (first_row + y) stride)
};

/// The smallest distance of neighbouring surfels, in pixels, with which a map of an image holds at
/// most about `pixels` surfels.
[[nodiscard]] int surfel_stride(int width, int height, std::size_t pixels);

/// Builds a surfel map of at most about `pixels` surfels. It covers the part of the view that has
/// surfels.
///
/// @units    mm, rig frame
/// @shape    `view` needs the planes of every `surfel_stride`-th pixel, see `LocalPlanesOptions`
/// @missing  a pixel at a crease or a depth step, or without a centered window, has no surfel
[[nodiscard]] SurfelMap make_surfel_map(const LocalPlanes& view,
                                        const CameraRays& camera,
                                        std::size_t pixels);

/// Picks about `count` surfels spread evenly over the image; all when the map has fewer.
[[nodiscard]] std::vector<SurfelMap::Surfel> pick_surfels(const SurfelMap& map, std::size_t count);

/// Number of surfels of a view that keeps them denser than the pairs of the registration.
inline constexpr std::size_t kSurfelsPerView = 250'000;

/// Largest number of surfels in the map of one view. It shrinks with the number of views from 24
/// on, so that the maps of all views hold six million surfels (170 MB) at most.
[[nodiscard]] std::size_t surfel_budget(std::size_t pixels, std::size_t views);

/// Builds the surfel map of every view. Each view is loaded once.
///
/// @shape    one map for each view, each of at most about `surfel_budget(pixels, views.size())`
///          surfels
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                                      const CameraModel& camera,
                                                      std::size_t pixels = kSurfelsPerView,
                                                      const Run& run = {});

}  // namespace frangia
