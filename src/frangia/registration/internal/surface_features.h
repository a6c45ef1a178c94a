#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/surface_points.h"

namespace frangia {

/// Describes the neighbourhood of each point, independent of its orientation, by a fast point
/// feature histogram of the angles between normals.
///
/// @shape    33 rows, one column a point: three angles of 11 bins, each the square root of its
///          share, so that the distance between columns is the Hellinger distance
/// @missing  a column of zeros where a point has fewer than five neighbours
/// @source   FPFH: Rusu, Blodow & Beetz 2009
[[nodiscard]] Eigen::MatrixXf surface_features(const SurfacePoints& points, double radius_mm);

/// Two points, one of each set, with similar features.
struct FeatureMatch {
  std::uint32_t from = 0;
  std::uint32_t to = 0;

  bool operator==(const FeatureMatch& other) const = default;
};

struct MatchOptions {
  double distinct = 0.6;          ///< share of the points that is matched: those that differ
                                  ///< most from the mean feature
  std::size_t max_points = 2000;  ///< of each set
};

/// Matches each distinctive point of either set with the point of the other set whose feature is
/// nearest. Points whose features are near the mean, such as those of flat faces, are not matched.
///
/// @shape    features as `surface_features` makes them; a column of zeros is matched with nothing
[[nodiscard]] std::vector<FeatureMatch> match_features(const Eigen::MatrixXf& from,
                                                       const Eigen::MatrixXf& to,
                                                       const MatchOptions& options = {});

}  // namespace frangia
