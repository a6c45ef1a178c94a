#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frangia {

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
