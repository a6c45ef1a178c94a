#include "frangia/files/internal/file_writer.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace frangia {
namespace {

template <typename Number>
std::string_view digits_of(Number value, std::array<char, 32>& space) {
  const auto end = std::to_chars(space.data(), space.data() + space.size(), value).ptr;
  return {space.data(), static_cast<std::size_t>(end - space.data())};
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) : file_(path) {
  buffer_.reserve(kBlock + kBlock / 8);
}

void FileWriter::number(float value) {
  std::array<char, 32> space{};
  text(digits_of(value, space));
}

void FileWriter::number(std::size_t value) {
  std::array<char, 32> space{};
  text(digits_of(value, space));
}

void FileWriter::line(std::string_view keyword, const Eigen::Vector3f& vector) {
  text(keyword);
  for (const float coordinate : vector) {
    text(" ");
    number(coordinate);
  }
  text("\n");
}

void FileWriter::flush() {
  file_.stream().write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void FileWriter::commit() {
  flush();
  file_.commit();
}

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
