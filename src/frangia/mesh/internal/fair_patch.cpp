#include "frangia/mesh/internal/fair_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

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

PatchLaplacian patch_laplacian(const PatchMesh& patch,
                               const PatchWithSurroundings& all,
                               double min_cotangent = -kMaxCotangent) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(patch.count());
  const auto add = [&](std::uint32_t a, std::uint32_t b, double weight) {
    if (a >= patch.count()) return;
    entries.emplace_back(a, b, weight);
    entries.emplace_back(a, a, -weight);
  };
  all.for_each_triangle([&](const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t.at(i);
      const std::uint32_t b = t.at((i + 1) % 3);
      const Eigen::Vector3d& apex = all.position(t.at((i + 2) % 3));
      const Eigen::Vector3d u = all.position(a) - apex;
      const Eigen::Vector3d v = all.position(b) - apex;
      const double twice_area = u.cross(v).norm();
      const double cotangent = u.dot(v) / std::max(twice_area, std::numeric_limits<double>::min());
      const double weight = 0.5 * std::clamp(cotangent, min_cotangent, kMaxCotangent);
      add(a, b, weight);
      add(b, a, weight);
      if (a < patch.count()) areas[a] += twice_area / 6.0;
    }
  });
  constexpr double kMinArea = 1e-3;  // of the mean: slivers would dominate L / area
  areas = areas.cwiseMax(kMinArea * areas.mean()).eval();
  PatchLaplacian laplacian{Eigen::SparseMatrix<double>(patch.count(), all.count()),
                           std::move(areas)};
  laplacian.weights.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}  // NOLINT(clang-analyzer-unix.Malloc): Eigen releases it

using Eigen::MatrixX3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using ByRow = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triangle = std::array<std::uint32_t, 3>;

// Limits as fractions of the diagonal of the boundary's bounding box. A hemisphere over its great
// circle reaches 0.35 beyond the box.
constexpr double kReach = 0.5;
constexpr double kMaxSmoothingMove = 0.1;

MatrixX3d matrix_of(const std::vector<Vector3d>& rows) {
  MatrixX3d matrix(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    matrix.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
  return matrix;
}

MatrixX3d positions_of(const PatchWithSurroundings& all) {
  MatrixX3d positions(all.count(), 3);
  for (std::uint32_t v = 0; v < all.count(); ++v)
    positions.row(v) = all.position(v).transpose();
  return positions;
}

/// Smooths a field over the patch by three averaging steps: slivers and noise at the boundary put
/// outliers into it.
template <typename Field>
Field smoothed(const PatchMesh& patch, Field field) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    Field sum = field;
    VectorXd count = VectorXd::Ones(patch.count());
    for (std::uint32_t edge = 0; edge < patch.half_edges(); ++edge) {
      sum.row(patch.from(edge)) += field.row(patch.to(edge));
      count[patch.from(edge)] += 1.0;
    }
    field = count.cwiseInverse().asDiagonal() * sum;
  }
  return field;
}

double median_of(VectorXd values) {
  return median_in_place(std::span(values.data(), static_cast<std::size_t>(values.size())));
}

/// The bi-Laplacian of the positions for a smooth mean curvature H on the present shape: the normal
/// part of L(H n) - n L(H). It is not zero, because the normals turn along the surface.
MatrixX3d target_bilaplacian(const PatchMesh& patch,
                             const PatchLaplacian& laplacian,
                             const MatrixX3d& positions,
                             const MatrixX3d& exact_normals) {
  const MatrixX3d normals = smoothed(patch, exact_normals).rowwise().normalized();
  const MatrixX3d curvature =
      laplacian.areas.cwiseInverse().asDiagonal() * (laplacian.weights * positions);
  VectorXd curvature_along =
      smoothed(patch, VectorXd(curvature.cwiseProduct(normals).rowwise().sum()));
  constexpr double kOutlier = 3.0;  // medians of the boundary's curvature
  const double limit =
      kOutlier * median_of(curvature_along.head(patch.boundary_vertices()).cwiseAbs());
  curvature_along = curvature_along.cwiseMax(-limit).cwiseMin(limit).eval();
  const Sparse own = laplacian.weights.leftCols(laplacian.weights.rows());
  return own * (curvature_along.asDiagonal() * normals) -
         MatrixX3d((own * curvature_along).asDiagonal() * normals);
}

bool solve_bilaplacian(PatchMesh& patch,
                       const PatchWithSurroundings& all,
                       const MatrixX3d* normals) {
  const PatchLaplacian laplacian = patch_laplacian(patch, all);
  const Eigen::Index boundary_count = patch.boundary_vertices();
  const Eigen::Index inner = static_cast<Eigen::Index>(patch.count()) - boundary_count;
  MatrixX3d positions = positions_of(all);
  MatrixX3d wanted = MatrixX3d::Zero(patch.count(), 3);
  if (normals != nullptr) wanted = target_bilaplacian(patch, laplacian, positions, *normals);
  positions.middleRows(boundary_count, inner).setZero();
  const Sparse scaled = laplacian.areas.cwiseSqrt().cwiseInverse().asDiagonal() * laplacian.weights;
  const Sparse free = scaled.middleCols(boundary_count, inner);
  const Sparse normal = free.transpose() * free;
  const MatrixX3d right = wanted.bottomRows(inner) - free.transpose() * (scaled * positions);
  const Eigen::SimplicialLDLT<Sparse> solver(normal);
  if (solver.info() != Eigen::Success) return false;
  const MatrixX3d solution = solver.solve(right);
  if (solver.info() != Eigen::Success || !solution.allFinite()) return false;
  for (Eigen::Index i = 0; i < inner; ++i)
    patch.move(static_cast<std::uint32_t>(boundary_count + i), solution.row(i).transpose());
  return true;
}

/// Moves the inner vertices onto the minimal surface, which stays within the box of the boundary.
bool solve_minimal_surface(PatchMesh& patch, const PatchWithSurroundings& all, const Run& run) {
  for (int round = 0; round < 3; ++round) {
    run.check();
    const PatchLaplacian laplacian = patch_laplacian(patch, all, kMinPositiveCotangent);
    const Eigen::Index boundary_count = patch.boundary_vertices();
    const Eigen::Index inner = static_cast<Eigen::Index>(patch.count()) - boundary_count;
    MatrixX3d positions = positions_of(all);
    positions.middleRows(boundary_count, inner).setZero();
    const Sparse rows = ByRow(laplacian.weights).middleRows(boundary_count, inner);
    const Eigen::SimplicialLDLT<Sparse> solver(Sparse(-rows.middleCols(boundary_count, inner)));
    if (solver.info() != Eigen::Success) return false;
    const MatrixX3d solution = solver.solve(MatrixX3d(rows * positions));
    if (!solution.allFinite()) return false;
    for (Eigen::Index i = 0; i < inner; ++i)
      patch.move(static_cast<std::uint32_t>(boundary_count + i), solution.row(i).transpose());
    patch.restore_delaunay();
  }
  return true;
}

std::vector<Vector3d> current_positions(const PatchMesh& patch) {
  std::vector<Vector3d> positions;
  for (std::uint32_t v = 0; v < patch.count(); ++v)
    positions.push_back(patch.position(v));
  return positions;
}

void set_positions(PatchMesh& patch, const std::vector<Vector3d>& positions) {
  for (std::uint32_t v = patch.boundary_vertices(); v < patch.count(); ++v)
    patch.move(v, positions[v]);
}

/// Blends the patch with another shape; a share of 1 is the other shape.
void blend_shape(PatchMesh& patch, const std::vector<Vector3d>& other, double share) {
  for (std::uint32_t v = patch.boundary_vertices(); v < patch.count(); ++v)
    patch.move(v, (1.0 - share) * patch.position(v) + share * other[v]);
  patch.restore_delaunay();
}

double farthest_moved(const PatchMesh& patch, const std::vector<Vector3d>& from) {
  double farthest = 0.0;
  for (std::uint32_t v = 0; v < patch.count(); ++v)
    farthest = std::max(farthest, (patch.position(v) - from[v]).norm());
  return farthest;
}

Eigen::AlignedBox3d box_of_boundary(const PatchMesh& patch) {
  Eigen::AlignedBox3d box;
  for (std::uint32_t v = 0; v < patch.boundary_vertices(); ++v)
    box.extend(patch.position(v));
  return box;
}

bool within(const PatchMesh& patch, const Eigen::AlignedBox3d& box) {
  for (std::uint32_t v = 0; v < patch.count(); ++v)
    if (!box.contains(patch.position(v))) return false;
  return true;
}

/// Solves twice, because the weights depend on the shape.
bool solve_fair_surface(PatchMesh& patch, const PatchWithSurroundings& all, const Run& run) {
  for (int round = 0; round < 2; ++round) {
    run.check();
    if (!solve_bilaplacian(patch, all, nullptr)) return false;
    patch.restore_delaunay();
  }
  return true;
}

/// Smooths the mean curvature. Keeps the shape when slivers at the boundary would move it far.
void smooth_curvature(PatchMesh& patch,
                      const PatchSurroundings& around,
                      double reach_mm,
                      const Run& run) {
  const PatchWithSurroundings all(patch, around);
  const std::vector<Vector3d> before = current_positions(patch);
  for (int round = 0; round < 2; ++round) {
    run.check();
    const MatrixX3d normals = matrix_of(normals_of(patch, around));
    if (!solve_bilaplacian(patch, all, &normals) || !(farthest_moved(patch, before) < reach_mm)) {
      set_positions(patch, before);
      break;
    }
  }
  patch.restore_delaunay();
}

}  // namespace

std::vector<Vector3d> normals_of(const PatchMesh& patch, const PatchSurroundings& around) {
  const PatchWithSurroundings all(patch, around);
  std::vector<Vector3d> normals(patch.count(), Vector3d::Zero());
  all.for_each_triangle([&](const Triangle& t) {
    const Vector3d cross =
        (all.position(t[1]) - all.position(t[0])).cross(all.position(t[2]) - all.position(t[0]));
    for (const std::uint32_t vertex : t)
      if (vertex < patch.count()) normals[vertex] += cross;
  });
  for (Vector3d& normal : normals)
    normal.stableNormalize();
  return normals;
}

bool fair_patch(PatchMesh& patch,
                const PatchSurroundings& around,
                double curvature,
                const Run& run) {
  if (patch.count() == patch.boundary_vertices()) return true;
  const PatchWithSurroundings all(patch, around);
  const std::vector<Vector3d> before = current_positions(patch);
  Eigen::AlignedBox3d reach = box_of_boundary(patch);
  const double size = reach.diagonal().norm();
  const Vector3d margin = Vector3d::Constant(kReach * size);
  reach = Eigen::AlignedBox3d(reach.min() - margin, reach.max() + margin);
  const bool is_curved =
      curvature > 0.0 && solve_fair_surface(patch, all, run) && within(patch, reach);
  if (is_curved) smooth_curvature(patch, around, kMaxSmoothingMove * size, run);
  if (is_curved && curvature >= 1.0) return true;
  const std::vector<Vector3d> full = current_positions(patch);
  set_positions(patch, before);
  patch.restore_delaunay();
  if (!solve_minimal_surface(patch, all, run) || !within(patch, reach)) return false;
  if (is_curved) blend_shape(patch, full, curvature);
  return true;
}

}  // namespace frangia
