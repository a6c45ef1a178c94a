#include "frangia/files/internal/write_vertices.h"

#include <cstdint>

namespace frangia {

namespace {

void write_color(FileWriter& file, const VertexColor& color, ColorLayout layout) {
  const auto& [red, green, blue] = color;
  if (layout == ColorLayout::Packed) {
    file.binary(std::uint32_t{red} << 16U | std::uint32_t{green} << 8U | std::uint32_t{blue});
    return;
  }
  for (const std::uint8_t channel : {red, green, blue})
    file.binary(channel);
}

}  // namespace

void write_vertices(FileWriter& file,
                    const Mesh& mesh,
                    ColorLayout colors,
                    std::span<const VertexProperty> more) {
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
    if (!mesh.colors.empty()) write_color(file, mesh.colors[i], colors);
    for (const VertexProperty& property : more)
      file.binary(property.values[i]);
  }
}

}  // namespace frangia
