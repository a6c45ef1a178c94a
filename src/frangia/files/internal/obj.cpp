#include "frangia/files/internal/obj.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/polygon_faces.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

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

/// Whether a word is a comment or begins a statement that a mesh does not need.
///
/// @source   Wavefront, Object Files (.obj), appendix B1
bool is_other_statement(std::string_view word) {
  constexpr std::array<std::string_view, 36> kWords{
      "vt",     "vp",       "l",      "p",          "o",         "s",     "mg",     "usemtl",
      "mtllib", "usemap",   "maplib", "deg",        "bmat",      "step",  "cstype", "parm",
      "trim",   "hole",     "scrv",   "sp",         "end",       "con",   "bevel",  "c_interp",
      "lod",    "d_interp", "call",   "shadow_obj", "trace_obj", "ctech", "stech",  "csh",
      "bsp",    "bzp",      "res",    "cdc"};
  return word.empty() || word.starts_with('#') ||
         std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text) : reader_(path, text) {}

  Mesh read() {
    for (; reader_.bytes_left() > 0; reader_.skip_line()) {
      ended_ = false;
      const std::string_view keyword = reader_.word_on_line();
      if (keyword == "v") {
        mesh_.vertices_mm.push_back(read_vector());
        read_color();
      } else if (keyword == "vn") {
        const Eigen::Vector3f normal = read_vector();
        mesh_.normals.push_back(normal.allFinite() ? normal : Eigen::Vector3f::Zero());
      } else if (keyword == "f" || keyword == "fo") {  // `fo` of the first version
        read_face();
      } else if (keyword == "g") {
        mark_ = find_named<Mark>(word()).value_or(Mark::Measured);
      } else if (keyword == "surf" || keyword == "curv" || keyword == "curv2") {
        ++free_forms_;
      } else if (!is_other_statement(keyword)) {
        if (odd_lines_++ == 0) odd_ = keyword;
      }
      if (!keyword.starts_with('#')) end_statement();
    }
    if (!one_normal_a_vertex_ || mesh_.normals.size() != mesh_.vertices_mm.size()) {
      mesh_.normals.clear();
    }
    if (colors_.size() == mesh_.vertices_mm.size()) mesh_.colors = colors_of(colors_);
    return std::move(mesh_);
  }

  [[nodiscard]] const PolygonFaces& polygons() const { return polygons_; }
  /// Warns of what was skipped.
  void warn(const std::filesystem::path& path, const Run& run) const {
    if (free_forms_ > 0) {
      run.warn(fmt::format("{}: skipped {} free-form curves and surfaces, which are not meshes",
                           path.string(),
                           free_forms_));
    }
    if (odd_lines_ > 0) {
      run.warn(fmt::format("{}: skipped {} line{} that {} no statement of OBJ, the first with {}",
                           path.string(),
                           odd_lines_,
                           odd_lines_ == 1 ? "" : "s",
                           odd_lines_ == 1 ? "is" : "are",
                           in_quotes(odd_)));
    }
  }

 private:
  /// The next word of a statement, which a backslash continues on the next line and a comment
  /// ends.
  std::string_view word() {
    while (!ended_) {
      std::string_view found = reader_.word_on_line();
      if (const std::size_t hash = found.find('#'); hash != std::string_view::npos) {
        ended_ = true;
        return found.substr(0, hash);
      }
      if (!found.ends_with('\\')) return found;
      reader_.skip_line();
      found.remove_suffix(1);
      if (!found.empty()) return found;
    }
    return {};
  }

  /// Passes over what is left of a statement, also in the lines on which it goes on.
  void end_statement() {
    while (!word().empty())
      continue;
  }

  Eigen::Vector3f read_vector() {
    Eigen::Vector3f vector;
    for (float& coordinate : vector) {
      const std::string_view found = word();
      const std::optional<float> number = parse_float(found);
      if (!number) reader_.fail(fmt::format("{} is not a coordinate", in_quotes(found)));
      coordinate = *number;
    }
    return vector;
  }

  /// Three further numbers of a vertex are its color; a single one is a weight.
  void read_color() {
    Eigen::Vector3f color;
    for (float& channel : color) {
      const std::optional<float> number = parse_float(word());
      if (!number) return;
      channel = *number;
    }
    colors_.push_back(color);
  }

  void read_face() {
    corners_.clear();
    for (auto corner = word(); !corner.empty(); corner = word()) {
      const std::string_view vertex = corner.substr(0, corner.find('/'));
      corners_.push_back(read_index(reader_, vertex, mesh_.vertices_mm.size()));
      const std::string_view normal = normal_of(corner);
      one_normal_a_vertex_ = one_normal_a_vertex_ && !normal.empty() &&
                             read_index(reader_, normal, mesh_.normals.size()) == corners_.back();
    }
    if (corners_.size() < 3) {
      reader_.fail(fmt::format("a face has {} corner{}; it needs three",
                               corners_.size(),
                               corners_.size() == 1 ? "" : "s"));
    }
    polygons_.add(mesh_, corners_);
    if (mark_ != Mark::Measured) {  // earlier triangles are measured
      mesh_.triangle_marks.resize(mesh_.triangles.size() - (corners_.size() - 2), Mark::Measured);
      mesh_.triangle_marks.resize(mesh_.triangles.size(), mark_);
    } else if (!mesh_.triangle_marks.empty()) {
      mesh_.triangle_marks.resize(mesh_.triangles.size(), Mark::Measured);
    }
  }

  TextReader reader_;
  Mesh mesh_;
  PolygonFaces polygons_;
  std::vector<std::uint32_t> corners_;
  std::vector<Eigen::Vector3f> colors_;
  std::size_t free_forms_ = 0;  ///< curves and surfaces
  std::size_t odd_lines_ = 0;   ///< without a keyword of OBJ
  std::string odd_;             ///< the word of the first
  bool ended_ = false;          ///< the statement, by a comment
  bool one_normal_a_vertex_ = true;
  Mark mark_ = Mark::Measured;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path, const Run& run) {
  const std::string text = plain_text(read_bytes(path));
  ObjReader reader(path, text);
  Mesh mesh = reader.read();
  if (mesh.vertices_mm.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has no vertex; it is empty or not an OBJ file", path.string()));
  }
  check_mesh(mesh, path);
  reader.polygons().triangulate(mesh, path, run);
  reader.warn(path, run);
  return mesh;
}

namespace {

void write_vertex(FileWriter& file, const Mesh& mesh, std::size_t vertex) {
  file.text("v");
  for (const float coordinate : mesh.vertices_mm[vertex]) {
    file.text(" ");
    file.number(coordinate);
  }
  if (!mesh.colors.empty()) {
    for (const std::uint8_t channel : mesh.colors[vertex])
      file.text(fmt::format(" {:.4f}", channel / 255.0));
  }
  file.text("\n");
}

void write_face(FileWriter& file, const Mesh& mesh, std::size_t triangle) {
  file.text("f");
  for (const std::size_t corner : mesh.triangles[triangle]) {
    file.text(" ");
    file.number(corner + 1);
    if (mesh.normals.empty()) continue;
    file.text("//");
    file.number(corner + 1);
  }
  file.text("\n");
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  file.text("# Frangia; lengths in mm\n");
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    write_vertex(file, mesh, i);
  for (const Eigen::Vector3f& normal : mesh.normals)
    file.line("vn", normal);
  const bool marked = !mesh.vertex_marks.empty() || !mesh.triangle_marks.empty();
  Mark group = Mark::Measured;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (marked && (i == 0 || mark_of(mesh, i) != group)) {
      group = mark_of(mesh, i);
      file.text("g ");
      file.text(name_of(group));
      file.text("\n");
    }
    write_face(file, mesh, i);
  }
  file.commit();
}

}  // namespace frangia
