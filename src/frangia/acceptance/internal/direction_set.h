#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Buckets of unit directions, so that the ones near a direction are found without trying all.
class DirectionSet {
 public:
  /// `radius_rad` is at most 6 degrees.
  DirectionSet(const std::vector<Eigen::Vector3d>& directions, double radius_rad)
      : cells_(count(kAcross)), least_cosine_(std::cos(radius_rad)) {
    for (const Eigen::Vector3d& direction : directions)
      cells_[index(cell(direction))].push_back(direction);
  }
  /// Whether the set has a direction within the radius of this one.
  [[nodiscard]] bool has_near(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3i middle = cell(direction);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Eigen::Vector3i at = middle + Eigen::Vector3i(x, y, z);
          if (at.minCoeff() < 0 || at.maxCoeff() >= kAcross) continue;
          for (const Eigen::Vector3d& other : cells_[index(at)])
            if (other.dot(direction) > least_cosine_) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr int kAcross = 18;  ///< cells of 0.11, above the chord of 6 degrees
  static std::size_t count(int across) {
    const auto n = static_cast<std::size_t>(across);
    return n * n * n;
  }
  static Eigen::Vector3i cell(const Eigen::Vector3d& direction) {
    return ((direction.array() + 1.0) * (0.5 * kAcross))
        .floor()
        .cast<int>()
        .max(0)
        .min(kAcross - 1)
        .matrix();
  }
  static std::size_t index(const Eigen::Vector3i& at) {
    const int cell = (at.z() * kAcross + at.y()) * kAcross + at.x();
    return static_cast<std::size_t>(cell);
  }
  std::vector<std::vector<Eigen::Vector3d>> cells_;
  double least_cosine_;
};

}  // namespace frangia
