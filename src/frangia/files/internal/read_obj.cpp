#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/add_polygon.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/color_of.h"
#include "frangia/files/internal/mark_names.h"
#include "frangia/files/internal/obj.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

Eigen::Vector3f read_vector(TextReader& reader) {
  Eigen::Vector3f vector;
  for (float& coordinate : vector) {
    const std::string_view word = reader.word_on_line();
    const std::optional<float> number = parse_float(word);
    if (!number) reader.fail(fmt::format("{} is not a coordinate", in_quotes(word)));
    coordinate = *number;
  }
  return vector;
}

/// Converts an index of the file: from 1, or negative, relative to the last element so far.
std::uint32_t read_index(const TextReader& reader, std::string_view word, std::size_t so_far) {
  const std::optional<std::int64_t> number = parse_integer(word);
  const auto count = static_cast<std::int64_t>(so_far);
  const std::int64_t index = number.value_or(0) < 0 ? count + *number : number.value_or(0) - 1;
  if (!number || index < 0 || index > std::numeric_limits<std::uint32_t>::max()) {
    reader.fail(fmt::format("{} is not the index of a vertex or normal", in_quotes(word)));
  }
  return static_cast<std::uint32_t>(index);
}

/// The text after the second slash of a/b/c or a//c; empty without one.
std::string_view normal_of(std::string_view corner) {
  const std::size_t slash = corner.find('/');
  if (slash == std::string_view::npos) return {};
  const std::size_t second = corner.find('/', slash + 1);
  return second == std::string_view::npos ? std::string_view() : corner.substr(second + 1);
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text) : reader_(path, text) {}

  Mesh read() {
    for (; reader_.bytes_left() > 0; reader_.skip_line()) {
      const std::string_view keyword = reader_.word_on_line();
      if (keyword == "v") {
        mesh_.vertices_mm.push_back(read_vector(reader_));
        read_color();
      } else if (keyword == "vn") {
        mesh_.normals.push_back(read_vector(reader_));
      } else if (keyword == "f") {
        read_face();
      } else if (keyword == "g") {
        mark_ = mark_of_name(reader_.word_on_line());
      }
    }
    if (!one_normal_a_vertex_ || mesh_.normals.size() != mesh_.vertices_mm.size()) {
      mesh_.normals.clear();
    }
    if (mesh_.colors.size() != mesh_.vertices_mm.size()) mesh_.colors.clear();
    return std::move(mesh_);
  }

 private:
  /// Three further numbers of a vertex are its color; a single one is a weight.
  void read_color() {
    std::array<float, 3> channels{};
    for (float& channel : channels) {
      const std::optional<float> number = parse_float(reader_.word_on_line());
      if (!number) return;
      channel = *number;
    }
    mesh_.colors.push_back(color_of(channels[0], channels[1], channels[2]));
  }

  void read_face() {
    corners_.clear();
    for (auto word = reader_.word_on_line(); !word.empty(); word = reader_.word_on_line()) {
      const std::string_view vertex = word.substr(0, word.find('/'));
      corners_.push_back(read_index(reader_, vertex, mesh_.vertices_mm.size()));
      const std::string_view normal = normal_of(word);
      one_normal_a_vertex_ = one_normal_a_vertex_ && !normal.empty() &&
                             read_index(reader_, normal, mesh_.normals.size()) == corners_.back();
    }
    if (corners_.size() < 3) {
      reader_.fail(fmt::format("a face has {} corner{}; it needs three",
                               corners_.size(),
                               corners_.size() == 1 ? "" : "s"));
    }
    add_polygon(mesh_, corners_);
    if (mark_ != Mark::Measured) {  // earlier triangles are measured
      mesh_.triangle_marks.resize(mesh_.triangles.size() - (corners_.size() - 2), Mark::Measured);
      mesh_.triangle_marks.resize(mesh_.triangles.size(), mark_);
    } else if (!mesh_.triangle_marks.empty()) {
      mesh_.triangle_marks.resize(mesh_.triangles.size(), Mark::Measured);
    }
  }

  TextReader reader_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;
  bool one_normal_a_vertex_ = true;
  Mark mark_ = Mark::Measured;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path) {
  const std::string text = read_bytes(path);
  Mesh mesh = ObjReader(path, text).read();
  if (mesh.vertices_mm.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has no vertex; it is empty or not an OBJ file", path.string()));
  }
  check_mesh(mesh, path);
  return mesh;
}

}  // namespace frangia
