#include <string>
#include <utility>

#include "frangia/editor/internal/edit_value.h"
#include "frangia/editor/internal/operation_groups.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/mesh/cut_by_plane.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/remesh_isotropic.h"
#include "frangia/mesh/smooth.h"

namespace frangia {
namespace {

constexpr const char* kGroup = "Changing";
constexpr const char* kPlane = "X,Y,Z,MM";
constexpr const char* kPicks = "X,Y,Z,X,Y,Z,X,Y,Z";

using Text = std::string;

SmoothOptions smoothing(const EditState& state, const Text& value) {
  return {.iterations = static_cast<int>(edit_numbers("N", value)[0]),
          .max_sigmas = state.max_sigmas,
          .only = state.selection};
}

void align(EditState& state, const std::vector<double>& n) {
  const auto face = [&](std::size_t i) {
    const Eigen::Vector3d picked(n[i], n[i + 1], n[i + 2]);
    return fit_plane(state.mesh, select_face(state.mesh, picked));
  };
  const Eigen::Isometry3d pose = align_faces(face(0), face(3), face(6));
  state.mesh = transform_mesh(std::move(state.mesh), pose);
}

std::vector<EditOperation> of_shape() {
  return {
      {"max-sigmas",
       kGroup,
       "K",
       "later smoothing moves no vertex farther than so many of its sigma (3; 0: no bound)",
       [](EditState& s, const Text& v, const Run&) { s.max_sigmas = edit_numbers("K", v)[0]; }},
      {"smooth",
       kGroup,
       "N",
       "take away noise, in so many iterations; of what is selected, or all",
       [](EditState& s, const Text& v, const Run& run) {
         const SmoothOptions options = smoothing(s, v);
         s.mesh = smooth_taubin(std::move(s.mesh), options, run);
       }},
      {"smooth-keeping-edges",
       kGroup,
       "N",
       "take away noise and keep edges, in so many iterations; of what is selected, or all",
       [](EditState& s, const Text& v, const Run& run) {
         const KeepEdgesOptions options{.smooth = smoothing(s, v)};
         s.mesh = smooth_keeping_edges(std::move(s.mesh), options, run);
       }},
      {"decimate",
       kGroup,
       "MM",
       "as few triangles as stay within this distance everywhere",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = decimate(
             std::move(s.mesh), {.triangles = 0, .tolerance_mm = edit_numbers("MM", v)[0]}, run);
       }},
      {"decimate-to",
       kGroup,
       "N",
       "so many triangles",
       [](EditState& s, const Text& v, const Run& run) {
         const auto count = static_cast<std::size_t>(edit_numbers("N", v)[0]);
         s.mesh = decimate(std::move(s.mesh), {.triangles = count}, run);
       }},
      {"remesh",
       kGroup,
       "MM",
       "triangles alike, with edges of about this length",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = remesh_isotropic(s.mesh, {.edge_mm = edit_numbers("MM", v)[0]}, run);
       }},
      {"offset",
       kGroup,
       "MM",
       "move the surface outwards, or inwards by a negative number",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = offset_mesh(std::move(s.mesh), edit_numbers("MM", v)[0]);
       }},
  };
}

std::vector<EditOperation> of_frame() {
  const auto cut = [](EditState& s, const Text& v, bool capped, const Run& run) {
    s.mesh = cut_by_plane(
        std::move(s.mesh), edit_plane(edit_numbers(kPlane, v)), {.capped = capped}, run);
  };
  return {
      {"cut",
       kGroup,
       kPlane,
       "keep what lies beyond a plane: its normal, and how far along it",
       [cut](EditState& s, const Text& v, const Run& run) { cut(s, v, false, run); }},
      {"cut-capped",
       kGroup,
       kPlane,
       "the same, and close the cut",
       [cut](EditState& s, const Text& v, const Run& run) { cut(s, v, true, run); }},
      {"mirror",
       kGroup,
       kPlane,
       "mirror at a plane",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = mirror_mesh(std::move(s.mesh), edit_plane(edit_numbers(kPlane, v)));
       }},
      {"align",
       kGroup,
       kPicks,
       "move the part so that the face about the first place lies in z = 0, about the second in "
       "x = 0, about the third in y = 0",
       [](EditState& s, const Text& v, const Run&) { align(s, edit_numbers(kPicks, v)); }},
  };
}

}  // namespace

std::vector<EditOperation> modify_operations() {
  std::vector<EditOperation> all = of_shape();
  for (EditOperation& operation : of_frame())
    all.push_back(std::move(operation));
  return all;
}

}  // namespace frangia
