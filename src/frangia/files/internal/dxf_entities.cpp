#include "frangia/files/internal/dxf_entities.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
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

/// Names of layers and blocks are compared without case.
std::string lower_case(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return lower;
}

}  // namespace

void DxfEntities::open_content(const std::string& name) {
  content_ =
      &contents_
           .try_emplace(name, Content{DxfTriangles(groups_, odd_), DxfTriangles(groups_, odd_)})
           .first->second;
  in_block_ = !name.empty();
  in_paper_block_ = name.starts_with("*paper_space");
}

void DxfEntities::hide_layer(const std::string& name, const DxfLayerState& state) {
  hidden_layers_[lower_case(name)] = state;
}

bool DxfEntities::begin_block() {
  std::string name;
  std::array<Vector3d, 1> base{Vector3d::Zero()};
  constexpr std::int64_t kExternal = 4 | 8;
  std::int64_t flags = 0;
  std::string other_drawing;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    if (groups_.code() == 2) name = lower_case(groups_.value());
    if (groups_.code() == 1) other_drawing = in_quotes(groups_.value());
    if (groups_.code() == 70) flags = groups_.integer();
    read_coordinate(groups_, base);
  }
  if (name.empty()) groups_.fail("the block above has no name");
  open_content(name);
  if ((flags & kExternal) != 0) content_->external = other_drawing.empty() ? name : other_drawing;
  content_->base = base[0];
  return more;
}

bool DxfEntities::read_insert() {
  DxfInsert insert;
  std::array<Vector3d, 1> point{Vector3d::Zero()};
  Vector3d scale = Vector3d::Ones();
  Vector3d extrusion = Vector3d::UnitZ();
  double turn_deg = 0.0;
  Eigen::Vector2d spacing = Eigen::Vector2d::Zero();
  Place place;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    const int code = groups_.code();
    take_place(place);
    read_coordinate(groups_, point);
    if (code == 2) insert.block = lower_case(groups_.value());
    if (code >= 41 && code <= 43) scale[code - 41] = groups_.real();
    if (code == 44 || code == 45) spacing[code - 44] = groups_.real();
    if (code == 50) turn_deg = groups_.real();
    if (code == 70) insert.columns = groups_.integer();
    if (code == 71) insert.rows = groups_.integer();
    if (code == 210 || code == 220 || code == 230) extrusion[code / 10 - 21] = groups_.real();
  }
  constexpr std::int64_t kMostCopies = 32'767;
  if (insert.columns < 0 || insert.rows < 0 || insert.columns > kMostCopies ||
      insert.rows > kMostCopies)
    groups_.fail("the INSERT above has a number of rows or columns that is not valid");
  const DxfLayerState layer = place.layer;
  insert.columns = std::max<std::int64_t>(insert.columns, 1);
  insert.rows = std::max<std::int64_t>(insert.rows, 1);
  place.layer.off = false;  // what is inside decides, see expand_blocks
  if (!is_shown(place)) return more;
  insert.layer = layer;
  insert.on_layer_0 = place.on_layer_0;
  const Eigen::Matrix3d axes =
      axes_of_extrusion(extrusion) * Eigen::AngleAxisd(turn_deg * kPi / 180.0, Vector3d::UnitZ());
  insert.mm_from_block.linear() = axes * scale.asDiagonal();
  insert.mm_from_block.translation() = axes_of_extrusion(extrusion) * point[0];
  insert.column_step_mm = spacing.x() * axes.col(0);
  insert.row_step_mm = spacing.y() * axes.col(1);
  content_->inserts.push_back(std::move(insert));
  return more;
}

DxfBlocks DxfEntities::release_blocks(double mm_per_unit) {
  DxfBlocks blocks;
  for (auto& [name, content] : contents_) {
    DxfBlock& block = blocks[name];
    block.mesh = content.triangles.release_mesh(mm_per_unit);
    block.on_layer_0 = content.on_layer_0.release_mesh(mm_per_unit);
    block.entities_on_layer_0 = content.entities_on_layer_0;
    block.external = content.external;
    block.base_mm = mm_per_unit * content.base;
    block.inserts = std::move(content.inserts);
    for (DxfInsert& insert : block.inserts) {
      insert.mm_from_block.translation() *= mm_per_unit;
      insert.column_step_mm *= mm_per_unit;
      insert.row_step_mm *= mm_per_unit;
    }
  }
  return blocks;
}

bool DxfEntities::read() {
  const std::string name(groups_.value());
  if (name == "3DFACE") return read_face();
  if (name == "POLYLINE") return read_polyline();
  if (name == "MESH") return read_mesh_entity();
  if (name == "INSERT") return read_insert();
  if (name != "SEQEND" && name != "VERTEX" && name != "ATTRIB") skip(name);
  return to_next_entity();
}

std::string DxfEntities::skipped() const {
  std::string names;
  for (const auto& [name, count] : skipped_)
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", count, name);
  return names;
}

std::string DxfEntities::left_out() const {
  std::string text;
  const auto add = [&](std::size_t count, const char* where) {
    if (count == 0) return;
    text += fmt::format(
        "{}{} mesh{} of {}", text.empty() ? "" : ", ", count, count == 1 ? "" : "es", where);
  };
  add(hidden_, "layers that are off or frozen");
  add(in_paper_space_, "paper space");
  if (invisible_ > 0)
    text += fmt::format("{}{} mesh{} that {} invisible",
                        text.empty() ? "" : ", ",
                        invisible_,
                        invisible_ == 1 ? "" : "es",
                        invisible_ == 1 ? "is" : "are");
  return text;
}

void DxfEntities::take_place(Place& place) const {
  if (groups_.code() == 67) place.is_in_paper_space = groups_.integer() != 0;
  if (groups_.code() == 60) place.is_invisible = groups_.integer() != 0;
  if (groups_.code() != 8) return;
  place.mark = mark_of_layer(groups_.value());
  place.on_layer_0 = in_block_ && groups_.value() == "0";
  const auto hidden = hidden_layers_.find(lower_case(groups_.value()));
  const bool is_hidden = hidden != hidden_layers_.end() && !place.on_layer_0;
  place.layer = is_hidden ? hidden->second : DxfLayerState{};
}

bool DxfEntities::is_shown(const Place& place) {
  const bool is_hidden = place.layer.off || place.layer.frozen;
  const bool is_in_paper_space = place.is_in_paper_space || in_paper_block_;
  if (is_in_paper_space) {
    ++in_paper_space_;
  } else if (is_hidden) {
    ++hidden_;
  } else if (place.is_invisible) {
    ++invisible_;
  }
  return !is_hidden && !is_in_paper_space && !place.is_invisible;
}

DxfTriangles& DxfEntities::triangles_of(const Place& place) {
  if (!place.on_layer_0) return content_->triangles;
  ++content_->entities_on_layer_0;
  return content_->on_layer_0;
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
  Place place;
  bool has_fourth = false;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    read_coordinate(groups_, corners);
    has_fourth = has_fourth || groups_.code() == 13;
    take_place(place);
  }
  if (!is_shown(place)) return more;
  constexpr std::array<std::size_t, 4> kAll{0, 1, 2, 3};
  const bool is_quad = has_fourth && corners[3] != corners[2] && corners[3] != corners[0];
  triangles_of(place).add_polygon(
      {corners.begin(), corners.end()}, std::span(kAll).first(is_quad ? 4 : 3), place.mark);
  return more;
}

bool DxfEntities::read_polyline() {
  DxfPolyline line;
  Place place;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    take_place(place);
    if (groups_.code() == 70) line.flags = groups_.integer();
    if (groups_.code() == 71) line.m = groups_.integer();
    if (groups_.code() == 72) line.n = groups_.integer();
  }
  line.mark = place.mark;
  while (more && groups_.is(0, "VERTEX"))
    more = read_vertex(line);
  const bool is_mesh = (line.flags & (kPolyface | kPolygonMesh)) != 0;
  if (is_mesh && !is_shown(place)) return more;
  if ((line.flags & kPolyface) != 0) {
    triangles_of(place).add_polyface(line);
  } else if ((line.flags & kPolygonMesh) != 0 && (line.flags & kSplineFit) == 0) {
    triangles_of(place).add_grid(line);
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
  Place place;
  bool is_cage = false;
  std::int64_t vertices_left = 0;
  std::int64_t entries_left = 0;
  bool more = false;
  while ((more = groups_.next()) && groups_.code() != 0) {
    const int code = groups_.code();
    take_place(place);
    if (code == 91 && vertices.empty()) is_cage = groups_.integer() > 0;
    if (code == 92) vertices_left = groups_.integer();
    if (code == 93) entries_left = groups_.integer();
    if (code == 10 && vertices_left-- > 0) vertices.emplace_back(Vector3d::Zero());
    if (!vertices.empty() && entries_left == 0) read_coordinate(groups_, {&vertices.back(), 1});
    if (code == 90 && entries_left > 0) {
      list.push_back(groups_.integer());
      --entries_left;
    }
  }
  if (!is_shown(place)) return more;
  if (is_cage) ++cages_;
  triangles_of(place).add_faces(vertices, list, place.mark);
  return more;
}

}  // namespace frangia
