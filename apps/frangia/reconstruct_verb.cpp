#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/files/lowercase_extension.h"
#include "frangia/files/ply.h"
#include "frangia/pipeline/reconstruct.h"

#include "mesh_result.h"
#include "option_values.h"
#include "reconstruct_options.h"
#include "verbs.h"
#include "write_options.h"

namespace frangia {
namespace {

struct ReconstructArguments {
  std::filesystem::path scan;
  MeshOutputs outputs;
  std::filesystem::path raw;
  bool no_register = false;
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

void print_result(const Reconstruction& result,
                  const ReconstructArguments& arguments,
                  Terminal& terminal) {
  if (terminal.json) {
    nlohmann::ordered_json json;
    json["points"] = result.points;
    json["views"] = result.views;
    json["vertices"] = result.mesh.vertices_mm.size();
    json["triangles"] = result.mesh.triangles.size();
    if (!result.raw.points_mm.empty()) json["raw"] = arguments.raw.string();
    if (result.registration) json["registration"] = json_of(*result.registration);
    if (!std::isnan(result.turntable_top_height_mm))
      json["turntable_top_height_mm"] = result.turntable_top_height_mm;
    print_mesh_result(std::move(json), terminal, arguments.outputs.paths);
    return;
  }
  if (terminal.quiet) return;
  terminal.finish();
  fmt::print("{} points from {} views -> {} triangles\n",
             result.points,
             result.views,
             result.mesh.triangles.size());
  print_mesh_summary(terminal, arguments.outputs.paths);
}

void write_outputs(const Reconstruction& result,
                   const ReconstructArguments& arguments,
                   const Run& run) {
  arguments.outputs.write_all(result.mesh, run);
  if (arguments.raw.empty()) return;
  Mesh points;
  points.vertices_mm = result.raw.points_mm;
  points.sigma_mm = result.raw.sigma_mm;
  write_ply(arguments.raw, points);
}

void reconstruct_verb(ReconstructArguments& arguments, Terminal& terminal) {
  arguments.outputs.check();
  arguments.options.keep_raw = !arguments.raw.empty();
  if (arguments.options.keep_raw) {
    require(lowercase_extension(arguments.raw) == ".ply",
            "--keep-raw: points with their sigma are written as .ply; name such a file");
    const AtomicFile probe(arguments.raw);
  }
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run);
  const Reconstruction result = reconstruct(scan, arguments.options, run);
  run.stage("files");
  write_outputs(result, arguments, run);
  print_result(result, arguments, terminal);
}

void add_views_options(CLI::App& verb, ReconstructArguments& arguments) {
  verb.add_option("--clip-below",
                  arguments.options.clip_below_mm,
                  "leave out what lies below this height above the turntable's origin, in mm")
      ->check(a_number());
  verb.add_option("--clip-radius",
                  arguments.options.clip_radius_mm,
                  "leave out what lies farther from the turntable's axis, in mm")
      ->check(above_zero());
  verb.add_flag("--keep-turntable-top",
                arguments.options.keep_turntable_top,
                "do not look for the top of the turntable and leave it out");
  verb.add_flag("--no-register",
                arguments.no_register,
                "take the turntable's axis and angles as the rig and the scan say");
}

void add_surface_options(CLI::App& verb, ReconstructArguments& arguments) {
  verb.add_option("--voxel",
                  arguments.options.fusion.voxel_mm,
                  "sampling of the surface in mm; chosen from the data when not given")
      ->check(above_zero());
  verb.add_flag("--watertight",
                arguments.options.finish.watertight,
                "close what was not seen; each such triangle is marked as synthesized (mark 2 in a "
                "PLY, its own layer in a DXF)");
  verb.add_option("--tolerance",
                  arguments.options.finish.tolerance_mm,
                  "fewer triangles where the part is flat, never farther than this from the mesh, "
                  "in mm")
      ->check(above_zero());
  verb.add_option(
      "--keep-raw", arguments.raw, "write the registered points with sigma to this .ply");
}

}  // namespace

void add_reconstruct_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ReconstructArguments>();
  CLI::App* verb = program.add_subcommand("reconstruct", "turn a scan into a measured mesh");
  verb->footer(
      "example:\n  frangia reconstruct ball-bar -o ball-bar.dxf -o ball-bar.ply --clip-below 1");
  verb->add_option("SCAN", arguments->scan, "the scan folder, with scan.toml and rig.toml")
      ->required();
  add_mesh_outputs(*verb, arguments->outputs);
  add_views_options(*verb, *arguments);
  add_surface_options(*verb, *arguments);
  add_decode_options(*verb, arguments->options.decode);
  verb->callback([arguments, &terminal] {
    arguments->options.register_views = !arguments->no_register;
    reconstruct_verb(*arguments, terminal);
  });
}

}  // namespace frangia
