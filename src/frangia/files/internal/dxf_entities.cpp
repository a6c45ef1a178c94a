#include "frangia/files/internal/dxf_entities.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/files/internal/dxf_drawing.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

// Flags of a POLYLINE and of its VERTEX records, group 70.
constexpr std::int64_t kSplineFit = 4;
constexpr std::int64_t kPolygonMesh = 16;
constexpr std::int64_t kPolyface = 64;
constexpr std::int64_t kFaceRecord = 128;

Mark mark_of_layer(std::string_view layer) {
  const auto* const found = std::find(kDxfLayers.begin(), kDxfLayers.end(), layer);
  return found == kDxfLayers.end() ? Mark::Measured : static_cast<Mark>(found - kDxfLayers.begin());
}

/// Sets one coordinate of the corner that the group code names: 10..13 are x, 20..23 y, 30..33 z.
void read_coordinate(const DxfGroups& groups, std::span<Vector3d> corners) {
  const int code = groups.code();
  const int axis = code / 10 - 1;
  const auto corner = static_cast<std::size_t>(code % 10);
  if (axis < 0 || axis > 2 || code < 10 || corner >= corners.size()) return;
  corners[corner][axis] = groups.real();
}

}  // namespace

bool DxfEntities::read() {
  const std::string name(groups_.value());
  if (name == "3DFACE") return read_face();
  if (name == "POLYLINE") return read_polyline();
  if (name == "MESH") return read_mesh_entity();
  if (name != "SEQEND" && name != "VERTEX" && name != "ATTRIB") skip(name);
  return to_next_entity();
}

std::string DxfEntities::skipped() const {
  std::string names;
  for (const auto& [name, count] : skipped_)
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", count, name);
  return names;
}

bool DxfEntities::to_next_entity() {
  while (groups_.next())
    if (groups_.code() == 0) return true;
  return false;
}

void DxfEntities::skip(const std::string& name) {
  constexpr std::size_t kMaxNames = 40;
  const std::string shown = in_quotes(name).substr(1, in_quotes(name).size() - 2);
  ++skipped_[skipped_.size() < kMaxNames || skipped_.contains(shown) ? shown : "others"];
}

bool DxfEntities::read_face() {
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
  triangles_.add(corners[0], corners[1], corners[2], mark);
  if (has_fourth && corners[3] != corners[2])
    triangles_.add(corners[0], corners[2], corners[3], mark);
  return more;
}

bool DxfEntities::read_polyline() {
  DxfPolyline line;
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
    triangles_.add_polyface(line);
  } else if ((line.flags & kPolygonMesh) != 0 && (line.flags & kSplineFit) == 0) {
    triangles_.add_grid(line);
  } else {
    skip((line.flags & kPolygonMesh) != 0 ? "smoothed POLYLINE" : "POLYLINE");
  }
  return more;
}

bool DxfEntities::read_vertex(DxfPolyline& line) {
  std::array<Vector3d, 1> position{Vector3d::Zero()};
  std::array<std::int64_t, 4> face{};
  std::int64_t flags = 0;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    const int code = groups_.code();
    if (code == 70) flags = groups_.integer();
    if (code >= 71 && code <= 74) face.at(static_cast<std::size_t>(code - 71)) = groups_.integer();
    read_coordinate(groups_, position);
  }
  if ((flags & kFaceRecord) != 0 && (flags & kPolyface) == 0) {
    line.faces.push_back(face);
  } else {
    line.vertices.push_back(position[0]);
  }
  return more;
}

bool DxfEntities::read_mesh_entity() {
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
  triangles_.add_faces(vertices, list, mark);
  return more;
}

}  // namespace frangia
