#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
#include "frangia/simulate/internal/solid_builder.h"

namespace frangia::testing {

/// A solid of revolution about the z axis, by its outline (radius, height) from below to above; it
/// begins and ends on the axis.
inline Mesh turned(const std::vector<std::pair<double, double>>& outline) {
  constexpr int kAround = 256;
  SolidBuilder solid;
  Loop last;
  for (const auto& [radius, z] : outline) {
    const Eigen::Vector3d center(0.0, 0.0, z);
    const Loop next = radius > 0.0 ? circle(center, radius, kAround) : Loop{};
    if (last.empty() && !next.empty()) solid.add_fan({next.rbegin(), next.rend()}, {0.0, 0.0, z});
    if (!last.empty() && next.empty()) solid.add_fan(last, center);
    if (!last.empty() && !next.empty()) solid.add_band(last, next);
    last = next;
  }
  return solid.build();
}

/// Two solids that may overlap: rays from outside meet the surface of both together.
inline Mesh together(Mesh one, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(one.vertices_mm.size());
  one.vertices_mm.insert(one.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  for (const Mesh::Triangle& t : other.triangles)
    one.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return one;
}

/// A box that stands on z = 0 around the z axis.
inline Mesh upright_box(double x_mm, double y_mm, double z_mm) {
  const auto at = [&](double z) {
    return Loop{{-0.5 * x_mm, -0.5 * y_mm, z},
                {0.5 * x_mm, -0.5 * y_mm, z},
                {0.5 * x_mm, 0.5 * y_mm, z},
                {-0.5 * x_mm, 0.5 * y_mm, z}};
  };
  SolidBuilder solid;
  const Loop low = at(0.0);
  const Loop high = at(z_mm);
  solid.add_band(low, high);
  solid.add_face(high);
  solid.add_face({low.rbegin(), low.rend()});
  return solid.build();
}

/// A round boss on the face x = `face_mm` of a part.
inline Mesh boss(double face_mm, double y_mm, double z_mm, double radius_mm, double height_mm) {
  Mesh mesh = turned({{radius_mm, -1.0}, {radius_mm, height_mm}, {0.0, height_mm}});
  for (Eigen::Vector3f& vertex : mesh.vertices_mm) {
    vertex = {static_cast<float>(face_mm) + vertex.z(),
              static_cast<float>(y_mm) + vertex.x(),
              static_cast<float>(z_mm) + vertex.y()};
  }
  return mesh;
}

}  // namespace frangia::testing
