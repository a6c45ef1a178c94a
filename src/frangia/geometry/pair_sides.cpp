#include "frangia/geometry/pair_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

namespace frangia {
namespace {

/// The angle of a triangle about its edge from a direction across the edge, in small steps.
std::int64_t angle_about_edge(const Eigen::Vector3d& way,
                              const Eigen::Vector3d& along,
                              const Eigen::Vector3d& across) {
  const double angle_rad = std::atan2(along.cross(across).dot(way), across.dot(way));
  constexpr double kStep_rad = 1e-6;  // faces in one plane are at one angle, also at half a turn
  constexpr double kPi_rad = 3.14159265358979323846;
  return angle_rad < kStep_rad - kPi_rad ? std::llround(kPi_rad / kStep_rad)
                                         : std::llround(angle_rad / kStep_rad);
}

}  // namespace

bool is_inside_out(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices_mm[mesh.triangles[0][0]].cast<double>();
    const auto from_origin = [&](std::uint32_t vertex) -> Eigen::Vector3d {
      return mesh.vertices_mm[vertex].cast<double>() - origin;
    };
    volume += from_origin(a).dot(from_origin(b).cross(from_origin(c)));
  }
  return volume < 0.0;
}

std::vector<std::size_t> pair_sides(const Eigen::Vector3d& first_end_mm,
                                    const Eigen::Vector3d& second_end_mm,
                                    std::span<const EdgeSide> sides) {
  std::vector<std::size_t> partner(sides.size(), kNoPartner);
  const auto connect = [&](std::size_t a, std::size_t b) {
    partner[a] = b;
    partner[b] = a;
  };
  std::vector<std::size_t> order(sides.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sides[a].shell < sides[b].shell;
  });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && sides[order[end]].shell == sides[order[begin]].shell)
      ++end;
    if (end - begin == 2) connect(order[begin], order[begin + 1]);
    begin = end;
  }
  const Eigen::Vector3d along = (second_end_mm - first_end_mm).normalized();
  const Eigen::Vector3d across = along.unitOrthogonal();
  struct Turned {
    std::int64_t angle;
    std::size_t side;
  };
  std::vector<Turned> turned;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (partner[i] == kNoPartner)
      turned.push_back({angle_about_edge(sides[i].apex_mm - first_end_mm, along, across), i});
  }
  std::sort(turned.begin(), turned.end(), [&](const Turned& a, const Turned& b) {
    // At one angle an upward side comes first: bodies that touch with a face stay apart.
    return std::tuple(a.angle, !sides[a.side].upward, a.side) <
           std::tuple(b.angle, !sides[b.side].upward, b.side);
  });
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const std::size_t down = turned[i].side;
    const std::size_t up = turned[(i + 1) % turned.size()].side;
    if (!sides[down].upward && sides[up].upward) connect(down, up);
  }
  return partner;
}

}  // namespace frangia
