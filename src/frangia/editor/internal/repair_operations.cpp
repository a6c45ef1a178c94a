#include <string>
#include <utility>

#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/mesh/bridge_loops.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remove_self_intersections.h"
#include "frangia/mesh/remove_spikes.h"
#include "frangia/mesh/stitch.h"

namespace frangia {
namespace {

constexpr const char* kGroup = "Repairing";

using Text = std::string;

double length_of(const Text& value) {
  return edit_numbers("MM", value)[0];
}
std::size_t count_of_text(const Text& value) {
  return static_cast<std::size_t>(edit_numbers("N", value)[0]);
}

std::vector<EditOperation> of_holes() {
  const auto fill = [](EditState& state, const FillHolesOptions& options, const Run& run) {
    state.mesh = fill_holes(std::move(state.mesh), options, run);
  };
  return {
      {"fill-holes",
       kGroup,
       "MM",
       "close holes up to this size as the surface around them runs",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.up_to_mm = length_of(v), .kind = HoleFill::Smooth}, run);
       }},
      {"fill-holes-flat",
       kGroup,
       "MM",
       "close holes up to this size with flat triangles",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.up_to_mm = length_of(v), .kind = HoleFill::Flat}, run);
       }},
      {"fill-hole",
       kGroup,
       "HOLE",
       "close one hole, by its number in --list, as the surface around it runs",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.kind = HoleFill::Smooth, .only = {count_of_text(v)}}, run);
       }},
      {"fill-hole-flat",
       kGroup,
       "HOLE",
       "close one hole, by its number in --list, with flat triangles",
       [fill](EditState& s, const Text& v, const Run& run) {
         fill(s, {.kind = HoleFill::Flat, .only = {count_of_text(v)}}, run);
       }},
      {"bridge",
       kGroup,
       "HOLE,HOLE",
       "join the boundaries of two holes, by their numbers in --list, by a band",
       [](EditState& s, const Text& v, const Run&) {
         const auto loops = edit_numbers("HOLE,HOLE", v);
         s.mesh = bridge_loops(std::move(s.mesh),
                               static_cast<std::size_t>(loops[0]),
                               static_cast<std::size_t>(loops[1]));
       }},
  };
}

std::vector<EditOperation> of_topology() {
  return {
      {"keep-largest",
       kGroup,
       "N",
       "keep so many parts of the largest area",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = keep_largest_components(std::move(s.mesh), count_of_text(v));
       }},
      {"remove-islands",
       kGroup,
       "MM",
       "drop parts up to this size",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = remove_islands(std::move(s.mesh), length_of(v));
       }},
      {"remove-spikes",
       kGroup,
       "",
       "set tips sharper than a cone of 60 degrees down, cut needles at the boundary off",
       [](EditState& s, const Text&, const Run& run) {
         s.mesh = remove_spikes(std::move(s.mesh), {}, run);
       }},
      {"remove-self-intersections",
       kGroup,
       "",
       "unite closed parts that cross; elsewhere drop what crosses and close what it leaves",
       [](EditState& s, const Text&, const Run& run) {
         s.mesh = remove_self_intersections(std::move(s.mesh), run);
       }},
      {"make-manifold",
       kGroup,
       "",
       "part what is not manifold, drop broken and repeated triangles",
       [](EditState& s, const Text&, const Run&) { s.mesh = make_manifold(std::move(s.mesh)); }},
      {"orient",
       kGroup,
       "",
       "wind neighbours alike and closed parts outwards",
       [](EditState& s, const Text&, const Run&) { s.mesh = orient(std::move(s.mesh)); }},
      {"inside-out",
       kGroup,
       "",
       "turn every triangle to its other side",
       [](EditState& s, const Text&, const Run&) {
         s.mesh = reverse_orientation(std::move(s.mesh));
       }},
      {"stitch",
       kGroup,
       "MM",
       "join boundaries within this distance",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = stitch(std::move(s.mesh), length_of(v));
       }},
  };
}

}  // namespace

std::vector<EditOperation> repair_operations() {
  std::vector<EditOperation> all = of_holes();
  for (EditOperation& operation : of_topology())
    all.push_back(std::move(operation));
  return all;
}

}  // namespace frangia
