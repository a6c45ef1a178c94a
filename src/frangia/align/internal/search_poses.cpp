#include "frangia/align/internal/search_poses.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr int kGridCells = 32;             ///< along the longest side of the reference
constexpr double kGridMargin = 0.2;        ///< beyond the reference, of its longest side
constexpr std::size_t kQuickSamples = 70;  ///< that rate a start
constexpr std::size_t kCoarseSamples = 260;
constexpr std::size_t kFineSamples = 1500;
constexpr std::size_t kPairs = 24;  ///< pairs of points that give a translation, a rotation
constexpr std::size_t kKeptStarts = 600;
constexpr std::size_t kKeptCoarse = 40;
constexpr double kCoarseReach = 0.05;  ///< of the reference's size

/// Even samples of all rotations.
Eigen::Quaterniond even_rotation(std::size_t i, std::size_t count) {
  // Alexa 2022, Super-Fibonacci spirals.
  constexpr double kPhi = 1.4142135623730951;
  constexpr double kPsi = 1.533751168755204288118041;
  const double s = static_cast<double>(i) + 0.5;
  const double t = s / static_cast<double>(count);
  const double d = kTwoPi * s;
  const double r = std::sqrt(t);
  const double rest = std::sqrt(1.0 - t);
  const double alpha = d / kPhi;
  const double beta = d / kPsi;
  return {rest * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), rest * std::sin(beta)};
}

Vector3d center_of(std::span<const MeasuredSample> samples) {
  Vector3d center = Vector3d::Zero();
  for (const MeasuredSample& sample : samples)
    center += sample.point_mm / static_cast<double>(samples.size());
  return center;
}

double cost_of(std::span<const MeasuredSample> samples,
               const FindFoot& find_foot,
               const Eigen::Isometry3d& pose,
               double reach_mm) {
  double sum = 0.0;
  for (const MeasuredSample& sample : samples) {
    const Vector3d point = pose * sample.point_mm;
    const auto foot = find_foot(point, reach_mm);
    double share = 1.0;
    if (foot && (pose.linear() * sample.normal).dot(foot->normal) > 0.5)
      share = std::min(1.0, (point - foot->point_mm).squaredNorm() / (reach_mm * reach_mm));
    sum += share;
  }
  return sum / static_cast<double>(samples.size());
}

bool is_better(const RatedPose& a, const RatedPose& b) {
  return a.cost < b.cost;
}

/// The best poses, leaving out those that are near a better one.
std::vector<RatedPose> distinct(std::vector<RatedPose> poses,
                                std::span<const MeasuredSample> samples,
                                double apart_mm,
                                std::size_t most) {
  std::stable_sort(poses.begin(), poses.end(), is_better);
  std::vector<RatedPose> kept;
  for (const RatedPose& pose : poses) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const RatedPose& other) {
      return pose_distance_mm(samples, pose.pose, other.pose) < apart_mm;
    });
    if (!near) kept.push_back(pose);
    if (kept.size() == most) break;
  }
  return kept;
}

}  // namespace

CoarseFeet::CoarseFeet(const RayScene& reference, const Run& run) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : reference.mesh().vertices_mm)
    box.extend(vertex.cast<double>());
  const double side = box.sizes().maxCoeff();
  cell_mm_ = side / kGridCells;
  origin_ = box.min() - Vector3d::Constant(kGridMargin * side);
  size_ = ((box.sizes().array() + 2.0 * kGridMargin * side) / cell_mm_).cast<int>() + 1;
  const auto count = static_cast<std::size_t>(size_.prod());
  points_.resize(count);
  normals_.resize(count);
  const FindFoot exact = exact_feet(reference);
  interruptible_chunks(count, 512, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto number = static_cast<int>(i);
      const Eigen::Array3i at(
          number % size_.x(), number / size_.x() % size_.y(), number / (size_.x() * size_.y()));
      const Vector3d point = origin_ + cell_mm_ * (at.cast<double>() + 0.5).matrix();
      const auto foot = exact(point, 4.0 * side);
      points_[i] = foot ? Eigen::Vector3f(foot->point_mm.cast<float>()) : point.cast<float>();
      normals_[i] = foot ? Eigen::Vector3f(foot->normal.cast<float>()) : Eigen::Vector3f::Zero();
    }
  });
}

std::optional<Foot> CoarseFeet::of(const Vector3d& point_mm) const {
  const Eigen::Array3d place = (point_mm - origin_).array() / cell_mm_;
  if ((place < 0.0).any() || (place >= size_.cast<double>()).any()) return std::nullopt;
  const Eigen::Array3i at = place.cast<int>();
  const auto i = static_cast<std::size_t>((at.z() * size_.y() + at.y()) * size_.x() + at.x());
  return Foot{points_[i].cast<double>(), normals_[i].cast<double>()};
}

double pose_distance_mm(std::span<const MeasuredSample> samples,
                        const Eigen::Isometry3d& a,
                        const Eigen::Isometry3d& b) {
  const std::size_t count = std::min<std::size_t>(samples.size(), 64);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    sum += (a * samples[i].point_mm - b * samples[i].point_mm).squaredNorm();
  return std::sqrt(sum / static_cast<double>(count));
}

std::vector<RatedPose> search_poses(std::span<const MeasuredSample> samples,
                                    std::span<const MeasuredSample> reference_samples,
                                    const RayScene& reference,
                                    std::size_t rotations,
                                    std::uint64_t seed,
                                    const Run& run) {
  const CoarseFeet grid(reference, run);
  const FindFoot coarse = [&grid](const Vector3d& point, double /*reach*/) {
    return grid.of(point);
  };
  const FindFoot exact = exact_feet(reference);
  const Vector3d center = center_of(samples);
  const Vector3d reference_center = center_of(reference_samples);
  double size = 0.0;
  for (const MeasuredSample& sample : reference_samples)
    size = std::max(size, 2.0 * (sample.point_mm - reference_center).norm());
  const double reach = std::max(kCoarseReach * size, 2.0 * grid.cell_mm());
  const auto quick = samples.first(std::min(samples.size(), kQuickSamples));
  const auto some = samples.first(std::min(samples.size(), kCoarseSamples));
  const auto many = samples.first(std::min(samples.size(), kFineSamples));

  // A rotation with the translation between the centers, or between two points with like normals.
  constexpr std::size_t kKeptTranslations = 3;  // of each rotation
  std::vector<RatedPose> starts(rotations * kKeptTranslations,
                                {Eigen::Isometry3d::Identity(), 2.0});
  interruptible_chunks(rotations, 4, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Matrix3d turn = even_rotation(i, rotations).toRotationMatrix();
      std::vector<RatedPose> own;
      for (std::size_t pair = 0; pair <= kPairs; ++pair) {
        RatedPose rated;
        rated.pose.linear() = turn;
        rated.pose.translation() = reference_center - turn * center;
        if (pair > 0) {
          const std::uint64_t random = hash(hash(seed, i), pair);
          const MeasuredSample& from = samples[random % samples.size()];
          const MeasuredSample* to = nullptr;
          for (std::uint64_t attempt = 0; attempt < 12 && to == nullptr; ++attempt) {
            const auto& candidate =
                reference_samples[hash(random, attempt) % reference_samples.size()];
            if ((turn * from.normal).dot(candidate.normal) > 0.9) to = &candidate;
          }
          if (to == nullptr) continue;
          rated.pose.translation() = to->point_mm - turn * from.point_mm;
        }
        rated.cost = cost_of(quick, coarse, rated.pose, 2.0 * reach);
        own.push_back(rated);
      }
      std::stable_sort(own.begin() + 1, own.end(), is_better);  // the centers' stays
      for (std::size_t k = 0; k < std::min(kKeptTranslations, own.size()); ++k)
        starts[i * kKeptTranslations + k] = own[k];
    }
  });
  run.report(0.2);
  std::stable_sort(starts.begin(), starts.end(), is_better);
  starts.resize(std::min(starts.size(), kKeptStarts));
  interruptible_chunks(starts.size(), 2, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PoseFitOptions options{.gate_mm = 3.0 * reach,
                                   .least_gate_mm = reach,
                                   .least_cosine = 0.5,
                                   .max_iterations = 14};
      starts[i].pose = fit_pose(some, coarse, starts[i].pose, options, {}).pose;
      starts[i].cost = cost_of(some, coarse, starts[i].pose, reach);
    }
  });
  run.report(0.5);
  std::vector<RatedPose> poses = distinct(std::move(starts), some, 0.01 * size, kKeptCoarse);
  interruptible_chunks(poses.size(), 1, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PoseFitOptions options{.gate_mm = reach,
                                   .least_gate_mm = 1e-3 * size,
                                   .least_cosine = 0.5,
                                   .max_iterations = 25};
      poses[i].pose = fit_pose(some, exact, poses[i].pose, options, {}).pose;
      poses[i].cost = cost_of(many, exact, poses[i].pose, 0.005 * size);
    }
  });
  run.report(0.8);
  return distinct(std::move(poses), some, 0.004 * size, kKeptCoarse);
}

}  // namespace frangia
