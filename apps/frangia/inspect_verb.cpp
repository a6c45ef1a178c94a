#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/features/find_features.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_completeness.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"

#include "allow_memory.h"
#include "check_can_write.h"
#include "fixed_text.h"
#include "inspect_alignment.h"
#include "inspect_features.h"
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
  bool features = false;
  AlignmentArguments alignment;
  std::vector<std::filesystem::path> outputs;
  double unit_mm = 1.0;
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

/// What the verb found, for machines and for people.
struct InspectAnswer {
  nlohmann::ordered_json json;
  std::string text;
};

void add_comparison(InspectAnswer& answer,
                    const SurfaceError& error,
                    const SurfaceCompleteness& completeness,
                    const SurfaceValidity& validity,
                    const InspectArguments& arguments) {
  answer.json.update(nlohmann::ordered_json{
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
      {"completeness_within_mm", arguments.within_mm}});
  answer.text += fmt::format(
      "{} vertices: RMS {:.4f} mm, bias {}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      signed_text(error.bias_mm, 4),
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  answer.text += fmt::format(
      "{:.1f} % of the {} has mesh within {} mm\n",
      100.0 * completeness.share,
      arguments.scan.empty() ? "reference" : "reference that the scan's views could measure",
      arguments.within_mm);
}

void compare(InspectAnswer& answer,
             const InspectArguments& arguments,
             const Mesh& mesh,
             const RayScene& reference,
             const Run& run) {
  const RayScene mesh_scene(mesh, run);
  const SurfaceError error = surface_error(mesh, reference, {}, run);
  const SurfaceCompleteness completeness = completeness_of(arguments, reference, mesh_scene, run);
  add_comparison(answer, error, completeness, surface_validity(mesh, reference, run), arguments);
}

/// Checks before the work that the options of the alignment go together.
void check_alignment(const InspectArguments& arguments) {
  const AlignmentArguments& alignment = arguments.alignment;
  require(alignment.align.empty() || !arguments.reference.empty(),
          "--align needs a --reference to align the mesh to; give one");
  require(arguments.outputs.empty() || !alignment.align.empty(),
          "-o writes the aligned mesh; choose how by --align");
  require(alignment.start == 0 || alignment.align == "best-fit",
          "--start chooses a pose of --align best-fit; add it");
  for (const auto& path : arguments.outputs) {
    check_mesh_extension(path);
    check_can_write(path);
  }
}

Mesh read_reference(const InspectArguments& arguments, const Run& run) {
  Mesh reference = read_surface(arguments.reference, run, arguments.read);
  if (arguments.unit_mm == 1.0) return reference;
  for (auto& vertex : reference.vertices_mm)
    vertex *= static_cast<float>(arguments.unit_mm);
  return reference;
}

void inspect(const InspectArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const bool drawn = !arguments.picture.empty();
  require(!arguments.reference.empty() || drawn || arguments.features,
          "nothing to do: give a --reference to measure against, --features, or a --picture to "
          "draw");
  if (drawn) check_picture_output(arguments.picture);
  check_alignment(arguments);
  Mesh mesh = read_surface(arguments.mesh, run, arguments.read);
  if (drawn) check_shown(arguments, mesh);
  std::optional<RayScene> reference;
  if (!arguments.reference.empty()) reference.emplace(read_reference(arguments, run), run);
  InspectAnswer answer;
  if (!arguments.alignment.align.empty()) {
    const Alignment alignment = align(mesh, *reference, arguments.alignment, run);
    add_alignment(answer.json, alignment);
    answer.text += alignment_text(alignment);
    mesh = transform_mesh(std::move(mesh), alignment.pose.reference_from_mesh);
  }
  if (arguments.features) {
    const std::vector<Feature> features = find_features(mesh, {}, run);
    add_features(answer.json, features);
    answer.text += feature_table(features);
  }
  if (drawn) draw(arguments, mesh, reference, run);
  if (reference) compare(answer, arguments, mesh, *reference, run);
  for (const auto& path : arguments.outputs)
    write_mesh(path, mesh, {}, run);
  if (drawn) answer.json["picture"] = arguments.picture.string();
  terminal.finish();
  if (terminal.json) {
    print_json(answer.json);
  } else {
    write_output(answer.text);
  }
  if (drawn) terminal.print_written(arguments.picture.string());
  for (const auto& path : arguments.outputs)
    terminal.print_written(path.string());
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png\n"
      "  frangia inspect blade.ply --reference nominal.stl --align best-fit -o aligned.ply\n"
      "  frangia inspect shaft.ply --features");
  verb->add_option("MESH", arguments->mesh, "the measured mesh")->required();
  verb->add_option("--reference",
                   arguments->reference,
                   "the reference mesh, in the frame of the mesh unless --align finds its pose");
  verb->add_option("--units",
                   arguments->unit_mm,
                   "unit of the reference: um, mm (default), cm, m, in, ft, or its length")
      ->transform(unit_length());
  add_alignment_options(*verb, arguments->alignment);
  verb->add_option("-o,--output",
                   arguments->outputs,
                   "write the aligned mesh; may repeat, the ending chooses the format")
      ->allow_extra_args(false);
  verb->add_flag("--features",
                 arguments->features,
                 "find planes, cylinders, spheres, cones and tori, and the lines and circles where "
                 "they meet, with the uncertainty of their sizes");
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
