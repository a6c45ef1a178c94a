#include "frangia/views/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace frangia {
namespace {

/// The cube a point lies in and the side it faces, in an order.
struct Place {
  std::array<std::int32_t, 4> cube{};
  std::uint32_t point = 0;

  bool operator<(const Place& other) const {
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
              std::vector<Place>::const_iterator begin,
              std::vector<Place>::const_iterator end) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (auto place = begin; place != end; ++place) {
    mean += points.points_mm[place->point];
    normal += points.normals[place->point];
  }
  mean /= static_cast<float>(end - begin);
  const auto away = [&](const Place& place) {
    return (points.points_mm[place.point] - mean).squaredNorm();
  };
  const auto nearest = std::min_element(
      begin, end, [&](const Place& a, const Place& b) { return away(a) < away(b); });
  thin.add(points.points_mm[nearest->point], normal.normalized());
}

}  // namespace

void SurfacePoints::add(const SurfacePoints& other, const Eigen::Isometry3d& move) {
  const Eigen::Isometry3f by = move.cast<float>();
  for (std::size_t i = 0; i < other.size(); ++i)
    add(by * other.points_mm[i], by.linear() * other.normals[i]);
}

SurfacePoints thin_points(const SurfacePoints& points, double spacing_mm) {
  std::vector<Place> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f cell = points.points_mm[i] / static_cast<float>(spacing_mm);
    places[i].point = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 3; ++k)
      places[i].cube[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::floor(cell[k]));
    places[i].cube[3] = side_of(points.normals[i]);
  }
  std::sort(places.begin(), places.end());
  SurfacePoints thin;
  for (auto begin = places.cbegin(); begin != places.cend();) {
    const auto end = std::find_if(
        begin, places.cend(), [&](const Place& place) { return place.cube != begin->cube; });
    add_mean(thin, points, begin, end);
    begin = end;
  }
  return thin;
}

}  // namespace frangia
