#include "frangia/mesh/internal/patch_laplacian.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace frangia {

PatchLaplacian patch_laplacian(const PatchMesh& patch,
                               const PatchWithSurroundings& all,
                               double min_cotangent) {
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

}  // namespace frangia
