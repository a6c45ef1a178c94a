#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/color_of.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/xyz.h"

namespace frangia {
namespace {

/// Whether v is a unit vector, with tolerance for files with two decimals.
bool is_unit(const Eigen::Vector3f& v) {
  return std::abs(v.norm() - 1.0F) < 0.02F || v.isZero();
}

/// Whether numbers are red, green and blue from 0 to 255.
bool is_color(const Eigen::Vector3f& v) {
  constexpr float kMost = 255.0F;
  return v.minCoeff() >= 0.0F && v.maxCoeff() <= kMost && v == v.array().round().matrix();
}

}  // namespace

Mesh read_xyz(const std::filesystem::path& path) {
  constexpr std::size_t kWithNormals = 6;
  const std::string text = read_bytes(path);
  TextReader reader(path, text);
  Mesh mesh;
  bool has_normals = true;
  bool has_colors = true;
  for (; reader.bytes_left() > 0; reader.skip_line()) {
    std::array<float, kWithNormals> numbers{};
    std::size_t count = 0;
    for (auto word = reader.word_on_line(); !word.empty(); word = reader.word_on_line()) {
      if (word.starts_with('#') || word.starts_with("//")) break;
      if (count < numbers.size()) {
        const auto number = parse_float(word);
        if (!number) reader.fail(fmt::format("{} is not a number", in_quotes(word)));
        numbers.at(count) = *number;
      }
      ++count;
    }
    if (count == 0) continue;
    if (count < 3)
      reader.fail(
          fmt::format("it has {} number{}; a point needs three", count, count == 1 ? "" : "s"));
    mesh.vertices_mm.emplace_back(numbers[0], numbers[1], numbers[2]);
    const Eigen::Vector3f normal(numbers[3], numbers[4], numbers[5]);
    has_normals = has_normals && count == kWithNormals && is_unit(normal);
    if (has_normals) mesh.normals.push_back(normal);
    has_colors = has_colors && count == kWithNormals && is_color(normal);
    if (has_colors)
      mesh.colors.push_back(
          color_of(normal.x() / 255.0F, normal.y() / 255.0F, normal.z() / 255.0F));
  }
  if (!has_normals) mesh.normals.clear();
  if (!has_colors || has_normals) mesh.colors.clear();
  check_mesh(mesh, path);
  return mesh;
}

}  // namespace frangia
