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
  const Eigen::Vector3d along = (second_end_mm - first_end_mm).normalized();
  const Eigen::Vector3d across = along.unitOrthogonal();
  struct Turned {
    std::int64_t angle;
    std::size_t side;
  };
  std::vector<Turned> turned;
  for (std::size_t i = 0; i < sides.size(); ++i)
    turned.push_back({angle_about_edge(sides[i].apex_mm - first_end_mm, along, across), i});
  std::stable_sort(turned.begin(), turned.end(), [&](const Turned& a, const Turned& b) {
    return sides[a.side].shell < sides[b.side].shell;
  });
  for (std::size_t begin = 0; begin < turned.size();) {
    std::size_t end = begin;
    while (end < turned.size() && sides[turned[end].side].shell == sides[turned[begin].side].shell)
      ++end;
    // A triangle and its back, which run together, are no pair.
    if (end - begin == 2 && turned[begin].angle != turned[begin + 1].angle)
      connect(turned[begin].side, turned[begin + 1].side);
    begin = end;
  }
  std::erase_if(turned, [&](const Turned& one) { return partner[one.side] != kNoPartner; });
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
