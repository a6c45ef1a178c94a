#include <string>
#include <utility>

#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"
#include "frangia/geometry/components.h"
#include "frangia/mesh/bridge_loops.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remove_spikes.h"
#include "frangia/mesh/self_intersections.h"
#include "frangia/mesh/stitch.h"

namespace frangia {
namespace {

constexpr const char* kRepairGroup = "Repair";

using Text = std::string;

double size_of(const Text& value) {
  return edit_numbers("SIZE", value)[0];
}
std::size_t hole_of(const Text& value) {
  return static_cast<std::size_t>(edit_numbers("HOLE", value)[0]);
}

std::vector<EditOperation> hole_operations() {
  const auto fill = [](EditState& state, const FillHolesOptions& options, const Run& run) {
    state.mesh = fill_holes(std::move(state.mesh), options, run);
  };
  return {
      {"fill-holes",
       kRepairGroup,
       "SIZE",
       "fill holes up to this size, continuing the curvature around them",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.up_to_mm = size_of(v), .kind = HoleFill::Smooth}, run);
       }},
      {"fill-holes-flat",
       kRepairGroup,
       "SIZE",
       "fill holes up to this size with triangles between their boundary vertices",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.up_to_mm = size_of(v), .kind = HoleFill::Flat}, run);
       }},
      {"fill-hole",
       kRepairGroup,
       "HOLE",
       "fill the hole of this number in `list`, continuing the curvature around it",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.kind = HoleFill::Smooth, .only = {hole_of(v)}}, run);
       }},
      {"fill-hole-flat",
       kRepairGroup,
       "HOLE",
       "fill the hole of this number in `list` with triangles between its boundary vertices",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.kind = HoleFill::Flat, .only = {hole_of(v)}}, run);
       }},
      {"bridge",
       kRepairGroup,
       "HOLE,HOLE",
       "join the boundaries of two holes, by their numbers in `list`, with a band of triangles",
       [](EditState& s, const Text& v, const Run& run) {
         const auto loops = edit_numbers("HOLE,HOLE", v);
         s.mesh = bridge_loops(std::move(s.mesh),
                               static_cast<std::size_t>(loops[0]),
                               static_cast<std::size_t>(loops[1]),
                               run);
       }},
  };
}

std::vector<EditOperation> topology_operations() {
  return {
      {"keep-largest",
       kRepairGroup,
       "N",
       "keep the N components of the largest area",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = keep_largest_components(std::move(s.mesh),
                                          static_cast<std::size_t>(edit_numbers("N", v)[0]));
       }},
      {"remove-islands",
       kRepairGroup,
       "SIZE",
       "remove components up to this size; that of the largest area stays",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = remove_islands(std::move(s.mesh), size_of(v), run);
       }},
      {"remove-spikes",
       kRepairGroup,
       "",
       "flatten tips sharper than a cone of 60 degrees and remove needles at boundaries",
       [](EditState& s, const Text&, const Run& run) {
         s.mesh = remove_spikes(std::move(s.mesh), {}, run);
       }},
      {"remove-self-intersections",
       kRepairGroup,
       "",
       "unite closed components that intersect; elsewhere remove the intersecting triangles and "
       "fill the holes that they leave",
       [](EditState& s, const Text&, const Run& run) {
         s.mesh = remove_self_intersections(std::move(s.mesh), run);
       }},
      {"make-manifold",
       kRepairGroup,
       "",
       "split non-manifold edges and vertices, remove invalid and duplicate triangles",
       [](EditState& s, const Text&, const Run& run) {
         s.mesh = make_manifold(std::move(s.mesh), run);
       }},
      {"orient",
       kRepairGroup,
       "",
       "orient neighbouring triangles consistently and closed components outwards",
       [](EditState& s, const Text&, const Run& run) { s.mesh = orient(std::move(s.mesh), run); }},
      {"reverse-orientation",
       kRepairGroup,
       "",
       "reverse the orientation of every triangle",
       [](EditState& s, const Text&, const Run&) {
         s.mesh = reverse_orientation(std::move(s.mesh));
       }},
      {"stitch",
       kRepairGroup,
       "TOLERANCE",
       "merge boundary vertices within this distance of each other",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = stitch(std::move(s.mesh), edit_numbers("TOLERANCE", v)[0], run);
       }},
  };
}

}  // namespace

std::vector<EditOperation> repair_operations() {
  std::vector<EditOperation> all = hole_operations();
  for (EditOperation& operation : topology_operations())
    all.push_back(std::move(operation));
  return all;
}

}  // namespace frangia
