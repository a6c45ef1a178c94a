#include "frangia/files/internal/xyz.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/text_reader.h"

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

/// Whether a comma stands inside of a word, as in 1,5.
bool has_inner_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < word.size();
}

/// Whether numbers of a line have decimal commas: beside semicolons, or with blanks between three
/// or more of them.
bool has_decimal_commas(std::string_view line) {
  if (line.find(',') == std::string_view::npos) return false;
  if (line.find(';') != std::string_view::npos) return true;
  TextReader words({}, line);
  std::size_t count = 0;
  bool inner = false;
  for (auto word = words.word(); !word.empty(); word = words.word(), ++count)
    inner = inner || has_inner_comma(word);
  return inner && count >= 3;
}

/// Whether nothing stands in front of a comma or semicolon of a line, or between two of them.
bool has_empty_value(std::string_view line) {
  bool empty = true;
  for (const char c : line) {
    const bool separates = c == ',' || c == ';';
    if (separates && empty) return true;
    if (c != ' ' && c != '\t') empty = separates;
  }
  return false;
}

/// Replaces commas and semicolons between numbers by blanks.
///
/// @errors   Error(Input) for decimal commas, and for values that are missing
void separate_by_blanks(std::string& text, const std::filesystem::path& path) {
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    line = line.substr(0, std::min(line.find('#'), line.find("//")));
    const bool decimal = has_decimal_commas(line);
    if (decimal || has_empty_value(line)) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}, line {}: {}",
                              path.string(),
                              number,
                              decimal ? "its numbers have decimal commas; write points, 1.5"
                                      : "a value is missing beside a comma or semicolon"));
    }
    const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
    std::replace_if(
        first,
        first + static_cast<std::ptrdiff_t>(line.size()),
        [](char c) { return c == ',' || c == ';'; },
        ' ');
    begin = end + 1;
  }
}

/// Whether the line names the columns.
///
/// @errors   Error(Input) where the first three are not x, y and z
bool names_columns(TextReader line) {
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  const TextReader begin = line;
  const std::string_view first = line.word_on_line();
  const bool is_name = !first.empty() && !parse_float(first) &&
                       (std::isalpha(static_cast<unsigned char>(first[0])) != 0 || first[0] == '"');
  if (!is_name) return false;
  line = begin;
  for (const std::string_view axis : kAxes) {
    std::string name(line.word_on_line());
    std::erase(name, '"');
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
      return static_cast<char>(std::tolower(letter));
    });
    if (name == axis || name == fmt::format("{}_mm", axis) || name == fmt::format("{}[mm]", axis))
      continue;
    line.fail(fmt::format("{} is not a number, and names of columns begin with x, y and z",
                          in_quotes(first)));
  }
  return true;
}

}  // namespace

Mesh read_xyz(const std::filesystem::path& path, const Run& run) {
  constexpr std::size_t kMostColumns = 9;
  constexpr float kMostPoints = 4e9F;
  std::string text = plain_text(read_bytes(path));
  separate_by_blanks(text, path);
  TextReader reader(path, text);
  Mesh mesh;
  Columns first;   // 4 to 6
  Columns second;  // 7 to 9
  std::optional<std::size_t> columns;
  bool is_regular = true;
  std::optional<std::size_t> stated;  // number of points, in front of them
  for (; reader.bytes_left() > 0; reader.skip_line()) {
    std::array<float, kMostColumns> numbers{};
    std::size_t count = 0;
    if (mesh.vertices_mm.empty() && names_columns(reader)) continue;
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
    const bool states_number = count == 1 && mesh.vertices_mm.empty() && !stated &&
                               numbers[0] >= 1.0F && numbers[0] <= kMostPoints &&
                               numbers[0] == std::floor(numbers[0]);
    if (states_number) {
      stated = static_cast<std::size_t>(numbers[0]);
      continue;
    }
    if (count < 3)
      reader.fail(
          fmt::format("it has {} number{}; a point needs three", count, count == 1 ? "" : "s"));
    mesh.vertices_mm.emplace_back(numbers[0], numbers[1], numbers[2]);
    is_regular = is_regular && count == columns.value_or(count);
    columns = std::max(count, columns.value_or(count));
    if (is_regular && count >= 6) first.emplace_back(numbers[3], numbers[4], numbers[5]);
    if (is_regular && count >= 9) second.emplace_back(numbers[6], numbers[7], numbers[8]);
  }
  if (stated && *stated != mesh.vertices_mm.size()) {
    reader.fail(fmt::format(
        "its first line states {} points, but it has {}", *stated, mesh.vertices_mm.size()));
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

namespace {

void write_vector(FileWriter& file, const Eigen::Vector3f& v) {
  file.number(v.x());
  file.text(" ");
  file.number(v.y());
  file.text(" ");
  file.number(v.z());
}

}  // namespace

void write_xyz(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    write_vector(file, mesh.vertices_mm[i]);
    if (!mesh.normals.empty()) {
      file.text(" ");
      write_vector(file, mesh.normals[i]);
    }
    file.text("\n");
  }
  file.commit();
}

}  // namespace frangia
