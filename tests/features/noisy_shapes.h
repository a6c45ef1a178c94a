#pragma once

#include <cmath>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/geometry/mesh.h"

namespace frangia::testing {

/// Adds a grid of nu x nv vertices, `place(u, v)` for u and v from 0 to 1, with normal noise.
/// Triangles face along the cross product of the derivatives by u and v.
template <typename Place>
void add_patch(
    Mesh& mesh, int nu, int nv, double noise_mm, std::uint64_t seed, const Place& place) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (int i = 0; i < nu; ++i) {
    for (int k = 0; k < nv; ++k) {
      const Eigen::Vector3d at = place(i / (nu - 1.0), k / (nv - 1.0));
      const auto number = static_cast<std::uint64_t>(i * nv + k);
      Eigen::Vector3d noise;
      for (int side = 0; side < 3; ++side)
        noise[side] =
            noise_mm * normal_from(hash(hash(seed, number), static_cast<std::uint64_t>(side)));
      mesh.vertices_mm.emplace_back((at + noise).cast<float>());
    }
  }
  for (int i = 0; i + 1 < nu; ++i) {
    for (int k = 0; k + 1 < nv; ++k) {
      const auto a = first + static_cast<std::uint32_t>(i * nv + k);
      const auto b = a + static_cast<std::uint32_t>(nv);
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
}

/// A sector of a cylinder about z.
inline Mesh noisy_cylinder(double radius,
                           double height,
                           double noise_mm,
                           std::uint64_t seed,
                           int around = 120,
                           int along = 40) {
  Mesh mesh;
  add_patch(mesh, around, along, noise_mm, seed, [&](double u, double v) {
    const double angle = kTwoPi * u;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height * v);
  });
  return mesh;
}

}  // namespace frangia::testing
