#include "merge_verb.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/lowercase_extension.h"
#include "frangia/pipeline/merge_scans.h"

#include "allow_memory.h"
#include "counted.h"
#include "mesh_result.h"
#include "option_values.h"
#include "print_text.h"
#include "text_table.h"
#include "write_options.h"

namespace frangia {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> scans;
  MeshOutputs outputs;
  bool no_register = false;
  MergeScansOptions options;
  ReadOptions read;
};

std::vector<RangeScan> read_all(const std::vector<std::filesystem::path>& paths,
                                const ReadOptions& options) {
  std::vector<RangeScan> scans;
  for (const auto& path : paths) {
    if (lowercase_extension(path) == ".conf") {
      for (RangeScan& scan : read_posed_scans(path, options))
        scans.push_back(std::move(scan));
    } else {
      scans.push_back(read_range_scan(path));
    }
  }
  return scans;
}

nlohmann::ordered_json json_of(const std::vector<MergedScan>& scans) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MergedScan& scan : scans) {
    json.push_back({{"scan", scan.name},
                    {"points", scan.points},
                    {"noise_mm", scan.noise_mm},
                    {"left_out", scan.left_out}});
  }
  return json;
}

/// One line for each scan.
std::string table_of(const std::vector<MergedScan>& scans) {
  TextColumn name{"scan", {}, false};
  TextColumn points{"points", {}};
  TextColumn noise{"noise mm", {}};
  TextColumn state{"", {}, false};
  for (const MergedScan& scan : scans) {
    name.values.push_back(scan.name);
    points.values.push_back(fmt::format("{}", scan.points));
    noise.values.push_back(fmt::format("{:.4f}", scan.noise_mm));
    state.values.emplace_back(scan.left_out ? "left out" : "");
  }
  return text_table({name, points, noise, state});
}

void print_result(const MergedScans& result, const MergeArguments& arguments, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json{{"scans", result.scans.size()},
                                {"per_scan", json_of(result.scans)},
                                {"points", result.points},
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
  write_output(table_of(result.scans));
  print_text("{} points from {} -> {} triangles\n",
             result.points,
             counted(result.scans.size(), "scan"),
             result.mesh.triangles.size());
  print_mesh_summary(terminal, arguments.outputs.paths);
}

void merge(MergeArguments& arguments, Terminal& terminal) {
  arguments.outputs.check();
  arguments.options.register_poses = !arguments.no_register;
  const Run run = terminal.run();
  run.stage("files");
  const std::vector<RangeScan> scans = read_all(arguments.scans, arguments.read);
  terminal.hold();
  const MergedScans result = merge_scans(scans, arguments.options, run);
  run.stage("files");
  arguments.outputs.write_all(result.mesh, run);
  terminal.assess(result.untrusted_reason);
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
  verb->add_option("SCANS",
                   arguments->scans,
                   "range scans as .ply, with faces, with Stanford's range grid, or as points seen "
                   "along -z; or a .conf that lists scans with their poses")
      ->required();
  add_mesh_outputs(*verb, arguments->outputs);
  static const std::map<std::string, ScanPoses> kPoses = {
      {"auto", ScanPoses::Auto}, {"given", ScanPoses::Given}, {"shape", ScanPoses::Shape}};
  verb->add_option("--poses",
                   arguments->options.poses,
                   "poses of the scans: given, as in the files; shape, found from the shape of the "
                   "scans; auto (default), found from the shape if the given ones cannot be right")
      ->transform(named(kPoses));
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
  verb->add_flag("--watertight",
                 arguments->options.finish.watertight,
                 "close all holes; their triangles are marked as synthesized");
  verb->add_option("--tolerance",
                   arguments->options.finish.tolerance_mm,
                   "simplify the mesh within this distance, mm")
      ->transform(length_above_zero());
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { merge(*arguments, terminal); });
}

}  // namespace frangia
