#include "frangia/registration/internal/find_motion_hypotheses.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/rigid_motion.h"

namespace frangia {
namespace {

constexpr double kSameAngle = 0.25;        // difference of two cosines, for normals of ten degrees
constexpr float kMinMatchedCosine = 0.7F;  // between the normals of matched points

/// A match with its points.
struct Pair {
  Eigen::Vector3f from, from_normal, to, to_normal;
};

using Pairs = std::vector<Pair>;

Pairs pairs_of(const SurfacePoints& from,
               const SurfacePoints& to,
               std::span<const FeatureMatch> matches) {
  Pairs pairs;
  for (const FeatureMatch& match : matches) {
    pairs.push_back({from.points_mm[match.from],
                     from.normals[match.from],
                     to.points_mm[match.to],
                     to.normals[match.to]});
  }
  return pairs;
}

bool are_compatible(const Pair& a, const Pair& b, float tolerance_mm) {
  const Eigen::Vector3f here = b.from - a.from;
  const Eigen::Vector3f there = b.to - a.to;
  const float long_here = here.norm();
  const float long_there = there.norm();
  if (std::abs(long_here - long_there) > tolerance_mm || long_here < 4.0F * tolerance_mm ||
      long_there < 4.0F * tolerance_mm)
    return false;
  constexpr auto kSame = static_cast<float>(kSameAngle);
  return std::abs(a.from_normal.dot(b.from_normal) - a.to_normal.dot(b.to_normal)) < kSame &&
         std::abs(a.from_normal.dot(here) / long_here - a.to_normal.dot(there) / long_there) <
             kSame &&
         std::abs(b.from_normal.dot(here) / long_here - b.to_normal.dot(there) / long_there) <
             kSame;
}

/// Compatibility of every two matches, one bit each.
class CompatibilityGraph {
 public:
  CompatibilityGraph(const Pairs& pairs, float tolerance_mm)
      : count_(pairs.size()), words_((pairs.size() + 63) / 64), bits_(count_ * words_, 0) {
    parallel_chunks(count_, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t j = 0; j < count_; ++j) {
          if (are_compatible(pairs[i], pairs[j], tolerance_mm))
            bits_[i * words_ + j / 64] |= std::uint64_t{1} << (j % 64);
        }
      }
    });
  }
  [[nodiscard]] bool fits(std::size_t i, std::size_t j) const {
    return (bits_[i * words_ + j / 64] >> (j % 64) & 1U) != 0;
  }
  /// Number of matches that are compatible with both.
  [[nodiscard]] int shared(std::size_t i, std::size_t j) const {
    int sum = 0;
    for (std::size_t word = 0; word < words_; ++word)
      sum += std::popcount(bits_[i * words_ + word] & bits_[j * words_ + word]);
    return sum;
  }
  [[nodiscard]] std::size_t size() const { return count_; }

 private:
  std::size_t count_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// The matches by their score, highest first.
std::vector<std::size_t> by_compatibility(const CompatibilityGraph& graph) {
  std::vector<std::int64_t> score(graph.size(), 0);
  parallel_chunks(graph.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = 0; j < graph.size(); ++j)
        if (graph.fits(i, j)) score[i] += graph.shared(i, j);
    }
  });
  std::vector<std::size_t> order(graph.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return score[a] > score[b];
  });
  return order;
}

/// A seed and the matches that share most compatible matches with it.
std::vector<std::size_t> consensus_of(std::size_t seed, const CompatibilityGraph& graph) {
  constexpr std::ptrdiff_t kMost = 12;  // enough for six unknowns and few wrong ones
  std::vector<std::pair<int, std::size_t>> others;
  for (std::size_t j = 0; j < graph.size(); ++j)
    if (graph.fits(seed, j)) others.emplace_back(-graph.shared(seed, j), j);
  const auto most = others.begin() + std::min(kMost, std::ssize(others));
  std::partial_sort(others.begin(), most, others.end());
  std::vector<std::size_t> consensus{seed};
  std::transform(others.begin(), most, std::back_inserter(consensus), [](const auto& other) {
    return other.second;
  });
  return consensus;
}

/// Least-squares motion of matched points and normals. A normal counts as a point at a distance of
/// `arm_mm` from the centroid.
Eigen::Isometry3d fit_motion(const Pairs& pairs,
                             const std::vector<std::size_t>& which,
                             float arm_mm) {
  Eigen::Vector3f from = Eigen::Vector3f::Zero();
  Eigen::Vector3f to = Eigen::Vector3f::Zero();
  for (const std::size_t i : which) {
    from += pairs[i].from;
    to += pairs[i].to;
  }
  from /= static_cast<float>(which.size());
  to /= static_cast<float>(which.size());
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const std::size_t i : which) {
    spread += (pairs[i].to - to) * (pairs[i].from - from).transpose();
    spread += arm_mm * arm_mm * pairs[i].to_normal * pairs[i].from_normal.transpose();
  }
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = nearest_rotation(spread.cast<double>());
  motion.translation() = to.cast<double>() - motion.linear() * from.cast<double>();
  return motion;
}

std::vector<std::size_t> inliers_of(const Pairs& pairs,
                                    const Eigen::Isometry3d& motion,
                                    float within_mm) {
  const Eigen::Isometry3f by = motion.cast<float>();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool near = (by * pairs[i].from - pairs[i].to).squaredNorm() < within_mm * within_mm;
    if (near && (by.linear() * pairs[i].from_normal).dot(pairs[i].to_normal) > kMinMatchedCosine)
      found.push_back(i);
  }
  return found;
}

}  // namespace

bool is_same_motion(const Eigen::Isometry3d& one,
                    const Eigen::Isometry3d& other,
                    const Eigen::Vector3d& center,
                    double radius_mm,
                    double within_mm) {
  const Eigen::Isometry3d between = one.inverse() * other;
  const double turned = Eigen::AngleAxisd(between.rotation()).angle();
  return (between * center - center).norm() + radius_mm * std::abs(turned) < within_mm;
}

std::vector<MotionHypothesis> find_motion_hypotheses(const SurfacePoints& from,
                                                     const SurfacePoints& to,
                                                     std::span<const FeatureMatch> matches,
                                                     const MotionHypothesisOptions& options) {
  constexpr std::size_t kFewest = 4;  // matches: three always fit some motion
  const auto tolerance_mm = static_cast<float>(options.tolerance_mm);
  const Pairs pairs = pairs_of(from, to, matches);
  const CompatibilityGraph graph(pairs, tolerance_mm);
  std::vector<MotionHypothesis> motions;
  std::vector<bool> explained(pairs.size(), false);
  std::size_t tried = 0;
  for (const std::size_t seed : by_compatibility(graph)) {
    if (explained[seed]) continue;
    if (++tried > options.seeds) break;
    std::vector<std::size_t> consensus = consensus_of(seed, graph);
    if (consensus.size() < kFewest) continue;
    MotionHypothesis motion;
    for (int turn = 0; turn < 3 && consensus.size() >= kFewest; ++turn) {
      motion.to_from = fit_motion(pairs, consensus, 4.0F * tolerance_mm);
      consensus = inliers_of(pairs, motion.to_from, 1.5F * tolerance_mm);
    }
    motion.matches = consensus.size();
    if (motion.matches < kFewest) continue;
    for (const std::size_t i : consensus)
      explained[i] = true;
    motions.push_back(motion);
  }
  std::stable_sort(
      motions.begin(), motions.end(), [](const MotionHypothesis& a, const MotionHypothesis& b) {
        return a.matches > b.matches;
      });
  motions.resize(std::min(motions.size(), options.max_hypotheses));
  return motions;
}

}  // namespace frangia
