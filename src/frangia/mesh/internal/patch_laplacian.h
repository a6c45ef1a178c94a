#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "frangia/mesh/internal/fair_patch.h"
#include "frangia/mesh/internal/patch_mesh.h"

namespace frangia {

/// The vertices and triangles of a patch and its surroundings; the vertices of the patch come
/// first.
class PatchWithSurroundings {
 public:
  PatchWithSurroundings(const PatchMesh& patch, const PatchSurroundings& around)
      : patch_(patch), around_(around) {}

  [[nodiscard]] std::uint32_t count() const {
    return patch_.count() + static_cast<std::uint32_t>(around_.outer_mm.size());
  }
  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t vertex) const {
    return vertex < patch_.count() ? patch_.position(vertex)
                                   : around_.outer_mm[vertex - patch_.count()];
  }
  template <typename Work>
  void for_each_triangle(const Work& work) const {
    for (std::uint32_t edge = 0; edge < patch_.half_edges(); edge += 3)
      work(std::array<std::uint32_t, 3>{
          patch_.from(edge), patch_.from(edge + 1), patch_.from(edge + 2)});
    for (std::array<std::uint32_t, 3> triangle : around_.triangles) {
      for (std::uint32_t& vertex : triangle)
        if (vertex >= patch_.boundary_vertices())
          vertex += patch_.count() - patch_.boundary_vertices();
      work(triangle);
    }
  }

 private:
  const PatchMesh& patch_;
  const PatchSurroundings& around_;
};

// Cotangent weights are limited to the angle of 3 degrees: larger ones belong to slivers.
constexpr double kMaxCotangent = 20.0;
// Positive weights keep a minimal surface within the convex hull of its boundary.
constexpr double kMinPositiveCotangent = 1e-3;

/// The cotangent Laplacian of the vertices of a patch: weights / area.
///
/// @source   Pinkall & Polthier 1993, Computing Discrete Minimal Surfaces and Their Conjugates
struct PatchLaplacian {
  Eigen::SparseMatrix<double> weights;  ///< vertices of the patch x all vertices
  Eigen::VectorXd areas;                ///< a third of the area of the triangles at each vertex
};

[[nodiscard]] PatchLaplacian patch_laplacian(const PatchMesh& patch,
                                             const PatchWithSurroundings& all,
                                             double min_cotangent = -kMaxCotangent);

}  // namespace frangia
