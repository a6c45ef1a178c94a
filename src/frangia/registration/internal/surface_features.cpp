#include "frangia/registration/internal/surface_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr int kBins = 11;
constexpr int kRows = 3 * kBins;
constexpr std::size_t kFewestNeighbors = 5;
constexpr std::size_t kFeaturesPerChunk = 64;

/// Points by cubes of the radius' size: all neighbours of a point lie in the 27 cubes around it.
class Cubes {
 public:
  Cubes(const SurfacePoints& points, float radius_mm) : points_(points), radius_(radius_mm) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cubes_[key(cell_of(points.points_mm[i]))].push_back(i);
  }

  /// All other points within the radius, ordered by cube.
  [[nodiscard]] std::vector<std::size_t> near(std::size_t point) const {
    std::vector<std::size_t> found;
    const Eigen::Vector3f& center = points_.points_mm[point];
    const Eigen::Array3i cell = cell_of(center);
    for (int i = 0; i < 27; ++i) {
      const auto cube =
          cubes_.find(key(cell + Eigen::Array3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (cube == cubes_.end()) continue;
      for (const std::size_t other : cube->second) {
        const float away = (points_.points_mm[other] - center).squaredNorm();
        if (other != point && away > 0.0F && away < radius_ * radius_) found.push_back(other);
      }
    }
    return found;
  }

 private:
  [[nodiscard]] Eigen::Array3i cell_of(const Eigen::Vector3f& point) const {
    return (point / radius_).array().floor().cast<int>();
  }
  static std::uint64_t key(const Eigen::Array3i& cell) {
    constexpr std::uint64_t kMask = (1U << 21U) - 1U;
    const auto part = [&](int i) { return static_cast<std::uint64_t>(cell[i]) & kMask; };
    return part(0) << 42U | part(1) << 21U | part(2);
  }

  const SurfacePoints& points_;
  float radius_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cubes_;
};

int bin_of(float value, float low, float high) {
  const int bin = static_cast<int>(static_cast<float>(kBins) * (value - low) / (high - low));
  return std::clamp(bin, 0, kBins - 1);
}

/// Counts the angles of one pair. The first point is the one whose normal is nearer to the line.
void count_pair(const SurfacePoints& points,
                std::size_t one,
                std::size_t other,
                Eigen::Ref<Eigen::VectorXf> histogram) {
  Eigen::Vector3f line = points.points_mm[other] - points.points_mm[one];
  line.normalize();
  Eigen::Vector3f u = points.normals[one];
  Eigen::Vector3f far = points.normals[other];
  if (std::abs(u.dot(line)) < std::abs(far.dot(line))) {
    std::swap(u, far);
    line = -line;
  }
  Eigen::Vector3f v = u.cross(line);
  if (!(v.squaredNorm() > 1e-12F)) return;
  v.normalize();
  const Eigen::Vector3f w = u.cross(v);
  const auto turn = static_cast<float>(kPi);
  histogram[bin_of(v.dot(far), -1.0F, 1.0F)] += 1.0F;
  histogram[kBins + bin_of(u.dot(line), -1.0F, 1.0F)] += 1.0F;
  histogram[2 * kBins + bin_of(std::atan2(w.dot(far), u.dot(far)), -turn, turn)] += 1.0F;
}

void take_hellinger_roots(Eigen::Ref<Eigen::VectorXf> column) {
  for (Eigen::Index angle = 0; angle < 3; ++angle) {
    auto part = column.segment<kBins>(angle * kBins);
    const float sum = part.sum();
    if (sum > 0.0F) part = (part / sum).cwiseSqrt().eval();
  }
}

}  // namespace

Eigen::MatrixXf surface_features(const SurfacePoints& points, double radius_mm) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Cubes cubes(points, static_cast<float>(radius_mm));
  std::vector<std::vector<std::size_t>> near(points.size());
  Eigen::MatrixXf simple = Eigen::MatrixXf::Zero(kRows, count);
  parallel_chunks(points.size(), kFeaturesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      near[i] = cubes.near(i);
      auto column = simple.col(static_cast<Eigen::Index>(i));
      for (const std::size_t other : near[i])
        count_pair(points, i, other, column);
      if (!near[i].empty()) column /= static_cast<float>(near[i].size());
    }
  });
  Eigen::MatrixXf features = Eigen::MatrixXf::Zero(kRows, count);
  parallel_chunks(points.size(), kFeaturesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (near[i].size() < kFewestNeighbors) continue;
      auto column = features.col(static_cast<Eigen::Index>(i));
      for (const std::size_t other : near[i]) {
        const float away = (points.points_mm[other] - points.points_mm[i]).norm();
        column +=
            simple.col(static_cast<Eigen::Index>(other)) * (static_cast<float>(radius_mm) / away);
      }
      column /= static_cast<float>(near[i].size());
      column += simple.col(static_cast<Eigen::Index>(i));
      take_hellinger_roots(column);
    }
  });
  return features;
}

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
