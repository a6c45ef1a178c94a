#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/dxf.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/dxf_drawing.h"
#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/weld_vertices.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kPolygonMesh = 16;
constexpr std::int64_t kPolyface = 64;
constexpr std::int64_t kSplineFit = 4;
constexpr std::int64_t kFaceRecord = 128;

/// mm of each unit that $INSUNITS can name; 0: unknown.
double mm_of(std::int64_t unit) {
  switch (unit) {
    case 1:
      return 25.4;
    case 2:
      return 304.8;
    case 5:
      return 10.0;
    case 6:
      return 1000.0;
    case 7:
      return 1e6;
    case 13:
      return 1e-3;
    case 14:
      return 100.0;
    default:
      return 1.0;
  }
}

Mark mark_of_layer(std::string_view layer) {
  const auto* const found = std::find(kDxfLayers.begin(), kDxfLayers.end(), layer);
  return found == kDxfLayers.end() ? Mark::Measured : static_cast<Mark>(found - kDxfLayers.begin());
}

/// Groups 10..13, 20..23, 30..33: sets the axis of the corner that the code names.
void read_coordinate(const DxfGroups& groups, std::span<Vector3d> corners) {
  const int code = groups.code();
  const int axis = code / 10 - 1;
  const auto corner = static_cast<std::size_t>(code % 10);
  if (axis < 0 || axis > 2 || code < 10 || corner >= corners.size()) return;
  corners[corner][axis] = groups.real();
}

class DxfReader {
 public:
  DxfReader(const std::filesystem::path& path, std::string_view text) : groups_(path, text) {}

  void read() {
    bool more = groups_.next();
    while (more && !groups_.is(0, "EOF")) {
      if (groups_.is(0, "SECTION")) {
        more = groups_.next();
        section_ = more && groups_.code() == 2 ? std::string(groups_.value()) : "";
        more = more && groups_.next();
      } else if (groups_.is(0, "ENDSEC")) {
        section_.clear();
        more = groups_.next();
      } else if (groups_.code() == 0 && section_ == "ENTITIES") {
        more = read_entity();
      } else if (groups_.is(9, "$INSUNITS") && section_ == "HEADER") {
        more = groups_.next();
        if (more && groups_.code() == 70) mm_per_unit_ = mm_of(groups_.integer());
      } else {
        if (section_ == "BLOCKS" && groups_.is(0, "BLOCK")) ++blocks_;
        more = groups_.next();
      }
    }
    cut_short_ = !more && !section_.empty();
  }

  /// Whether the file ends within a section.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

  Mesh release_mesh() {
    for (auto& corner : corners_)
      corner *= static_cast<float>(mm_per_unit_);
    Mesh mesh = weld_vertices(corners_);
    const bool all_measured =
        std::all_of(marks_.begin(), marks_.end(), [](Mark mark) { return mark == Mark::Measured; });
    if (!all_measured && marks_.size() == mesh.triangles.size()) mesh.triangle_marks = marks_;
    return mesh;
  }

  /// "3 LINE, 1 CIRCLE" or nothing.
  [[nodiscard]] std::string skipped() const {
    std::string names;
    for (const auto& [name, count] : skipped_)
      names += fmt::format("{}{} {}", names.empty() ? "" : ", ", count, name);
    return names;
  }

 private:
  /// Reads from the name of an entity to the name of the next one.
  bool read_entity() {
    const std::string name(groups_.value());
    if (name == "3DFACE") return read_face();
    if (name == "POLYLINE") return read_polyline();
    if (name == "MESH") return read_mesh_entity();
    if (name != "SEQEND" && name != "VERTEX" && name != "ATTRIB") skip(name);
    return to_next_entity();
  }

  bool to_next_entity() {
    while (groups_.next())
      if (groups_.code() == 0) return true;
    return false;
  }

  void skip(const std::string& name) {
    constexpr std::size_t kMostNames = 40;
    const std::string shown = in_quotes(name).substr(1, in_quotes(name).size() - 2);
    ++skipped_[skipped_.size() < kMostNames || skipped_.contains(shown) ? shown : "others"];
  }

  bool read_face() {
    std::array<Vector3d, 4> corners{};
    corners.fill(Vector3d::Zero());
    Mark mark = Mark::Measured;
    bool has_fourth = false;
    bool more = false;
    while ((more = groups_.next()) && groups_.code() != 0) {
      read_coordinate(groups_, corners);
      has_fourth = has_fourth || groups_.code() == 13;
      if (groups_.code() == 8) mark = mark_of_layer(groups_.value());
    }
    add(corners[0], corners[1], corners[2], mark);
    if (has_fourth && corners[3] != corners[2]) add(corners[0], corners[2], corners[3], mark);
    return more;
  }

  struct Polyline {
    std::int64_t flags = 0, m = 0, n = 0;
    Mark mark = Mark::Measured;
    std::vector<Vector3d> vertices;
    std::vector<std::array<std::int64_t, 4>> faces;
  };

  bool read_polyline() {
    Polyline line;
    bool more = false;
    while ((more = groups_.next()) && groups_.code() != 0) {
      if (groups_.code() == 8) line.mark = mark_of_layer(groups_.value());
      if (groups_.code() == 70) line.flags = groups_.integer();
      if (groups_.code() == 71) line.m = groups_.integer();
      if (groups_.code() == 72) line.n = groups_.integer();
    }
    while (more && groups_.is(0, "VERTEX"))
      more = read_vertex(line);
    if ((line.flags & kPolyface) != 0) {
      add_polyface(line);
    } else if ((line.flags & kPolygonMesh) != 0 && (line.flags & kSplineFit) == 0) {
      add_grid(line);
    } else {
      skip((line.flags & kPolygonMesh) != 0 ? "smoothed POLYLINE" : "POLYLINE");
    }
    return more;
  }

  bool read_vertex(Polyline& line) {
    std::array<Vector3d, 1> place{Vector3d::Zero()};
    std::array<std::int64_t, 4> face{};
    std::int64_t flags = 0;
    bool more = false;
    while ((more = groups_.next()) && groups_.code() != 0) {
      const int code = groups_.code();
      if (code == 70) flags = groups_.integer();
      if (code >= 71 && code <= 74)
        face.at(static_cast<std::size_t>(code - 71)) = groups_.integer();
      read_coordinate(groups_, place);
    }
    if ((flags & kFaceRecord) != 0 && (flags & kPolyface) == 0) {
      line.faces.push_back(face);
    } else {
      line.vertices.push_back(place[0]);
    }
    return more;
  }

  /// Indices count from 1; a negative one ends an edge that is not drawn; 0 stands for none.
  void add_polyface(const Polyline& line) {
    std::vector<std::size_t> corners;
    for (const auto& face : line.faces) {
      corners.clear();
      for (const std::int64_t index : face) {
        if (index == 0) continue;
        const std::uint64_t number =
            index < 0 ? 0U - static_cast<std::uint64_t>(index) : static_cast<std::uint64_t>(index);
        if (number > line.vertices.size()) {
          groups_.fail(fmt::format(
              "a polyface above refers to vertex {} of only {}", number, line.vertices.size()));
        }
        corners.push_back(number - 1);
      }
      add_polygon(line.vertices, corners, line.mark);
    }
  }

  void add_grid(const Polyline& line) {
    const std::size_t count = line.vertices.size();
    const bool fits = line.m > 1 && line.n > 1 && line.m <= 0xFFFF && line.n <= 0xFFFF &&
                      static_cast<std::size_t>(line.m * line.n) == count;
    if (!fits) {
      groups_.fail(fmt::format(
          "a mesh above says that it has {} x {} vertices and has {}", line.m, line.n, count));
    }
    const auto m = static_cast<std::size_t>(line.m);
    const auto n = static_cast<std::size_t>(line.n);
    const std::size_t rows = (line.flags & 1) != 0 ? m : m - 1;
    const std::size_t columns = (line.flags & 32) != 0 ? n : n - 1;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        const std::size_t below = (i + 1) % m * n;
        const std::array<std::size_t, 4> corners{
            i * n + j, below + j, below + (j + 1) % n, i * n + (j + 1) % n};
        add_polygon(line.vertices, corners, line.mark);
      }
    }
  }

  bool read_mesh_entity() {
    std::vector<Vector3d> vertices;
    std::vector<std::int64_t> list;
    Mark mark = Mark::Measured;
    std::int64_t vertices_left = 0;
    std::int64_t entries_left = 0;
    bool more = false;
    while ((more = groups_.next()) && groups_.code() != 0) {
      const int code = groups_.code();
      if (code == 8) mark = mark_of_layer(groups_.value());
      if (code == 92) vertices_left = groups_.integer();
      if (code == 93) entries_left = groups_.integer();
      if (code == 10 && vertices_left-- > 0) vertices.emplace_back(Vector3d::Zero());
      if (!vertices.empty() && entries_left == 0) read_coordinate(groups_, {&vertices.back(), 1});
      if (code == 90 && entries_left > 0) {
        list.push_back(groups_.integer());
        --entries_left;
      }
    }
    add_faces(vertices, list, mark);
    return more;
  }

  /// A list of counts, each with so many indices from 0 behind it.
  void add_faces(const std::vector<Vector3d>& vertices,
                 const std::vector<std::int64_t>& list,
                 Mark mark) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < list.size();) {
      const std::int64_t count = list[i++];
      if (count < 3 || static_cast<std::uint64_t>(count) > list.size() - i) {
        groups_.fail(fmt::format("a face of the MESH above cannot have {} corners", count));
      }
      corners.clear();
      for (std::int64_t k = 0; k < count; ++k) {
        const std::int64_t index = list[i++];
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertices.size()) {
          groups_.fail(fmt::format("the MESH above refers to vertex {}, counted from 0, of only {}",
                                   index,
                                   vertices.size()));
        }
        corners.push_back(static_cast<std::size_t>(index));
      }
      add_polygon(vertices, corners, mark);
    }
  }

  void add_polygon(const std::vector<Vector3d>& vertices,
                   std::span<const std::size_t> corners,
                   Mark mark) {
    for (std::size_t i = 2; i < corners.size(); ++i)
      add(vertices[corners[0]], vertices[corners[i - 1]], vertices[corners[i]], mark);
  }

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, Mark mark) {
    const std::array<Eigen::Vector3f, 3> places{a.cast<float>(), b.cast<float>(), c.cast<float>()};
    for (const auto& place : places) {
      if (!place.allFinite()) groups_.fail("a coordinate above is not finite; remove it");
    }
    if (places[0] == places[1] || places[1] == places[2] || places[2] == places[0]) return;
    corners_.insert(corners_.end(), places.begin(), places.end());
    marks_.push_back(mark);
  }

  DxfGroups groups_;
  bool cut_short_ = false;
  std::string section_;
  double mm_per_unit_ = 1.0;
  std::size_t blocks_ = 0;
  std::map<std::string, std::size_t> skipped_;
  std::vector<Eigen::Vector3f> corners_;
  std::vector<Mark> marks_;
};

}  // namespace

Mesh read_dxf(const std::filesystem::path& path, const Run& run) {
  const std::string text = read_bytes(path);
  if (text.starts_with("AutoCAD Binary DXF")) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: this is a binary DXF; save it as text (ASCII) DXF", path.string()));
  }
  DxfReader reader(path, text);
  reader.read();
  const std::string skipped = reader.skipped();
  Mesh mesh = reader.release_mesh();
  check_mesh(mesh, path);
  if (mesh.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no 3DFACE, polyface or MESH with an area is in it{}{}; explode "
                            "blocks and save surfaces as meshes",
                            path.string(),
                            skipped.empty() ? "" : ", only ",
                            skipped));
  }
  if (reader.cut_short()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it ends within a section, after {} triangles; it was cut short",
                            path.string(),
                            mesh.triangles.size()));
  }
  if (!skipped.empty()) {
    run.warn(fmt::format("{}: left out {}, which are no meshes", path.string(), skipped));
  }
  return mesh;
}

}  // namespace frangia
