#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/plain_text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/color_of.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/xyz.h"

namespace frangia {
namespace {

using Columns = std::vector<Eigen::Vector3f>;

bool is_zero(const Eigen::Vector3f& v) {
  return v.isZero();
}

/// Whether all are unit vectors, with tolerance for files with two decimals, or zero where there is
/// none, but not all of them.
bool are_normals(const Columns& columns) {
  constexpr float kTolerance = 0.02F;
  return std::all_of(columns.begin(),
                     columns.end(),
                     [](const Eigen::Vector3f& v) {
                       return std::abs(v.norm() - 1.0F) < kTolerance || is_zero(v);
                     }) &&
         !std::all_of(columns.begin(), columns.end(), is_zero);
}

/// Whether all are red, green and blue: whole numbers from 0 to 255, or numbers from 0 to 1.
bool are_colors(const Columns& columns) {
  const auto all = [&](auto&& fits) { return std::all_of(columns.begin(), columns.end(), fits); };
  constexpr float kMost = 255.0F;
  return all([](const Eigen::Vector3f& v) { return v.minCoeff() >= 0.0F; }) &&
         (all([](const Eigen::Vector3f& v) { return v.maxCoeff() <= 1.0F; }) ||
          all([](const Eigen::Vector3f& v) {
            return v.maxCoeff() <= kMost && v == v.array().round().matrix();
          }));
}

/// The normals and colors among columns 4 to 6 and 7 to 9; false where one of them is neither.
bool take_columns(const Columns& first, const Columns& second, Mesh& mesh) {
  bool all_taken = true;
  for (const Columns* columns : {&first, &second}) {
    if (columns->empty()) continue;
    if (mesh.normals.empty() && are_normals(*columns)) {
      mesh.normals = *columns;
    } else if (mesh.colors.empty() && are_colors(*columns)) {
      mesh.colors = colors_of(*columns);
    } else {
      all_taken = false;
    }
  }
  return all_taken;
}

}  // namespace

Mesh read_xyz(const std::filesystem::path& path, const Run& run) {
  constexpr std::size_t kMostColumns = 9;
  const std::string text = plain_text(read_bytes(path));
  TextReader reader(path, text);
  Mesh mesh;
  Columns first;   // 4 to 6
  Columns second;  // 7 to 9
  std::optional<std::size_t> columns;
  bool is_regular = true;
  for (; reader.bytes_left() > 0; reader.skip_line()) {
    std::array<float, kMostColumns> numbers{};
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
    is_regular = is_regular && count == columns.value_or(count);
    columns = std::max(count, columns.value_or(count));
    if (is_regular && count >= 6) first.emplace_back(numbers[3], numbers[4], numbers[5]);
    if (is_regular && count >= 9) second.emplace_back(numbers[6], numbers[7], numbers[8]);
  }
  const std::size_t most = columns.value_or(3);
  const bool in_threes = is_regular && (most == 6 || most == kMostColumns);
  const bool all_taken = in_threes ? take_columns(first, second, mesh) : most == 3;
  if (!all_taken) {
    run.warn(
        fmt::format("{}: what is behind x, y and z is left out where it is neither normals nor "
                    "colours of every "
                    "point",
                    path.string()));
  }
  check_mesh(mesh, path);
  return mesh;
}

}  // namespace frangia
