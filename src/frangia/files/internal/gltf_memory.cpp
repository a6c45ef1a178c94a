#include "frangia/files/internal/gltf_memory.h"

#include <map>

#include "frangia/files/internal/mesh_memory.h"

namespace frangia {
namespace {

using nlohmann::json;

double memory_of_mesh(const GltfDocument& document, const json& mesh) {
  const auto count_of = [&](const json& accessor, std::size_t width) {
    return static_cast<double>(document.locate(document.whole(accessor), width).count);
  };
  double bytes = 0.0;
  const json* attributes = nullptr;
  for (const auto& primitive : mesh.at("primitives")) {
    const std::uint64_t mode = document.whole_or(primitive, "mode", kGltfTriangles);
    if (mode < kGltfTriangles || mode > kGltfFan) continue;
    const json& own = primitive.at("attributes");
    const double vertices = count_of(own.at("POSITION"), 3);
    const double corners =
        primitive.contains("indices") ? count_of(primitive.at("indices"), 1) : vertices;
    const bool shared = attributes != nullptr && *attributes == own;
    // In a strip or fan each corner but two makes a triangle.
    const double triangles = mode == kGltfTriangles ? corners / 3.0 : corners;
    bytes += mesh_memory_bytes(shared ? 0.0 : vertices, triangles);
    attributes = &own;
  }
  return bytes;
}

}  // namespace

double gltf_memory_bytes(const GltfDocument& document, const std::vector<std::uint64_t>& meshes) {
  std::map<std::uint64_t, double> memory_of;
  auto bytes = static_cast<double>(document.total_bytes);
  for (const std::uint64_t mesh : meshes) {
    const auto [known, inserted] = memory_of.try_emplace(mesh, 0.0);
    if (inserted) known->second = memory_of_mesh(document, document.item("meshes", mesh));
    bytes += known->second;
  }
  return bytes;
}

}  // namespace frangia
