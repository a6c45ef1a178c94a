#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "frangia/core/random.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_verdict.h"

#include "support/test_meshes.h"

namespace frangia::testing {

inline constexpr float kSigma = 0.005F;

/// A plate of 60 x 60 mm with a vertex a millimetre, its noise and a height.
class Plate {
 public:
  Plate() : nominal_(level_grid(61, 61)), mesh_(nominal_) {
    mesh_.sigma_mm.assign(mesh_.vertices_mm.size(), kSigma);
  }

  Plate& raise(const std::function<double(const Eigen::Vector3f&)>& height) {
    for (Eigen::Vector3f& vertex : mesh_.vertices_mm)
      vertex.z() += static_cast<float>(height(vertex));
    return *this;
  }

  Plate& add_noise(std::uint64_t seed, double sigma) {
    for (std::size_t i = 0; i < mesh_.vertices_mm.size(); ++i)
      mesh_.vertices_mm[i].z() += static_cast<float>(sigma * normal_from(hash(seed, i)));
    return *this;
  }

  Plate& remove(const std::function<bool(const Eigen::Vector3f&)>& gone) {
    std::erase_if(mesh_.triangles, [&](const Mesh::Triangle& triangle) {
      return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
        return gone(mesh_.vertices_mm[v]);
      });
    });
    return *this;
  }

  Mesh& mesh() { return mesh_; }

  [[nodiscard]] SurfaceVerdict verdict(const SurfaceRule& rule) const {
    const RayScene reference(nominal_);
    return judge_surface(mesh_, deviations_of(mesh_, reference), reference, rule);
  }

 private:
  Mesh nominal_;
  Mesh mesh_;
};

/// Distance of a vertex from a place, along x and y.
inline double distance_from(const Eigen::Vector3f& vertex, double x, double y) {
  return std::hypot(static_cast<double>(vertex.x()) - x, static_cast<double>(vertex.y()) - y);
}

}  // namespace frangia::testing
