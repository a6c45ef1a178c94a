#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/editor/internal/select_by_vertex_data.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/mesh/self_intersections.h"

namespace frangia {
namespace {

using Numbers = std::vector<double>;

constexpr const char* kSelectionGroup = "Selection";

bool is_selected(Combine how, bool before, bool next) {
  switch (how) {
    case Combine::Replace:
      return next;
    case Combine::Add:
      return before || next;
    case Combine::Within:
      return before && next;
    case Combine::Without:
      return before && !next;
  }
  return next;
}

/// Combines a new selection with the present one as the state asks. Warns when it selects nothing.
void combine(EditState& state, Selection fresh, const char* name, const Run& run) {
  const Combine how = std::exchange(state.combine, Combine::Replace);
  if (how != Combine::Replace && !state.selection.empty()) {
    for (std::size_t i = 0; i < fresh.size(); ++i)
      fresh[i] = is_selected(how, state.selection[i] != 0, fresh[i] != 0) ? 1 : 0;
  }
  if (count_selected(fresh) == 0) run.warn(fmt::format("{}: no triangle is selected", name));
  state.selection = std::move(fresh);
}

/// An operation that makes a selection from numbers.
template <typename Select>
EditOperation by_numbers(const char* name, const char* value, const char* help, Select select) {
  return {name,
          kSelectionGroup,
          value,
          help,
          [name, value, select](EditState& state, const std::string& text, const Run& run) {
            combine(state, select(std::as_const(state.mesh), edit_numbers(value, text)), name, run);
          }};
}

Selection select_numbered_component(const Mesh& mesh, const Numbers& n) {
  const ConnectedComponents parts = connected_components(mesh);
  require(n[0] < static_cast<double>(parts.components.size()),
          "the mesh has no component of this number; `list` shows the components");
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i)
    selection[i] = parts.component_of[i] == static_cast<std::uint32_t>(n[0]) ? 1 : 0;
  return selection;
}

Selection select_numbered_loop(const Mesh& mesh, const Numbers& n) {
  const auto loops = boundary_loops(mesh);
  require(n[0] < static_cast<double>(loops.size()),
          "the mesh has no hole of this number; `list` shows the holes");
  return select_loop(mesh, loops[static_cast<std::size_t>(n[0])]);
}

std::vector<EditOperation> geometry_selections() {
  using Eigen::Vector3d;
  return {
      by_numbers("select-box",
                 "X,Y,Z,X,Y,Z",
                 "select the triangles in a box given by two opposite corners",
                 [](const Mesh& mesh, const Numbers& n) {
                   Eigen::AlignedBox3d box(Vector3d(n[0], n[1], n[2]));
                   return select_by_box(mesh, box.extend(Vector3d(n[3], n[4], n[5])));
                 }),
      by_numbers("select-ball",
                 "X,Y,Z,SIZE",
                 "select the triangles within a radius of a point",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_ball(mesh, {n[0], n[1], n[2]}, n[3]);
                 }),
      by_numbers(
          "select-plane",
          "X,Y,Z,MM",
          "select the side of a plane that its normal X,Y,Z points to; MM is its distance from the "
          "origin along the normal",
          [](const Mesh& mesh, const Numbers& n) { return select_by_plane(mesh, edit_plane(n)); }),
      by_numbers("select-face",
                 "X,Y,Z",
                 "select the planar face around a point",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_face(mesh, {n[0], n[1], n[2]});
                 }),
      by_numbers("select-normal",
                 "X,Y,Z,DEG",
                 "select the triangles whose normal is within an angle of a direction",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_normal(mesh, {n[0], n[1], n[2]}, rad_from_deg(n[3]));
                 }),
      by_numbers("select-component",
                 "COMPONENT",
                 "select a connected component by its number in `list`",
                 select_numbered_component),
      by_numbers("select-loop",
                 "HOLE",
                 "select the triangles around a hole by its number in `list`",
                 select_numbered_loop),
  };
}

EditOperation by_outline(const char* name, const char* help, bool visible_only) {
  return {name,
          kSelectionGroup,
          kOutlinePattern,
          help,
          [name, visible_only](EditState& state, const std::string& value, const Run& run) {
            combine(state,
                    select_by_outline(state.mesh, edit_outline(value), visible_only, run),
                    name,
                    run);
          }};
}

std::vector<EditOperation> outline_selections() {
  return {
      by_outline("select-outline",
                 "select what the first point sees within the outline through the others, as a "
                 "lasso on a screen",
                 true),
      by_outline("select-outline-through",
                 "select everything within the outline as seen from the first point, hidden parts "
                 "included",
                 false),
  };
}

std::vector<EditOperation> vertex_data_selections() {
  return {
      by_numbers(
          "select-curvature",
          "PER_MM",
          "select where the mean curvature is larger: 0.5 is that of a sphere of radius 2 mm",
          [](const Mesh& mesh, const Numbers& n) { return select_by_curvature(mesh, n[0]); }),
      by_numbers("select-sigma",
                 "SIZE",
                 "select where sigma is larger or unknown",
                 [](const Mesh& mesh, const Numbers& n) { return select_by_sigma(mesh, n[0]); }),
      by_numbers("select-views",
                 "N",
                 "select what fewer than N views measured",
                 [](const Mesh& mesh, const Numbers& n) {
                   return select_by_views(mesh, static_cast<int>(n[0]));
                 }),
      {"select-mark",
       kSelectionGroup,
       "MARK",
       "select by mark: measured, displaced or synthesized",
       [](EditState& state, const std::string& value, const Run& run) {
         combine(state, select_by_mark(state.mesh, edit_mark(value)), "select-mark", run);
       }},
      {"select-self-intersections",
       kSelectionGroup,
       "",
       "select the triangles that intersect others",
       [](EditState& state, const std::string&, const Run& run) {
         combine(
             state, select_self_intersections(state.mesh, run), "select-self-intersections", run);
       }},
  };
}

void require_selection(const EditState& state) {
  require(!state.selection.empty(),
          "nothing is selected; select triangles first, for example with `select_box`");
}

/// Grows or shrinks the selection ring by ring, until a ring changes nothing.
void change_by_rings(EditState& state,
                     const std::string& value,
                     Selection (*change)(const Mesh&, Selection, int),
                     const Run& run) {
  require_selection(state);
  const auto rings = static_cast<int>(edit_numbers("N", value)[0]);
  for (int ring = 0; ring < rings; ++ring) {
    run.report(static_cast<double>(ring) / rings);
    Selection changed = change(state.mesh, state.selection, 1);
    if (changed == state.selection) break;
    state.selection = std::move(changed);
  }
}

std::vector<EditOperation> selection_changes() {
  return {
      {"add",
       kSelectionGroup,
       "",
       "add the next selection to the present one",
       [](EditState& state, const std::string&, const Run&) {
         require_selection(state);
         state.combine = Combine::Add;
       }},
      {"within",
       kSelectionGroup,
       "",
       "intersect the present selection with the next one",
       [](EditState& state, const std::string&, const Run&) {
         require_selection(state);
         state.combine = Combine::Within;
       }},
      {"without",
       kSelectionGroup,
       "",
       "take the next selection out of the present one",
       [](EditState& state, const std::string&, const Run&) {
         require_selection(state);
         state.combine = Combine::Without;
       }},
      {"grow",
       kSelectionGroup,
       "N",
       "extend the selection by N rings of triangles",
       [](EditState& state, const std::string& value, const Run& run) {
         change_by_rings(state, value, grow_selection, run);
       }},
      {"shrink",
       kSelectionGroup,
       "N",
       "shrink the selection by N rings of triangles",
       [](EditState& state, const std::string& value, const Run& run) {
         change_by_rings(state, value, shrink_selection, run);
       }},
      {"invert",
       kSelectionGroup,
       "",
       "invert the selection; without one, select everything",
       [](EditState& state, const std::string&, const Run&) {
         if (state.selection.empty()) state.selection.resize(state.mesh.triangles.size());
         state.selection = invert_selection(std::move(state.selection));
       }},
      {"delete",
       kSelectionGroup,
       "",
       "delete the selected triangles",
       [](EditState& state, const std::string&, const Run& run) {
         require_selection(state);
         if (count_selected(state.selection) == 0) {
           run.warn("delete: the selection holds no triangle, so nothing is deleted");
         }
         state.mesh = delete_selected(std::move(state.mesh), std::exchange(state.selection, {}));
       }},
  };
}

}  // namespace

std::vector<EditOperation> selection_operations() {
  std::vector<EditOperation> all = geometry_selections();
  for (auto kind : {outline_selections, vertex_data_selections, selection_changes}) {
    for (EditOperation& operation : kind())
      all.push_back(std::move(operation));
  }
  return all;
}

}  // namespace frangia
