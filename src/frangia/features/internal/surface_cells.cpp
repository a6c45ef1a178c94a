#include "frangia/features/internal/surface_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Place of a cell in the grid and the coordinate axis of its normals, as one number.
class CellKeys {
 public:
  CellKeys(const FeaturePoints& points, double edge_mm) : edge_mm_(edge_mm) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : points.points_mm)
      box.extend(point);
    origin_ = box.min() - Vector3d::Constant(edge_mm);
    for (int i = 0; i < 3; ++i)
      size_[static_cast<std::size_t>(i)] =
          static_cast<std::uint64_t>(box.sizes()[i] / edge_mm) + 3U;
  }
  [[nodiscard]] std::uint64_t of(const Vector3d& point, const Vector3d& normal) const {
    Eigen::Index side = 0;
    normal.cwiseAbs().maxCoeff(&side);
    const std::uint64_t side6 =
        2U * static_cast<std::uint64_t>(side) + (normal[side] < 0.0 ? 1U : 0U);
    const Vector3d place = (point - origin_) / edge_mm_;
    const auto x = static_cast<std::uint64_t>(place.x());
    const auto y = static_cast<std::uint64_t>(place.y());
    const auto z = static_cast<std::uint64_t>(place.z());
    return ((z * size_[1] + y) * size_[0] + x) * 6U + side6;
  }
  /// The key of the first of the six cells at a place near that of `key`.
  [[nodiscard]] std::uint64_t beside(std::uint64_t key, int dx, int dy, int dz) const {
    const auto sx = static_cast<std::int64_t>(size_[0]);
    const auto sy = static_cast<std::int64_t>(size_[1]);
    return (key / 6U + static_cast<std::uint64_t>((dz * sy + dy) * sx + dx)) * 6U;
  }

 private:
  double edge_mm_;
  Vector3d origin_;
  std::array<std::uint64_t, 3> size_{};
};

void add_means(SurfaceCells& cells, const FeaturePoints& points) {
  for (std::uint32_t cell = 0; cell + 1 < cells.first_point.size(); ++cell) {
    Vector3d mean = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    const auto own = cells.points_of(cell);
    for (const std::uint32_t point : own) {
      mean += points.points_mm[point];
      normal += points.normals[point];
    }
    mean /= static_cast<double>(own.size());
    std::uint32_t nearest = own.front();
    for (const std::uint32_t point : own) {
      if ((points.points_mm[point] - mean).squaredNorm() <
          (points.points_mm[nearest] - mean).squaredNorm())
        nearest = point;
    }
    cells.points_mm.push_back(points.points_mm[nearest]);
    cells.normals.push_back(normal.squaredNorm() > 0.0 ? normal.normalized()
                                                       : points.normals[nearest]);
  }
}

}  // namespace

SurfaceCells surface_cells(const FeaturePoints& points, std::size_t count, const Run& run) {
  SurfaceCells cells;
  cells.edge_mm = std::sqrt(points.area_mm2 / static_cast<double>(std::max<std::size_t>(1, count)));
  const CellKeys keys(points, cells.edge_mm);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    sorted[i] = {keys.of(points.points_mm[i], points.normals[i]), i};
  run.check();
  std::sort(sorted.begin(), sorted.end());
  run.check();
  std::vector<std::uint64_t> own_keys;
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].first != sorted[i - 1].first) {
      own_keys.push_back(sorted[i].first);
      cells.first_point.push_back(i);
    }
    cells.point_numbers.push_back(sorted[i].second);
  }
  cells.first_point.push_back(static_cast<std::uint32_t>(sorted.size()));
  add_means(cells, points);
  run.check();

  constexpr double kLeastCosine = 0.5;  // between the normals of neighbours
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    cells.first_neighbor.push_back(static_cast<std::uint32_t>(cells.neighbors.size()));
    for (int place = 0; place < 9; ++place) {
      // Cells that follow each other along x have keys that follow each other.
      const std::uint64_t from = keys.beside(own_keys[cell], -1, place % 3 - 1, place / 3 - 1);
      auto at = std::lower_bound(own_keys.begin(), own_keys.end(), from);
      for (; at != own_keys.end() && *at < from + 18U; ++at) {
        const auto other = static_cast<std::uint32_t>(at - own_keys.begin());
        if (other != cell && cells.normals[cell].dot(cells.normals[other]) > kLeastCosine)
          cells.neighbors.push_back(other);
      }
    }
  }
  cells.first_neighbor.push_back(static_cast<std::uint32_t>(cells.neighbors.size()));
  return cells;
}

}  // namespace frangia
