// Measures what half and double of each parameter of the fusion do to the mesh of one simulated
// scan. `./run figures sensitivity` runs it on six scans and writes docs/parameters.md.
//
// usage: fusion_sensitivity SCAN [--all] [NAME=VALUE ...]
// Prints one line of JSON for the given values, and with --all one for half and double of each
// parameter. The poses are those of the rig, which a simulated scan has exactly.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/files/ply.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {
namespace {

struct NamedParameter {
  std::string name;
  std::string unit;
  double* value;
};

std::vector<NamedParameter> named_parameters(FusionParameters& p) {
  FieldParameters& f = p.field;
  HermiteParameters& h = p.hermite;
  VertexParameters& v = p.vertices;
  EdgeParameters& e = p.edges;
  CleanupParameters& c = p.cleanup;
  std::vector<NamedParameter> all{
      {"field.voxel_spacings", "pixel spacings", &f.voxel_spacings},
      {"field.voxel_sigmas", "sigmas", &f.voxel_sigmas},
      {"field.band_sigmas", "sigmas", &f.band_sigmas},
      {"field.front_voxels", "voxels", &f.front_voxels},
      {"field.back_voxels", "voxels", &f.back_voxels},
      {"field.falloff_voxels", "voxels", &f.falloff_voxels},
      {"field.near_voxels", "voxels", &f.near_voxels},
      {"field.max_pixel_step_voxels", "voxels", &f.max_pixel_step_voxels},
      {"field.extrapolate_voxels", "voxels", &f.extrapolate_voxels},
      {"field.extrapolated_weight", "1/voxel²", &f.extrapolated_weight},
      {"field.deep_weight", "1/voxel²", &f.deep_weight},
      {"field.deep_bands", "bands", &f.deep_bands},
      {"field.max_step_voxels", "voxels", &f.max_step_voxels},
      {"hermite.same_face_rad", "rad", &h.same_face_rad},
      {"hermite.back_face_rad", "rad", &h.back_face_rad},
      {"hermite.hidden_bands", "bands", &h.hidden_bands},
      {"hermite.clear_sight_px", "px", &h.clear_sight_px},
      {"hermite.clear_sight_share", "", &h.clear_sight_share},
      {"hermite.free_space_factor", "", &h.free_space_factor},
      {"hermite.boundary_share", "", &h.boundary_share},
      {"hermite.boundary_incidence_rad", "rad", &h.boundary_incidence_rad},
      {"hermite.small_window_incidence_rad", "rad", &h.small_window_incidence_rad},
      {"hermite.interpolated_variance", "", &h.interpolated_variance},
      {"hermite.lateral_px", "px", &h.lateral_px},
      {"hermite.boundary_lateral_px", "px", &h.boundary_lateral_px},
      {"hermite.lesser_share", "", &h.lesser_share},
      {"vertices.min_eigenvalue", "", &v.min_eigenvalue},
      {"vertices.parallel_rad", "rad", &v.parallel_rad},
      {"vertices.max_excursion_voxels", "voxels", &v.max_excursion_voxels},
      {"vertices.correlation_px", "px", &v.correlation_px},
      {"edges.chamfer_rad", "rad", &e.chamfer_rad},
      {"edges.face_reach_voxels", "voxels", &e.face_reach_voxels},
      {"edges.min_face_vertices", "vertices", &e.min_face_vertices},
      {"edges.face_normal_rad", "rad", &e.face_normal_rad},
      {"edges.face_offset_voxels", "voxels", &e.face_offset_voxels},
      {"edges.flat_voxels", "voxels", &e.flat_voxels},
      {"edges.flat_sigmas", "sigmas", &e.flat_sigmas},
      {"edges.face_width_voxels", "voxels", &e.face_width_voxels},
      {"edges.min_edge_rad", "rad", &e.min_edge_rad},
      {"edges.max_edge_rad", "rad", &e.max_edge_rad},
      {"edges.check_reach_voxels", "voxels", &e.check_reach_voxels},
      {"edges.on_face_voxels", "voxels", &e.on_face_voxels},
      {"edges.on_face_sigmas", "sigmas", &e.on_face_sigmas},
      {"edges.edge_zone_voxels", "voxels", &e.edge_zone_voxels},
      {"edges.face_vertex_rad", "rad", &e.face_vertex_rad},
      {"edges.to_corner_voxels", "voxels", &e.to_corner_voxels},
      {"edges.to_edge_voxels", "voxels", &e.to_edge_voxels},
      {"edges.to_face_voxels", "voxels", &e.to_face_voxels},
      {"edges.max_split_voxels", "voxels", &e.max_split_voxels},
      {"edges.max_corner_voxels", "voxels", &e.max_corner_voxels},
      {"edges.min_edge_vertices", "vertices", &e.min_edge_vertices},
      {"edges.fold_rad", "rad", &e.fold_rad},
      {"cleanup.sliver_voxels", "voxels", &c.sliver_voxels},
      {"cleanup.diagonal_tolerance", "", &c.diagonal_tolerance},
      {"cleanup.collapse_turn_rad", "rad", &c.collapse_turn_rad},
      {"cleanup.foldover_rad", "rad", &c.foldover_rad},
      {"cleanup.rim_views_share", "", &c.rim_views_share},
  };
  require(all.size() * sizeof(double) == sizeof(FusionParameters),
          "fusion_sensitivity: the list of parameters is not complete");
  return all;
}

struct SimulatedViews {
  explicit SimulatedViews(const std::filesystem::path& folder)
      : scan(read_scan(folder)),
        truth(read_ply(folder / "truth.ply")),
        measured(measure_views(scan, rays_of(scan.rig.reference().model), {}, {})) {
    for (std::size_t i = 0; i < measured.reference().size(); ++i)
      poses.push_back(measured.reference().rig_from_object(i));
  }

  Scan scan;
  RayScene truth;
  MeasuredViews measured;
  std::vector<Eigen::Isometry3d> poses;
};

double sigma_ratio(const Mesh& mesh, const RayScene& truth) {
  const std::vector<float> errors = vertex_errors_mm(mesh, truth);
  double sum = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i)
    sum += std::pow(static_cast<double>(errors[i] / mesh.sigma_mm[i]), 2);
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

void measure(const SimulatedViews& views,
             const FusionParameters& parameters,
             const NamedParameter& changed,
             double factor) {
  const Mesh mesh = fuse_views(
      views.measured.reference(), views.scan.rig.reference().model, {.parameters = parameters});
  const SurfaceError error = surface_error(mesh, views.truth);
  CompletenessOptions how;
  how.samples = 30'000;
  const SurfaceCompleteness covered =
      surface_completeness(views.truth, RayScene(mesh), {views.scan.rig, views.poses}, how);
  fmt::print(R"({{"name":"{}","unit":"{}","value":{},"factor":{},"triangles":{},"rms_mm":{},)"
             R"("p99_mm":{},"max_mm":{},"sigmas":{},"covered":{}}})"
             "\n",
             changed.name,
             changed.unit,
             *changed.value,
             factor,
             mesh.triangles.size(),
             error.rms_mm,
             error.p99_mm,
             error.max_mm,
             sigma_ratio(mesh, views.truth),
             covered.share);
  std::fflush(stdout);
}

void set(const std::vector<NamedParameter>& all, const std::string& argument) {
  const std::size_t equals = argument.find('=');
  const std::string name = argument.substr(0, equals);
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const NamedParameter& each) { return each.name == name; });
  if (found == all.end() || equals == std::string::npos) {
    throw Error(ErrorKind::Input,
                "expected NAME=VALUE with the name of a parameter, not \"" + argument + "\"");
  }
  *found->value = std::stod(argument.substr(equals + 1));
}

void run(const std::vector<std::string>& arguments) {
  require(!arguments.empty(), "usage: fusion_sensitivity SCAN [--all] [NAME=VALUE ...]");
  FusionParameters parameters;
  const std::vector<NamedParameter> all = named_parameters(parameters);
  bool each = false;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--all") {
      each = true;
    } else {
      set(all, arguments[i]);
    }
  }
  const SimulatedViews views{arguments[0]};
  double unchanged = 0.0;
  measure(views, parameters, {"none", "", &unchanged}, 1.0);
  if (!each) return;
  for (const NamedParameter& parameter : all) {
    const double before = *parameter.value;
    for (const double factor : {0.5, 2.0}) {
      *parameter.value = factor * before;
      if (parameter.unit == "rad") *parameter.value = std::min(*parameter.value, kPi);
      measure(views, parameters, parameter, factor);
    }
    *parameter.value = before;
  }
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  try {
    frangia::run({argv + 1, argv + argc});
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fusion_sensitivity: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
