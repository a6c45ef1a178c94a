#include <string>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/editor/internal/select_by_vertex_data.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/change_selection.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/mesh/self_intersections.h"

namespace frangia {
namespace {

using Numbers = std::vector<double>;

constexpr const char* kGroup = "Selecting";

/// Takes a new selection in, as the state says how.
void combine(EditState& state, Selection fresh) {
  const Combine how = std::exchange(state.combine, Combine::Replace);
  if (how != Combine::Replace && !state.selection.empty()) {
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      const bool both = how == Combine::Add ? (fresh[i] | state.selection[i]) != 0
                                            : (fresh[i] & state.selection[i]) != 0;
      fresh[i] = both ? 1 : 0;
    }
  }
  state.selection = std::move(fresh);
}

/// An operation that selects by numbers.
template <typename Select>
EditOperation by_numbers(const char* name, const char* value, const char* help, Select select) {
  return {name,
          kGroup,
          value,
          help,
          [value, select](EditState& state, const std::string& text, const Run&) {
            combine(state, select(std::as_const(state.mesh), edit_numbers(value, text)));
          }};
}

Selection select_numbered_component(const Mesh& mesh, const Numbers& n) {
  const ConnectedComponents parts = connected_components(mesh);
  require(n[0] < static_cast<double>(parts.components.size()),
          "the mesh has no part of this number; --list shows them");
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i)
    selection[i] = parts.component_of[i] == static_cast<std::uint32_t>(n[0]) ? 1 : 0;
  return selection;
}

Selection select_numbered_loop(const Mesh& mesh, const Numbers& n) {
  const auto loops = boundary_loops(mesh);
  require(n[0] < static_cast<double>(loops.size()),
          "the mesh has no hole of this number; --list shows them");
  return select_loop(mesh, loops[static_cast<std::size_t>(n[0])]);
}

std::vector<EditOperation> by_geometry() {
  using Eigen::Vector3d;
  return {
      by_numbers("select-box",
                 "X,Y,Z,X,Y,Z",
                 "select the triangles in a box, by two of its corners",
                 [](const Mesh& mesh, const Numbers& n) {
                   Eigen::AlignedBox3d box(Vector3d(n[0], n[1], n[2]));
                   return select_by_box(mesh, box.extend(Vector3d(n[3], n[4], n[5])));
                 }),
      by_numbers("select-ball",
                 "X,Y,Z,MM",
                 "select the triangles within a radius of a place",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_ball(mesh, {n[0], n[1], n[2]}, n[3]);
                 }),
      by_numbers(
          "select-plane",
          "X,Y,Z,MM",
          "select the triangles beyond a plane: its normal, and how far along it",
          [](const Mesh& mesh, const Numbers& n) { return select_by_plane(mesh, edit_plane(n)); }),
      by_numbers("select-face",
                 "X,Y,Z",
                 "select the flat face about a place",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_face(mesh, {n[0], n[1], n[2]});
                 }),
      by_numbers("select-normal",
                 "X,Y,Z,DEG",
                 "select the triangles that look within an angle of a direction",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_normal(mesh, {n[0], n[1], n[2]}, rad_from_deg(n[3]));
                 }),
      by_numbers("select-part",
                 "PART",
                 "select a part by its number in --list",
                 select_numbered_component),
      by_numbers("select-loop",
                 "HOLE",
                 "select the triangles around a hole by its number in --list",
                 select_numbered_loop),
  };
}

std::vector<EditOperation> by_data() {
  return {
      by_numbers(
          "select-curvature",
          "PER_MM",
          "select what is curved more than this: 0.5 is a radius of 2 mm",
          [](const Mesh& mesh, const Numbers& n) { return select_by_curvature(mesh, n[0]); }),
      by_numbers("select-sigma",
                 "MM",
                 "select what is less certain than this",
                 [](const Mesh& mesh, const Numbers& n) { return select_by_sigma(mesh, n[0]); }),
      by_numbers("select-views",
                 "N",
                 "select what fewer views than these saw",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_views(mesh, static_cast<int>(n[0]));
                 }),
      {"select-mark",
       kGroup,
       "MARK",
       "select what is measured, moved or invented",
       [](EditState& state, const std::string& value, const Run&) {
         combine(state, select_by_mark(state.mesh, edit_mark(value)));
       }},
      {"select-self-intersections",
       kGroup,
       "",
       "select the triangles that cross others",
       [](EditState& state, const std::string&, const Run& run) {
         combine(state, select_self_intersections(state.mesh, run));
       }},
  };
}

Selection selected(const EditState& state) {
  return state.selection.empty() ? Selection(state.mesh.triangles.size()) : state.selection;
}

std::vector<EditOperation> of_selections() {
  return {
      {"add",
       kGroup,
       "",
       "add the next selection to this one",
       [](EditState& state, const std::string&, const Run&) { state.combine = Combine::Add; }},
      {"within",
       kGroup,
       "",
       "keep of this selection what the next one has, too",
       [](EditState& state, const std::string&, const Run&) { state.combine = Combine::Within; }},
      {"grow",
       kGroup,
       "N",
       "select so many rings of triangles more",
       [](EditState& state, const std::string& value, const Run&) {
         const auto rings = static_cast<int>(edit_numbers("N", value)[0]);
         state.selection = grow_selection(state.mesh, selected(state), rings);
       }},
      {"shrink",
       kGroup,
       "N",
       "select so many rings of triangles less",
       [](EditState& state, const std::string& value, const Run&) {
         const auto rings = static_cast<int>(edit_numbers("N", value)[0]);
         state.selection = shrink_selection(state.mesh, selected(state), rings);
       }},
      {"invert",
       kGroup,
       "",
       "select what is not selected",
       [](EditState& state, const std::string&, const Run&) {
         state.selection = invert_selection(selected(state));
       }},
      {"delete",
       kGroup,
       "",
       "delete what is selected",
       [](EditState& state, const std::string&, const Run& run) {
         require(!state.selection.empty(), "nothing was selected; begin with a --select-...");
         if (count_selected(state.selection) == 0) run.warn("delete: nothing is selected");
         state.mesh = delete_selected(std::move(state.mesh), std::exchange(state.selection, {}));
       }},
  };
}

}  // namespace

std::vector<EditOperation> selection_operations() {
  std::vector<EditOperation> all = by_geometry();
  for (auto kind : {by_data, of_selections}) {
    for (EditOperation& operation : kind())
      all.push_back(std::move(operation));
  }
  return all;
}

}  // namespace frangia
