#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Two points, one of each set, that look alike.
struct FeatureMatch {
  std::uint32_t from = 0;
  std::uint32_t to = 0;

  bool operator==(const FeatureMatch& other) const = default;
};

struct MatchOptions {
  double distinct = 0.6;          ///< share of the points that is matched: those least like all
  std::size_t max_points = 2000;  ///< of each set
};

/// For the points of each set that differ most from the usual, the one of the other set that looks
/// most alike. Points of flat faces all look the same and would tell nothing.
///
/// shape    features as `surface_features` makes them; a column of zeros is matched with nothing
[[nodiscard]] std::vector<FeatureMatch> match_features(const Eigen::MatrixXf& from,
                                                       const Eigen::MatrixXf& to,
                                                       const MatchOptions& options = {});

}  // namespace frangia
