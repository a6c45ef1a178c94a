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
#include "frangia/frames/png.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_completeness.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"

#include "allow_memory.h"
#include "fixed_text.h"
#include "option_values.h"
#include "picture_file.h"
#include "print_text.h"
#include "read_surface.h"
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
  bool legend = true;
  int width_px = RenderOptions{}.width_px;
  int height_px = RenderOptions{}.height_px;
  ReadOptions read;
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

/// The values of the vertices that --show names.
std::vector<float> values_of(const InspectArguments& arguments, const Mesh& mesh) {
  std::vector<float> values;
  if (arguments.show == "sigma") values = mesh.sigma_mm;
  if (arguments.show == "views") values.assign(mesh.views.begin(), mesh.views.end());
  return values;
}

/// Checks before the work that the mesh has what --show names.
void check_shown(const InspectArguments& arguments, const Mesh& mesh) {
  const std::string& show = arguments.show;
  if (show == "deviation") {
    require(!arguments.reference.empty(),
            "--show deviation needs a --reference; give one, or choose another --show");
  }
  const bool missing =
      (show == "sigma" && mesh.sigma_mm.empty()) || (show == "views" && mesh.views.empty()) ||
      (show == "marks" && mesh.vertex_marks.empty() && mesh.triangle_marks.empty());
  if (!missing) return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: the file has no {}; choose another --show, such as shape",
                          arguments.mesh.string(),
                          show));
}

void draw(const InspectArguments& arguments,
          const Mesh& mesh,
          const std::optional<RayScene>& reference,
          const Run& run) {
  RenderOptions options;
  options.azimuth_rad = rad_from_deg(arguments.from_deg[0]);
  options.elevation_rad = rad_from_deg(arguments.from_deg[1]);
  options.legend = arguments.legend;
  options.width_px = arguments.width_px;
  options.height_px = arguments.height_px;
  options.value_max = static_cast<float>(arguments.scale_mm);
  if (arguments.show == "deviation") {
    options.values = vertex_errors_mm(mesh, *reference, run);
    options.value_min = -options.value_max;
    options.color_map = ColorMap::Diverging;
    options.value_label = "deviation, mm";
  } else if (arguments.show == "marks") {
    options.show_marks = true;
  } else {
    options.values = values_of(arguments, mesh);
    options.value_label = arguments.show == "sigma" ? "sigma, mm" : "views";
  }
  if (arguments.show == "views") {
    options.value_max = *std::max_element(options.values.begin(), options.values.end());
    options.whole_values = true;
  }
  write_png(arguments.picture, render_mesh(mesh, options, run));
}

void print_result(const SurfaceError& error,
                  const SurfaceCompleteness& completeness,
                  const SurfaceValidity& validity,
                  const InspectArguments& arguments,
                  Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json{
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
    if (!arguments.picture.empty()) json["picture"] = arguments.picture.string();
    print_json(json);
    return;
  }
  print_text(
      "{} vertices: RMS {:.4f} mm, bias {}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      signed_text(error.bias_mm, 4),
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  print_text("{:.1f} % of the {} has mesh within {} mm\n",
             100.0 * completeness.share,
             arguments.scan.empty() ? "reference" : "reference that the scan's views could measure",
             arguments.within_mm);
}

void inspect(const InspectArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  require(!arguments.reference.empty() || !arguments.picture.empty(),
          "nothing to do: give a --reference to measure against or a --picture to draw");
  if (!arguments.picture.empty()) check_picture_output(arguments.picture);
  const Mesh mesh = read_surface(arguments.mesh, run, arguments.read);
  if (!arguments.picture.empty()) check_shown(arguments, mesh);
  std::optional<RayScene> reference;
  if (!arguments.reference.empty())
    reference.emplace(read_surface(arguments.reference, run, arguments.read), run);
  if (!arguments.picture.empty()) draw(arguments, mesh, reference, run);
  if (!reference) {
    if (terminal.json) {
      print_json(nlohmann::ordered_json{{"picture", arguments.picture.string()}});
    }
    terminal.print_written(arguments.picture.string());
    return;
  }
  const RayScene mesh_scene(mesh, run);
  const SurfaceError error = surface_error(mesh, *reference, {}, run);
  const SurfaceCompleteness completeness = completeness_of(arguments, *reference, mesh_scene, run);
  print_result(error, completeness, surface_validity(mesh, *reference, run), arguments, terminal);
  if (!arguments.picture.empty()) terminal.print_written(arguments.picture.string());
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png");
  verb->add_option("MESH", arguments->mesh, "the measured mesh")->required();
  verb->add_option("--reference", arguments->reference, "the reference mesh, in the same frame");
  verb->add_option("--scan",
                   arguments->scan,
                   "completeness counts only what the views of this scan can measure");
  verb->add_option("--within",
                   arguments->within_mm,
                   "a point of the reference is covered by mesh within this distance, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb->add_option(
          "--max-angle",
          arguments->max_angle_deg,
          "a view can measure surfaces whose normal is within this angle of camera and projector, "
          "degrees")
      ->check(from_to(1.0, 90.0))
      ->capture_default_str();
  verb->add_option(
      "--picture", arguments->picture, "draw the mesh into this .png, with a color scale");
  verb->add_option("--width", arguments->width_px, "of the picture without its scale, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb->add_option("--height", arguments->height_px, "of the picture, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb->add_option(
          "--show",
          arguments->show,
          "what its colors show: deviation, sigma, views (their number), marks, or shape for "
          "none")
      ->check(one_of({"deviation", "sigma", "views", "marks", "shape"}))
      ->capture_default_str();
  verb->add_option(
          "--from", arguments->from_deg, "direction of the viewer: azimuth,elevation, degrees")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  verb->add_option(
          "--scale", arguments->scale_mm, "deviation or sigma at the end of the color scale, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb->add_flag("!--no-legend", arguments->legend, "leave out the color scale");
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
