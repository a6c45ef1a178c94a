#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace frangia::inspect {

/// Points in the cells of a grid, for searches within a radius.
class PatchGrid {
 public:
  /// @units    mm
  explicit PatchGrid(double cell_mm) : cell_mm_(cell_mm) {}

  /// Adds the point with the next index.
  void add(const Eigen::Vector3f& point) {
    cells_[key_of(cell_of(point))].push_back(static_cast<std::uint32_t>(points_.size()));
    points_.push_back(point);
  }

  /// Calls `visit(index, squared distance)` for each point within `radius_mm`, in a fixed order.
  template <typename Visit>
  void within(const Eigen::Vector3f& point, double radius_mm, const Visit& visit) const {
    const auto reach = Eigen::Vector3f::Constant(static_cast<float>(radius_mm));
    const Eigen::Vector3i low = cell_of(point - reach);
    const Eigen::Vector3i high = cell_of(point + reach);
    const auto limit = static_cast<float>(radius_mm * radius_mm);
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) {
          const auto found = cells_.find(key_of({x, y, z}));
          if (found == cells_.end()) continue;
          for (const std::uint32_t index : found->second) {
            const float squared = (points_[index] - point).squaredNorm();
            if (squared <= limit) visit(index, squared);
          }
        }
  }

 private:
  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3f& point) const {
    return (point.cast<double>() / cell_mm_).array().floor().cast<int>();
  }
  [[nodiscard]] static std::uint64_t key_of(const Eigen::Vector3i& cell) {
    constexpr int kHalf = 1 << 20;
    const auto part = [](int i) { return static_cast<std::uint64_t>(i + kHalf) & 0x1FFFFFU; };
    return part(cell.x()) << 42U | part(cell.y()) << 21U | part(cell.z());
  }

  double cell_mm_;
  std::vector<Eigen::Vector3f> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace frangia::inspect
