// Above 250 lines: half of it are the options and their help.
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/lowercase_extension.h"
#include "frangia/files/ply.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/pipeline/reconstruct.h"

#include "check_can_write.h"
#include "counted.h"
#include "fixed_text.h"
#include "mesh_result.h"
#include "option_values.h"
#include "print_text.h"
#include "quality_json.h"
#include "reconstruct_options.h"
#include "refinement_text.h"
#include "text_table.h"
#include "verbs.h"
#include "write_options.h"

namespace frangia {
namespace {

struct ReconstructArguments {
  std::filesystem::path scan;
  MeshOutputs outputs;
  std::filesystem::path raw;
  bool no_register = false;
  bool ignore_indirect_light = false;
  ReconstructOptions options;
};

nlohmann::ordered_json json_of(const RegistrationReport& report) {
  const auto number = [](double value) {  // JSON has no NaN
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
  };
  nlohmann::ordered_json json;
  json["rms_before_mm"] = report.rms_before_mm;
  json["rms_after_mm"] = report.rms_after_mm;
  json["closure_before_deg"] = number(deg_from_rad(report.closure_before_rad));
  json["closure_after_deg"] = number(deg_from_rad(report.closure_after_rad));
  json["overlap"] = report.overlap;
  json["condition"] = report.condition;
  json["weakest"] = report.weakest;
  json["axis"] = {report.table.axis.x(), report.table.axis.y(), report.table.axis.z()};
  json["point_mm"] = {
      report.table.point_mm.x(), report.table.point_mm.y(), report.table.point_mm.z()};
  json["axis_sigma_mm"] = report.axis_sigma_mm;
  json["axis_moved_mm"] = report.axis_moved_mm();
  json["axis_turned_deg"] = deg_from_rad(report.axis_turned_rad());
  json["angles_deg"] = nlohmann::ordered_json::array();
  for (const double angle : report.angles_rad)
    json["angles_deg"].push_back(deg_from_rad(angle));
  json["part_poses"] = nlohmann::ordered_json::array();
  for (const Eigen::Isometry3d& part_pose : report.part_poses) {
    nlohmann::ordered_json rows;
    for (int row = 0; row < 3; ++row)
      rows.push_back({part_pose(row, 0), part_pose(row, 1), part_pose(row, 2), part_pose(row, 3)});
    json["part_poses"].push_back(rows);
  }
  json["kept_rig"] = report.kept_rig;
  json["not_determined"] = report.undetermined;
  json["left_out"] = report.outliers;
  return json;
}

nlohmann::ordered_json json_of(const std::vector<ViewSummary>& views) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ViewSummary& view : views) {
    json.push_back({{"view", view.name},
                    {"angle_deg", deg_from_rad(view.angle_rad)},
                    {"setup", view.setup},
                    {"points", view.points},
                    {"sigma_mm", view.sigma_mm},  // NaN is written as null
                    {"left_out", view.left_out}});
    json.back().update(json_of_quality(view.quality, view.left_out));
  }
  return json;
}

/// The median sigma of the vertices, with its parts where they are known.
nlohmann::ordered_json json_of(const MedianSigma& sigma) {
  nlohmann::ordered_json json{{"combined_mm", sigma.combined_mm}};  // NaN is written as null
  if (std::isnan(sigma.systematic_mm)) return json;
  json["noise_mm"] = sigma.noise_mm;
  json["systematic_mm"] = sigma.systematic_mm;
  return json;
}

/// ", median sigma 0.0123 mm (noise 0.0031, systematic 0.0119)"; empty without a known sigma.
std::string text_of(const MedianSigma& sigma) {
  if (std::isnan(sigma.combined_mm)) return "";
  std::string text = fmt::format(", median sigma {:.4f} mm", sigma.combined_mm);
  if (std::isnan(sigma.systematic_mm)) return text;
  return text +
         fmt::format(" (noise {:.4f}, systematic {:.4f})", sigma.noise_mm, sigma.systematic_mm);
}

/// One line for each view.
std::string table_of(const std::vector<ViewSummary>& views) {
  TextColumn name{"view", {}, false};
  TextColumn setup{"setup", {}};
  TextColumn angle{"angle deg", {}};
  TextColumn points{"points", {}};
  TextColumn sigma{"sigma mm", {}};
  TextColumn state{"", {}, false};
  bool several_setups = false;
  for (const ViewSummary& view : views) {
    several_setups = several_setups || view.setup != views.front().setup;
    name.values.push_back(view.name);
    setup.values.push_back(fmt::format("{}", view.setup));
    angle.values.push_back(fixed_text(deg_from_rad(view.angle_rad), 2));
    points.values.push_back(fmt::format("{}", view.points));
    sigma.values.push_back(std::isnan(view.sigma_mm) ? "-" : fmt::format("{:.4f}", view.sigma_mm));
    state.values.emplace_back(view.left_out ? "left out" : "");
  }
  if (several_setups) return text_table({name, setup, angle, points, sigma, state});
  return text_table({name, angle, points, sigma, state});
}

/// What a disagreement over its noise says about the rig.
const char* verdict(double over_noise) {
  constexpr double kSound = 2.0;  // times the noise: calibrations of real rigs add as much again
  return over_noise <= kSound ? "the rig is consistent"
                              : "errors of the rig's calibration or of the phases exceed the noise";
}

/// The check of the rig by its cameras.
void print_cameras(const Reconstruction& result) {
  if (result.cameras < 2) return;
  if (std::isnan(result.camera_disagreement_mm)) {
    print_text("{} cameras: nothing compares them; fringes in both directions would\n",
               result.cameras);
    return;
  }
  print_text("{} cameras: {:.4f} mm apart (median), {:.1f} times their noise: {}\n",
             result.cameras,
             result.camera_disagreement_mm,
             result.camera_disagreement_over_noise,
             verdict(result.camera_disagreement_over_noise));
}

void print_result(const Reconstruction& result,
                  const ReconstructArguments& arguments,
                  Terminal& terminal) {
  if (terminal.json) {
    nlohmann::ordered_json json;
    json["points"] = result.points;
    json["views"] = result.views;
    json["per_view"] = json_of(result.view_summaries);
    json["vertices"] = result.mesh.vertices_mm.size();
    json["triangles"] = result.mesh.triangles.size();
    json["median_sigma"] = json_of(result.sigma);
    if (!std::isnan(result.disagreement_mm)) {
      json["directions"] = {{"disagreement_mm", result.disagreement_mm},
                            {"over_noise", result.disagreement_over_noise}};
    }
    if (result.cameras > 1) {
      json["cameras"] = {{"count", result.cameras},
                         {"disagreement_mm", result.camera_disagreement_mm},  // NaN becomes null
                         {"over_noise", result.camera_disagreement_over_noise}};
    }
    if (result.indirect_light) {
      json["indirect_light"] = {{"reflectance", result.indirect_light->albedo},
                                {"affected", result.indirect_light->affected},
                                {"largest_mm", result.indirect_light->largest_mm}};
    }
    if (!result.raw.points_mm.empty()) json["raw"] = arguments.raw.string();
    if (result.refinement) json["refinement"] = json_of(*result.refinement);
    if (result.registration) json["registration"] = json_of(*result.registration);
    if (!std::isnan(result.turntable_top_height_mm))
      json["turntable_top_height_mm"] = result.turntable_top_height_mm;
    print_mesh_result(std::move(json), result.untrusted_reason, terminal, arguments.outputs.paths);
    return;
  }
  if (terminal.quiet) return;
  terminal.finish();
  print_cameras(result);
  write_output(table_of(result.view_summaries));
  print_text("{} points from {} -> {} triangles{}\n",
             result.points,
             counted(result.views, "view"),
             result.mesh.triangles.size(),
             text_of(result.sigma));
  if (result.refinement) print_refinement(*result.refinement);
  if (!std::isnan(result.disagreement_mm)) {
    print_text("directions of fringes: {:.4f} mm apart (median), {:.1f} times their noise: {}\n",
               result.disagreement_mm,
               result.disagreement_over_noise,
               verdict(result.disagreement_over_noise));
  }
  print_mesh_summary(terminal, arguments.outputs.paths);
  if (!arguments.raw.empty()) terminal.print_written(arguments.raw.string());
}

void write_outputs(const Reconstruction& result,
                   const ReconstructArguments& arguments,
                   const Run& run) {
  arguments.outputs.write_all(result.mesh, run);
  if (arguments.raw.empty()) return;
  Mesh points;
  points.vertices_mm = result.raw.points_mm;
  points.sigma_mm = result.raw.sigma_mm;
  if (!result.raw.systematic_mm.empty()) {
    points.sigma_noise_mm = result.raw.sigma_mm;
    points.sigma_systematic_mm = result.raw.systematic_mm;
    combine_sigma_parts(points);
  }
  write_ply(arguments.raw, points);
}

void reconstruct_verb(ReconstructArguments& arguments, Terminal& terminal) {
  arguments.outputs.check();
  arguments.options.keep_raw = !arguments.raw.empty();
  if (arguments.options.keep_raw) {
    require(
        lowercase_extension(arguments.raw) == ".ply",
        "`keep_raw` writes points with their sigma as .ply; give a file name that ends with .ply");
    check_can_write(arguments.raw);
  }
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run);
  if (arguments.options.decode.phase_files)
    check_phase_files(*arguments.options.decode.phase_files, scan);
  terminal.hold();
  const Reconstruction result = reconstruct(scan, arguments.options, run);
  run.stage("files");
  write_outputs(result, arguments, run);
  terminal.assess(result.untrusted_reason);
  print_result(result, arguments, terminal);
}

void add_views_options(CLI::App& verb, ReconstructArguments& arguments) {
  verb.add_option("--clip-below",
                  arguments.options.clip_below_mm,
                  "remove points below this height over the turntable's origin, mm")
      ->transform(a_length());
  verb.add_option("--clip-radius",
                  arguments.options.clip_radius_mm,
                  "remove points farther than this from the turntable's axis, mm")
      ->transform(length_above_zero());
  verb.add_flag("--keep-turntable-top",
                arguments.options.keep_turntable_top,
                "keep the points of the turntable top, which are removed by default");
  verb.add_flag("--refine-rig",
                arguments.options.refine_rig,
                "refine the rig by the surfaces of the views first: a projector or camera that "
                "drifted or was knocked after the calibration");
  add_known_length(verb, arguments.options.refinement.ball_distance_mm)->needs("--refine-rig");
  verb.add_flag(
      "--no-register", arguments.no_register, "do not refine the turntable's axis and angles");
  verb.add_flag("--ignore-indirect-light",
                arguments.ignore_indirect_light,
                "do not look for light that parts of the surface throw on each other");
}

void add_surface_options(CLI::App& verb, ReconstructArguments& arguments) {
  verb.add_option("--voxel",
                  arguments.options.fusion.voxel_mm,
                  "sampling distance of the surface, mm; chosen from the data by default")
      ->transform(length_above_zero());
  verb.add_flag("--watertight",
                arguments.options.finish.watertight,
                "close all holes; their triangles are marked as synthesized (mark 2 in a PLY, a "
                "layer of their own in a DXF)");
  verb.add_option("--tolerance",
                  arguments.options.finish.tolerance_mm,
                  "simplify the mesh within this distance, mm")
      ->transform(length_above_zero());
  verb.add_option(
      "--keep-raw", arguments.raw, "write the registered points with their sigma to this .ply");
}

}  // namespace

void add_reconstruct_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ReconstructArguments>();
  CLI::App* verb = program.add_subcommand("reconstruct", "reconstruct a measured mesh from a scan");
  verb->footer(
      "example:\n  frangia reconstruct ball-bar -o ball-bar.dxf -o ball-bar.ply --clip-below 1mm");
  verb->add_option("SCAN", arguments->scan, "the scan folder, with scan.toml and rig.toml")
      ->required();
  add_mesh_outputs(*verb, arguments->outputs);
  add_views_options(*verb, *arguments);
  add_surface_options(*verb, *arguments);
  add_decode_options(*verb, arguments->options.decode);
  static const std::map<std::string, FrameColors> kColors = {{"linear", FrameColors::Linear},
                                                             {"encoded", FrameColors::Encoded},
                                                             {"none", FrameColors::None}};
  verb->add_option("--colors",
                   arguments->options.colors,
                   "colors of the vertices, from the white frames or else the mean of the fringes: "
                   "linear (default; frames proportional to light), encoded (frames coded for a "
                   "screen, as photographs are) or none")
      ->transform(named(kColors));
  verb->callback([arguments, &terminal] {
    arguments->options.register_views = !arguments->no_register;
    arguments->options.indirect_light = !arguments->ignore_indirect_light;
    reconstruct_verb(*arguments, terminal);
  });
}

}  // namespace frangia
