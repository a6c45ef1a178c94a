#include "frangia/service/encode_arrays.h"

#include <vector>

#include "frangia/geometry/vertex_data.h"
#include "frangia/service/internal/array_packer.h"

namespace frangia {
namespace {

constexpr std::size_t kPerPoint = 3;

}  // namespace

std::string encode_mesh(const Mesh& mesh, int revision) {
  static_assert(sizeof(Eigen::Vector3f) == kPerPoint * sizeof(float));
  ArrayPacker packer;
  packer.set_values({{"revision", revision}});
  const std::size_t vertices = mesh.vertices_mm.size();
  packer.add("positions",
             "float32",
             reinterpret_cast<const float*>(mesh.vertices_mm.data()),
             vertices * kPerPoint);
  packer.add("triangles",
             "uint32",
             reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()),
             mesh.triangles.size() * kPerPoint);
  const std::vector<Eigen::Vector3f> normals =
      mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals;
  packer.add("normals",
             "float32",
             reinterpret_cast<const float*>(normals.data()),
             normals.size() * kPerPoint);
  if (!mesh.sigma_mm.empty()) packer.add("sigma_mm", "float32", mesh.sigma_mm.data(), vertices);
  if (!mesh.views.empty()) packer.add("views", "uint16", mesh.views.data(), vertices);
  if (!mesh.vertex_marks.empty() || !mesh.triangle_marks.empty()) {
    std::vector<std::uint8_t> marks(mesh.triangles.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
      marks[i] = static_cast<std::uint8_t>(mark_of(mesh, i));
    packer.add("marks", "uint8", marks.data(), marks.size());
  }
  return packer.pack();
}

std::string encode_selection(const Selection& selection, int revision) {
  ArrayPacker packer;
  packer.set_values({{"revision", revision}});
  packer.add("selected", "uint8", selection.data(), selection.size());
  return packer.pack();
}

std::string encode_points(const PointCloud& points, std::size_t most) {
  const std::size_t step = points.points_mm.size() / (most + 1) + 1;
  std::vector<float> positions;
  std::vector<float> sigma;
  for (std::size_t i = 0; i < points.points_mm.size(); i += step) {
    for (const float value : points.points_mm[i])
      positions.push_back(value);
    sigma.push_back(points.sigma_mm.empty() ? kMissing : points.sigma_mm[i]);
  }
  ArrayPacker packer;
  packer.add("positions", "float32", positions.data(), positions.size());
  packer.add("sigma_mm", "float32", sigma.data(), sigma.size());
  return packer.pack();
}

}  // namespace frangia
