#include "frangia/registration/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace frangia {
namespace {

/// Sort key of a point: its cube and the direction that it faces.
struct CellEntry {
  std::array<std::int32_t, 4> cube{};
  std::uint32_t point = 0;

  bool operator<(const CellEntry& other) const {
    return cube != other.cube ? cube < other.cube : point < other.point;
  }
};

std::int32_t side_of(const Eigen::Vector3f& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::int32_t>(2 * axis + (normal[axis] < 0.0F ? 1 : 0));
}

void add_mean(SurfacePoints& thin,
              const SurfacePoints& points,
              std::vector<CellEntry>::const_iterator begin,
              std::vector<CellEntry>::const_iterator end) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (auto entry = begin; entry != end; ++entry) {
    mean += points.points_mm[entry->point];
    normal += points.normals[entry->point];
  }
  mean /= static_cast<float>(end - begin);
  const auto away = [&](const CellEntry& entry) {
    return (points.points_mm[entry.point] - mean).squaredNorm();
  };
  const auto nearest = std::min_element(
      begin, end, [&](const CellEntry& a, const CellEntry& b) { return away(a) < away(b); });
  thin.add(points.points_mm[nearest->point], normal.normalized());
}

}  // namespace

void SurfacePoints::add(const SurfacePoints& other, const Eigen::Isometry3d& move) {
  const Eigen::Isometry3f by = move.cast<float>();
  for (std::size_t i = 0; i < other.size(); ++i)
    add(by * other.points_mm[i], by.linear() * other.normals[i]);
}

SurfacePoints voxel_downsample(const SurfacePoints& points, double spacing_mm) {
  std::vector<CellEntry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f cell = points.points_mm[i] / static_cast<float>(spacing_mm);
    entries[i].point = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 3; ++k)
      entries[i].cube[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::floor(cell[k]));
    entries[i].cube[3] = side_of(points.normals[i]);
  }
  std::sort(entries.begin(), entries.end());
  SurfacePoints thin;
  for (auto begin = entries.cbegin(); begin != entries.cend();) {
    const auto end = std::find_if(
        begin, entries.cend(), [&](const CellEntry& entry) { return entry.cube != begin->cube; });
    add_mean(thin, points, begin, end);
    begin = end;
  }
  return thin;
}

}  // namespace frangia
