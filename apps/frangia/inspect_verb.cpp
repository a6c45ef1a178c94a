#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/files/read_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_completeness.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"

#include "option_values.h"
#include "verbs.h"

namespace frangia {
namespace {

struct InspectArguments {
  std::filesystem::path mesh;
  std::filesystem::path reference;
  std::filesystem::path scan;
  std::filesystem::path picture;
  std::string show = "deviation";
  std::vector<double> from_deg{35.0, 20.0};
  double scale_mm = 0.1;
  double within_mm = 0.2;
  double max_angle_deg = 75.0;
};

SurfaceCompleteness completeness_of(const InspectArguments& arguments,
                                    const RayScene& reference,
                                    const RayScene& mesh,
                                    const Run& run) {
  const CompletenessOptions options{.within_mm = arguments.within_mm,
                                    .max_angle_rad = rad_from_deg(arguments.max_angle_deg)};
  if (arguments.scan.empty()) return surface_completeness(reference, mesh, options, run);
  const Scan scan = read_scan(arguments.scan, run);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views)
    poses.push_back(scan.rig.rig_from_object(view.angle_rad));
  return surface_completeness(reference, mesh, MeasurementViews{scan.rig, poses}, options, run);
}

/// What the picture shows of each vertex.
std::vector<float> values_of(const InspectArguments& arguments, const Mesh& mesh) {
  std::vector<float> values;
  if (arguments.show == "sigma") values = mesh.sigma_mm;
  if (arguments.show == "views") values.assign(mesh.views.begin(), mesh.views.end());
  if (arguments.show == "marks") {
    for (const Mark mark : mesh.vertex_marks)
      values.push_back(static_cast<float>(mark));
    // A flat closing has no vertex of its own: its rim shows it.
    for (std::size_t i = 0; i < mesh.triangle_marks.size() && !values.empty(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i])
        values[vertex] = std::max(values[vertex], static_cast<float>(mesh.triangle_marks[i]));
    }
  }
  if (!(arguments.show == "shape" || !values.empty())) {
    throw Error(
        ErrorKind::Input,
        fmt::format(
            "{}: holds no {}; show something else", arguments.mesh.string(), arguments.show));
  }
  return values;
}

void draw(const InspectArguments& arguments,
          const Mesh& mesh,
          const std::optional<RayScene>& reference,
          const Run& run) {
  RenderOptions shade;
  shade.azimuth_rad = rad_from_deg(arguments.from_deg[0]);
  shade.elevation_rad = rad_from_deg(arguments.from_deg[1]);
  const auto scale_mm = static_cast<float>(arguments.scale_mm);
  if (arguments.show == "deviation") {
    require(reference.has_value(), "--show deviation needs a --reference to deviate from");
    shade.values = vertex_errors_mm(mesh, *reference, run);
    shade.value_min = -scale_mm;
    shade.color_map = ColorMap::Diverging;
  } else {
    shade.values = values_of(arguments, mesh);
    shade.color_map = arguments.show == "marks" ? ColorMap::Diverging : ColorMap::Viridis;
  }
  shade.value_max = arguments.show == "marks" ? 2.0F : scale_mm;
  if (arguments.show == "views")
    shade.value_max = *std::max_element(shade.values.begin(), shade.values.end());
  if (arguments.show == "marks") shade.value_min = -2.0F;
  write_png(arguments.picture, render_mesh(mesh, shade, run));
}

void print_result(const SurfaceError& error,
                  const SurfaceCompleteness& completeness,
                  const SurfaceValidity& validity,
                  const InspectArguments& arguments,
                  Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    const nlohmann::ordered_json json{
        {"vertices", error.count},
        {"rms_mm", error.rms_mm},
        {"mean_mm", error.mean_mm},
        {"bias_mm", error.bias_mm},
        {"p95_mm", error.p95_mm},
        {"p99_mm", error.p99_mm},
        {"max_mm", error.max_mm},
        {"sigma_ratio",
         std::isnan(validity.sigma_ratio) ? nlohmann::ordered_json()
                                          : nlohmann::ordered_json(validity.sigma_ratio)},
        {"non_manifold_edges", validity.non_manifold_edges},
        {"inward_triangles", validity.inward_triangles},
        {"completeness", completeness.share},
        {"completeness_within_mm", arguments.within_mm}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print(
      "{} vertices: RMS {:.4f} mm, bias {:+.4f}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      error.bias_mm,
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  fmt::print("{:.1f} % of the {} has mesh within {} mm\n",
             100.0 * completeness.share,
             arguments.scan.empty() ? "reference" : "reference that the scan's views could measure",
             arguments.within_mm);
}

void inspect(const InspectArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const Mesh mesh = read_mesh(arguments.mesh);
  require(!arguments.reference.empty() || !arguments.picture.empty(),
          "nothing to do: name a --reference to measure against, or a --picture to draw");
  std::optional<RayScene> reference;
  if (!arguments.reference.empty()) reference.emplace(read_mesh(arguments.reference));
  if (!arguments.picture.empty()) draw(arguments, mesh, reference, run);
  if (!reference) return;
  const RayScene mesh_scene(mesh);
  const SurfaceError error = surface_error(mesh, *reference, {}, run);
  const SurfaceCompleteness completeness = completeness_of(arguments, *reference, mesh_scene, run);
  print_result(error, completeness, surface_validity(mesh, *reference, run), arguments, terminal);
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png");
  verb->add_option("MESH", arguments->mesh, "the measured mesh: .ply, .stl or .obj")->required();
  verb->add_option("--reference", arguments->reference, "the true shape, in the same frame");
  verb->add_option("--scan",
                   arguments->scan,
                   "count only what the views of this scan could measure as to be covered");
  verb->add_option("--within", arguments->within_mm, "a place is covered with mesh this near, mm")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--max-angle",
                   arguments->max_angle_deg,
                   "a view could measure what camera and light see within this angle, degrees")
      ->check(from_to(1.0, 90.0))
      ->capture_default_str();
  verb->add_option("--picture", arguments->picture, "draw the mesh into this .png");
  verb->add_option("--show",
                   arguments->show,
                   "what its colors are: deviation, sigma, views (how many saw it), marks (red was "
                   "synthesized), or shape for none")
      ->check(one_of({"deviation", "sigma", "views", "marks", "shape"}))
      ->capture_default_str();
  verb->add_option("--from", arguments->from_deg, "where the viewer is: azimuth,elevation, degrees")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  verb->add_option("--scale", arguments->scale_mm, "deviation or sigma of the strongest color, mm")
      ->check(above_zero())
      ->capture_default_str();
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
