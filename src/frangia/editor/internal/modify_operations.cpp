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

constexpr const char* kModificationGroup = "Modification";
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

std::vector<EditOperation> shape_operations() {
  return {
      {"max-sigmas",
       kModificationGroup,
       "K",
       "limit later smoothing to K sigma of each vertex (3 at first; 0: no limit)",
       [](EditState& s, const Text& v, const Run&) { s.max_sigmas = edit_numbers("K", v)[0]; }},
      {"smooth",
       kModificationGroup,
       "N",
       "smooth the selected triangles, or all, in N iterations",
       [](EditState& s, const Text& v, const Run& run) {
         const SmoothOptions options = smoothing(s, v);
         s.mesh = smooth_taubin(std::move(s.mesh), options, run);
       }},
      {"smooth-keeping-edges",
       kModificationGroup,
       "N",
       "smooth the selected triangles, or all, in N iterations and keep sharp edges",
       [](EditState& s, const Text& v, const Run& run) {
         const KeepEdgesOptions options{.smooth = smoothing(s, v)};
         s.mesh = smooth_keeping_edges(std::move(s.mesh), options, run);
       }},
      {"decimate",
       kModificationGroup,
       "SIZE",
       "reduce the triangles as far as the surface stays within this distance",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = decimate(
             std::move(s.mesh), {.triangles = 0, .tolerance_mm = edit_numbers("SIZE", v)[0]}, run);
       }},
      {"decimate-to",
       kModificationGroup,
       "N",
       "reduce the mesh to at most N triangles",
       [](EditState& s, const Text& v, const Run& run) {
         const auto count = static_cast<std::size_t>(edit_numbers("N", v)[0]);
         s.mesh = decimate(std::move(s.mesh), {.triangles = count}, run);
       }},
      {"remesh",
       kModificationGroup,
       "SIZE",
       "remesh to nearly equilateral triangles with edges of this length",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = remesh_isotropic(s.mesh, {.edge_mm = edit_numbers("SIZE", v)[0]}, run);
       }},
      {"offset",
       kModificationGroup,
       "MM",
       "offset the surface outwards, or inwards by a negative length",
       [](EditState& s, const Text& v, const Run& run) {
         s.mesh = offset_mesh(std::move(s.mesh), edit_numbers("MM", v)[0], run);
       }},
  };
}

std::vector<EditOperation> frame_operations() {
  const auto cut = [](EditState& s, const Text& v, bool capped, const Run& run) {
    s.mesh = cut_by_plane(
        std::move(s.mesh), edit_plane(edit_numbers(kPlane, v)), {.capped = capped}, run);
  };
  return {
      {"cut",
       kModificationGroup,
       kPlane,
       "keep the side of a plane that its normal X,Y,Z points to; MM is its distance from the "
       "origin along the normal",
       [cut](EditState& s, const Text& v, const Run& run) { cut(s, v, false, run); }},
      {"cut-capped",
       kModificationGroup,
       kPlane,
       "cut in the same way and close the cut with flat triangles",
       [cut](EditState& s, const Text& v, const Run& run) { cut(s, v, true, run); }},
      {"mirror",
       kModificationGroup,
       kPlane,
       "mirror the mesh at a plane",
       [](EditState& s, const Text& v, const Run&) {
         s.mesh = mirror_mesh(std::move(s.mesh), edit_plane(edit_numbers(kPlane, v)));
       }},
      {"align",
       kModificationGroup,
       kPicks,
       "move the mesh so that the planar face around the first point lies in z = 0, around the "
       "second in x = 0 and around the third in y = 0",
       [](EditState& s, const Text& v, const Run&) { align(s, edit_numbers(kPicks, v)); }},
  };
}

}  // namespace

std::vector<EditOperation> modify_operations() {
  std::vector<EditOperation> all = shape_operations();
  for (EditOperation& operation : frame_operations())
    all.push_back(std::move(operation));
  return all;
}

}  // namespace frangia
