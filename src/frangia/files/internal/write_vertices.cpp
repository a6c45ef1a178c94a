#include "frangia/files/internal/write_vertices.h"

#include <cstdint>

namespace frangia {

void write_vertices(FileWriter& file, const Mesh& mesh, ColorLayout colors) {
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    for (const float coordinate : mesh.vertices_mm[i])
      file.binary(coordinate);
    if (!mesh.normals.empty()) {
      for (const float coordinate : mesh.normals[i])
        file.binary(coordinate);
    }
    if (!mesh.sigma_mm.empty()) file.binary(mesh.sigma_mm[i]);
    if (!mesh.sigma_noise_mm.empty()) file.binary(mesh.sigma_noise_mm[i]);
    if (!mesh.sigma_systematic_mm.empty()) file.binary(mesh.sigma_systematic_mm[i]);
    if (!mesh.views.empty()) file.binary(mesh.views[i]);
    if (!mesh.vertex_marks.empty()) file.binary(static_cast<std::uint8_t>(mesh.vertex_marks[i]));
    if (mesh.colors.empty()) continue;
    const auto& [red, green, blue] = mesh.colors[i];
    if (colors == ColorLayout::Packed) {
      file.binary(std::uint32_t{red} << 16U | std::uint32_t{green} << 8U | std::uint32_t{blue});
      continue;
    }
    for (const std::uint8_t channel : {red, green, blue})
      file.binary(channel);
  }
}

}  // namespace frangia
