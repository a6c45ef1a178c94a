#include "frangia/editor/step_like.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/editor/internal/select_by_vertex_data.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// Faces of a part meet at larger angles, and noise turns normals by less.
constexpr double kSameDirectionDeg = 15.0;
/// The triangle itself is selected in spite of rounding, and its neighbours in spite of noise.
constexpr double kAtLeast = 0.9;
/// No vertex is that uncertain: what is selected has an unknown sigma.
constexpr double kBeyondAnySigmaMm = 1e6;

/// The largest magnitude at the corners of a triangle; NaN where all are unknown.
double largest(const Mesh::Triangle& triangle, const std::vector<float>& values) {
  double most = kMissing;
  for (const std::uint32_t vertex : triangle)
    most = std::fmax(most, std::abs(static_cast<double>(values[vertex])));
  return most;
}

EditStep like_normal(const Mesh& mesh, const Mesh::Triangle& t) {
  const auto corner = [&](std::size_t i) { return mesh.vertices_mm[t[i]].cast<double>().eval(); };
  const Eigen::Vector3d cross = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  require(cross.norm() > 0.0, "this triangle has no area, hence no direction; pick another one");
  const Eigen::Vector3d n = cross.normalized();
  return {"select-normal",
          fmt::format("{:.4f},{:.4f},{:.4f},{:g}deg", n.x(), n.y(), n.z(), kSameDirectionDeg)};
}

EditStep like_curvature(const Mesh& mesh, const Mesh::Triangle& t) {
  const double curvature = largest(t, mean_curvature_per_mm(mesh));
  if (std::isnan(curvature)) {
    throw Error(ErrorKind::Input,
                "the curvature at a boundary is unknown; pick a place inside the surface");
  }
  return {"select-curvature", fmt::format("{:.3g}", kAtLeast * curvature)};
}

EditStep like_sigma(const Mesh& mesh, const Mesh::Triangle& t) {
  if (mesh.sigma_mm.empty())
    throw Error(ErrorKind::Input, "this surface states no sigma; select by something else");
  const double sigma = largest(t, mesh.sigma_mm);
  return {"select-sigma",
          fmt::format("{:.6f}mm", std::isnan(sigma) ? kBeyondAnySigmaMm : kAtLeast * sigma)};
}

}  // namespace

EditStep step_like(const Mesh& mesh, std::size_t triangle, Likeness likeness) {
  require(triangle < mesh.triangles.size(), "the surface has no such triangle; pick another one");
  const Mesh::Triangle& t = mesh.triangles[triangle];
  switch (likeness) {
    case Likeness::Normal:
      return like_normal(mesh, t);
    case Likeness::Curvature:
      return like_curvature(mesh, t);
    case Likeness::Sigma:
      return like_sigma(mesh, t);
    case Likeness::Mark:
      break;
  }
  return {"select-mark", std::string(name_of(mark_of(mesh, triangle)))};
}

}  // namespace frangia
