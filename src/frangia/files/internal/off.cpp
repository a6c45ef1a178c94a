#include "frangia/files/internal/off.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/polygon_faces.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

class OffReader {
 public:
  OffReader(const std::filesystem::path& path, std::string_view text) : reader_(path, text) {}

  Mesh read() {
    const std::string_view keyword = word();
    if (!keyword.ends_with("OFF") || keyword.find_first_of("4n") != std::string_view::npos) {
      reader_.fail(fmt::format("expected 'OFF', found {}", in_quotes(keyword)));
    }
    const std::string_view prefix = keyword.substr(0, keyword.size() - 3);
    has_colors_ = prefix.find('C') != std::string_view::npos;
    has_normals_ = prefix.find('N') != std::string_view::npos;
    const std::string_view first = word();
    if (first == "BINARY") reader_.fail("this is a binary OFF; save it as text (ASCII) OFF");
    const auto vertices = count_of(first, "vertices", kVertexBytes);
    const auto faces = count_of(word(), "faces", kFaceBytes);
    reader_.skip_line();  // the number of edges, which writers often get wrong
    Mesh mesh;
    mesh.vertices_mm.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i)
      mesh.vertices_mm.push_back(read_vertex());
    if (colors_.size() == vertices) mesh.colors = colors_of(colors_);
    mesh.triangles.reserve(faces);
    for (std::size_t i = 0; i < faces; ++i)
      read_face(mesh);
    return mesh;
  }

  [[nodiscard]] const PolygonFaces& polygons() const { return polygons_; }
  /// Whether faces or vertices follow those that the header counts.
  void warn(const std::filesystem::path& path, const Run& run) {
    const std::string_view rest = reader_.rest();
    if (!word().empty()) warn_of_rest(rest, path, run);
  }

 private:
  static constexpr std::size_t kVertexBytes = 6;  // three digits and three separators
  static constexpr std::size_t kFaceBytes = 8;

  std::string_view word() {
    std::string_view found = reader_.word();
    while (found.starts_with('#')) {
      reader_.skip_line();
      found = reader_.word();
    }
    return found;
  }

  std::size_t count_of(std::string_view number, const char* what, std::size_t bytes) {
    const auto count = parse_integer(number);
    if (!count || *count < 0) {
      reader_.fail(fmt::format("{} is not a valid number of {}", in_quotes(number), what));
    }
    const auto max_count = (reader_.bytes_left() + bytes) / bytes;
    if (static_cast<std::uint64_t>(*count) > max_count) {
      reader_.fail(
          fmt::format("the header states {} {}, but the file can hold at most {}; it is "
                      "truncated or its counts are wrong",
                      *count,
                      what,
                      max_count));
    }
    return static_cast<std::size_t>(*count);
  }

  /// Three numbers of this line; nothing where it has fewer.
  std::optional<Eigen::Vector3f> read_three() {
    Eigen::Vector3f three;
    for (float& value : three) {
      const auto number = parse_float(reader_.word_on_line());
      if (!number) return std::nullopt;
      value = *number;
    }
    return three;
  }

  /// Takes note of the color of a vertex where it has one, behind its normal.
  void read_color() {
    if (has_normals_) static_cast<void>(read_three());
    if (const auto color = read_three()) colors_.push_back(*color);
  }

  Eigen::Vector3f read_vertex() {
    Eigen::Vector3f vertex;
    for (float& coordinate : vertex) {
      const std::string_view found = word();
      const auto number = parse_float(found);
      if (!number) reader_.fail(fmt::format("{} is not a coordinate", in_quotes(found)));
      coordinate = *number;
    }
    if (has_colors_) read_color();
    reader_.skip_line();
    return vertex;
  }

  void read_face(Mesh& mesh) {
    const std::string_view size = word();
    const auto count = parse_integer(size);
    if (!count || *count < 3) {
      reader_.fail(fmt::format("the number of corners of a face is {}; it must be at least 3",
                               in_quotes(size)));
    }
    corners_.clear();
    for (std::int64_t i = 0; i < *count; ++i) {
      const std::string_view found = reader_.word_on_line();
      const auto index = parse_integer(found);
      if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= mesh.vertices_mm.size()) {
        reader_.fail(fmt::format("{} is not a vertex index from 0 to {}",
                                 in_quotes(found),
                                 static_cast<std::int64_t>(mesh.vertices_mm.size()) - 1));
      }
      corners_.push_back(static_cast<std::uint32_t>(*index));
    }
    reader_.skip_line();  // an optional colour
    polygons_.add(mesh, corners_);
  }

  TextReader reader_;
  PolygonFaces polygons_;
  std::vector<std::uint32_t> corners_;
  bool has_colors_ = false;   ///< of vertices
  bool has_normals_ = false;  ///< of vertices, in front of their colors
  std::vector<Eigen::Vector3f> colors_;
};

}  // namespace

Mesh read_off(const std::filesystem::path& path, const Run& run) {
  const std::string text = plain_text(read_bytes(path));
  OffReader reader(path, text);
  Mesh mesh = reader.read();
  check_mesh(mesh, path);
  reader.polygons().triangulate(mesh, path, run);
  reader.warn(path, run);
  return mesh;
}

void write_off(const std::filesystem::path& path, const Mesh& mesh) {
  check_triangles(mesh, path);
  FileWriter file(path);
  file.text("OFF\n# Frangia; lengths in mm\n");
  file.number(mesh.vertices_mm.size());
  file.text(" ");
  file.number(mesh.triangles.size());
  file.text(" 0\n");
  for (const Eigen::Vector3f& place : mesh.vertices_mm) {
    file.number(place.x());
    file.text(" ");
    file.number(place.y());
    file.text(" ");
    file.number(place.z());
    file.text("\n");
  }
  const auto line_end = [](Mark mark) {
    return fmt::format(" {}\n", fmt::join(mark_screen_color(mark), " "));
  };
  const std::array<std::string, 3> line_ends{
      "\n", line_end(Mark::Displaced), line_end(Mark::Synthesized)};  // indexed by Mark
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    file.text("3");
    for (const std::uint32_t corner : mesh.triangles[i]) {
      file.text(" ");
      file.number(std::size_t{corner});
    }
    file.text(line_ends.at(static_cast<std::size_t>(mark_of(mesh, i))));
  }
  file.commit();
}

}  // namespace frangia
