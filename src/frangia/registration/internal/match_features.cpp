#include "frangia/registration/internal/match_features.h"

#include <algorithm>
#include <cmath>

namespace frangia {
namespace {

/// The columns that differ most from the mean of all, in their order.
std::vector<std::uint32_t> distinct_of(const Eigen::MatrixXf& features,
                                       const MatchOptions& options) {
  std::vector<std::uint32_t> seen;
  Eigen::VectorXf mean = Eigen::VectorXf::Zero(features.rows());
  for (Eigen::Index i = 0; i < features.cols(); ++i) {
    if (!(features.col(i).squaredNorm() > 0.0F)) continue;
    seen.push_back(static_cast<std::uint32_t>(i));
    mean += features.col(i);
  }
  if (seen.empty()) return seen;
  mean /= static_cast<float>(seen.size());
  const auto apart = [&](std::uint32_t i) {
    return (features.col(static_cast<Eigen::Index>(i)) - mean).squaredNorm();
  };
  std::stable_sort(seen.begin(), seen.end(), [&](std::uint32_t a, std::uint32_t b) {
    return apart(a) > apart(b);
  });
  const auto kept =
      static_cast<std::size_t>(std::ceil(options.distinct * static_cast<double>(seen.size())));
  seen.resize(std::min({seen.size(), kept, options.max_points}));
  std::sort(seen.begin(), seen.end());
  return seen;
}

Eigen::MatrixXf columns_of(const Eigen::MatrixXf& features,
                           const std::vector<std::uint32_t>& which) {
  Eigen::MatrixXf some(features.rows(), static_cast<Eigen::Index>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i)
    some.col(static_cast<Eigen::Index>(i)) = features.col(static_cast<Eigen::Index>(which[i]));
  return some;
}

}  // namespace

std::vector<FeatureMatch> match_features(const Eigen::MatrixXf& from,
                                         const Eigen::MatrixXf& to,
                                         const MatchOptions& options) {
  const auto left = distinct_of(from, options);
  const auto right = distinct_of(to, options);
  if (left.empty() || right.empty()) return {};
  // All columns have the same length: the largest product is the smallest distance.
  const Eigen::MatrixXf likeness = columns_of(from, left).transpose() * columns_of(to, right);
  std::vector<FeatureMatch> matches;
  Eigen::Index best = 0;
  for (Eigen::Index i = 0; i < likeness.rows(); ++i) {
    likeness.row(i).maxCoeff(&best);
    matches.push_back({left[static_cast<std::size_t>(i)], right[static_cast<std::size_t>(best)]});
  }
  for (Eigen::Index j = 0; j < likeness.cols(); ++j) {
    likeness.col(j).maxCoeff(&best);
    matches.push_back({left[static_cast<std::size_t>(best)], right[static_cast<std::size_t>(j)]});
  }
  const auto before = [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  };
  std::sort(matches.begin(), matches.end(), before);
  matches.erase(std::unique(matches.begin(), matches.end()), matches.end());
  return matches;
}

}  // namespace frangia
