#include "merge_verb.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/text.h"
#include "frangia/reconstruct/merge_scans.h"

#include "allow_memory.h"
#include "check_can_write.h"
#include "counted.h"
#include "exit_codes.h"
#include "merge_table.h"
#include "mesh_result.h"
#include "option_values.h"
#include "print_text.h"
#include "write_options.h"

namespace frangia {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> scans;
  double unit_mm = 1.0;
  std::filesystem::path poses;
  MeshOutputs outputs;
  bool no_register = false;
  MergeScansOptions options;
  ReadOptions read;
};

std::vector<RangeScan> read_all(const std::vector<std::filesystem::path>& paths,
                                const ReadOptions& options,
                                double unit_mm,
                                const Run& run) {
  std::vector<RangeScan> scans;
  for (const auto& path : paths) {
    if (lowercase_extension(path) == ".conf") {
      for (RangeScan& scan : read_posed_scans(path, options, run))
        scans.push_back(std::move(scan));
    } else {
      scans.push_back(read_range_scan(path, run, options));
    }
  }
  if (unit_mm != 1.0) {
    for (RangeScan& scan : scans)
      scale_range_scan(scan, unit_mm);
  }
  return scans;
}

/// Rows of a rotation and a translation, as in scan.toml.
nlohmann::ordered_json json_of_pose(const Eigen::Isometry3d& world_from_scan) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    const Eigen::Vector3d values = world_from_scan.linear().row(row).transpose();
    rows.push_back({values.x(), values.y(), values.z()});
  }
  const Eigen::Vector3d shift = world_from_scan.translation();
  return {{"rotation", rows}, {"translation_mm", {shift.x(), shift.y(), shift.z()}}};
}

nlohmann::ordered_json json_of(const std::vector<MergedScan>& scans) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MergedScan& scan : scans) {
    json.push_back({{"scan", scan.name},
                    {"points", scan.points},
                    {"points_read", scan.points_read},
                    {"dropped",
                     {{"unconnected", scan.dropped.unconnected},
                      {"hidden", scan.dropped.hidden},
                      {"too_dense", scan.dropped.too_dense}}},
                    {"noise_mm", scan.noise_mm},
                    {"pose", json_of_pose(scan.world_from_scan)},
                    {"left_out", scan.left_out},
                    {"unverified", scan.unverified}});
  }
  return json;
}

/// Warns of scans so small that their unit is hardly the millimetre.
void warn_of_small_scans(const std::vector<RangeScan>& scans, double unit_mm, const Run& run) {
  constexpr double kSmall_mm = 2.0;  // no scanner that merging is for measures such a part
  double size = 0.0;
  for (const RangeScan& scan : scans) {
    Eigen::AlignedBox3f box;
    for (const auto& point : scan.mesh.vertices_mm)
      box.extend(point);
    if (!box.isEmpty()) size = std::max(size, static_cast<double>(box.diagonal().norm()));
  }
  if (unit_mm != 1.0 || !(size > 0.0) || size >= kSmall_mm) return;
  run.warn(
      fmt::format("the largest scan is {} mm large; if the unit of the files is another, set "
                  "`units` to it, such as m or in",
                  readable_mm(size)));
}

void print_result(const MergedScans& result, const MergeArguments& arguments, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json{{"scans", result.scans.size()},
                                {"per_scan", json_of(result.scans)},
                                {"points", result.points},
                                {"islands_removed", json_of(result.islands)},
                                {"vertices", result.mesh.vertices_mm.size()},
                                {"triangles", result.mesh.triangles.size()}};
    if (result.registration) {
      json["registration"] = {{"rms_before_mm", result.registration->rms_before_mm},
                              {"rms_after_mm", result.registration->rms_after_mm},
                              {"overlap", result.registration->overlap}};
    }
    json["contradiction"] = result.contradiction;
    json["poses"] = result.found_poses ? "found" : "given";
    json["left_out"] = nlohmann::ordered_json::array();
    if (result.found_poses) {
      for (const std::size_t scan : result.found_poses->left_out)
        json["left_out"].push_back(scan);
    }
    print_mesh_result(std::move(json), result.untrusted_reason, terminal, arguments.outputs.paths);
    return;
  }
  if (terminal.quiet) return;
  write_output(merge_table(result.scans));
  write_output(dropped_text(result.scans));
  print_text("{} points from {} -> {} triangles{}\n",
             result.points,
             counted(result.scans.size(), "scan"),
             result.mesh.triangles.size(),
             text_of(result.islands));
  std::vector<std::filesystem::path> written = arguments.outputs.paths;
  if (!arguments.poses.empty()) written.push_back(arguments.poses);
  print_mesh_summary(terminal, written);
}

void merge(MergeArguments& arguments, Terminal& terminal) {
  arguments.outputs.check();
  arguments.options.register_poses = !arguments.no_register;
  const Run run = terminal.run();
  run.stage("files");
  if (!arguments.poses.empty()) check_can_write(arguments.poses);
  std::vector<RangeScan> scans = read_all(arguments.scans, arguments.read, arguments.unit_mm, run);
  warn_of_small_scans(scans, arguments.unit_mm, run);
  terminal.hold();
  const MergedScans result = merge_scans(scans, arguments.options, run);
  run.stage("files");
  arguments.outputs.write_all(result.mesh, run);
  if (!arguments.poses.empty()) {
    std::vector<RangeScan> posed;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (result.scans[i].left_out) continue;
      scans[i].world_from_scan = result.scans[i].world_from_scan;
      posed.push_back(std::move(scans[i]));
    }
    write_posed_scans(arguments.poses, posed, 1.0 / arguments.unit_mm);
  }
  terminal.assess(result.untrusted_reason);
  const bool lacks_scans =
      std::any_of(result.scans.begin(), result.scans.end(), [](const MergedScan& scan) {
        return scan.left_out || scan.unverified;
      });
  if (terminal.exit_code == 0 && lacks_scans) terminal.exit_code = DeviceFault;
  print_result(result, arguments, terminal);
}

}  // namespace

void add_merge_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* verb =
      program.add_subcommand("merge", "merge range scans of other scanners into one mesh");
  verb->footer(
      "example:\n  frangia merge bun000.ply bun045.ply -o bunny.ply\n"
      "  frangia merge bun.conf -o bunny.ply -o bunny.dxf\n"
      "  frangia merge front.ply back.ply side.ply --poses shape -o part.stl");
  verb->add_option(
          "SCANS",
          arguments->scans,
          "range scans as meshes, with Stanford's range grid (.ply), or as points seen along "
          "-z, in any format that edit reads; or a .conf that lists scans with their poses")
      ->required();
  add_mesh_outputs(*verb, arguments->outputs);
  verb->add_option("--poses",
                   arguments->options.poses,
                   "poses of the scans: given, as in the files; shape, found from the shape of the "
                   "scans; auto (default), found from the shape if the given ones cannot be right")
      ->transform(named<ScanPoses>());
  verb->add_option("--units",
                   arguments->unit_mm,
                   "unit of the scans: um, mm (default), cm, m, in, ft, or its length, such as "
                   "25.4mm; the mesh is written in mm")
      ->transform(unit_length());
  verb->add_option("--write-poses",
                   arguments->poses,
                   "write the refined poses to a .conf that lists the scans, in their unit");
  verb->add_flag("--no-register", arguments->no_register, "do not refine the poses");
  verb->add_option(
          "--max-distance",
          arguments->options.registration.reach_mm,
          "largest distance between corresponding surfaces before registration, mm; 3 % of "
          "a scan's size by default")
      ->transform(length_above_zero());
  verb->add_option("--voxel",
                   arguments->options.fusion.voxel_mm,
                   "sampling distance of the surface, mm; chosen from the data by default")
      ->transform(length_above_zero());
  verb->add_flag(
      "--keep-islands",
      arguments->options.finish.keep_islands,
      "keep components of a few voxels, or smaller than their sigma, which are removed by "
      "default");
  verb->add_flag("--watertight",
                 arguments->options.finish.watertight,
                 "close all holes; their triangles are marked as synthesized");
  verb->add_option("--tolerance",
                   arguments->options.finish.tolerance_mm,
                   "simplify the mesh within this distance, mm")
      ->transform(length_above_zero());
  add_max_triangles(*verb, arguments->options.finish.max_triangles);
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { merge(*arguments, terminal); });
}

}  // namespace frangia
