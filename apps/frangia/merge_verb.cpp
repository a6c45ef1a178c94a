#include "merge_verb.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/files/lowercase_extension.h"
#include "frangia/pipeline/merge_scans.h"

#include "mesh_result.h"
#include "option_values.h"
#include "write_options.h"

namespace frangia {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> scans;
  MeshOutputs outputs;
  bool no_register = false;
  MergeScansOptions options;
};

std::vector<RangeScan> read_all(const std::vector<std::filesystem::path>& paths) {
  std::vector<RangeScan> scans;
  for (const auto& path : paths) {
    if (lowercase_extension(path) == ".conf") {
      for (RangeScan& scan : read_posed_scans(path))
        scans.push_back(std::move(scan));
    } else {
      scans.push_back(read_range_scan(path));
    }
  }
  return scans;
}

void print_result(const MergedScans& result,
                  std::size_t scans,
                  const MergeArguments& arguments,
                  Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json{{"scans", scans},
                                {"points", result.points},
                                {"vertices", result.mesh.vertices_mm.size()},
                                {"triangles", result.mesh.triangles.size()}};
    if (result.registration) {
      json["registration"] = {{"rms_before_mm", result.registration->rms_before_mm},
                              {"rms_after_mm", result.registration->rms_after_mm},
                              {"overlap", result.registration->overlap}};
    }
    json["poses"] = result.found_poses ? "found" : "given";
    json["left_out"] = nlohmann::ordered_json::array();
    if (result.found_poses) {
      for (const std::size_t scan : result.found_poses->left_out)
        json["left_out"].push_back(scan);
    }
    print_mesh_result(std::move(json), terminal, arguments.outputs.paths);
    return;
  }
  if (terminal.quiet) return;
  fmt::print("{} points from {} scans -> {} triangles\n",
             result.points,
             scans,
             result.mesh.triangles.size());
  print_mesh_summary(terminal, arguments.outputs.paths);
}

void merge(MergeArguments& arguments, Terminal& terminal) {
  arguments.outputs.check();
  arguments.options.register_poses = !arguments.no_register;
  const Run run = terminal.run();
  run.stage("files");
  const std::vector<RangeScan> scans = read_all(arguments.scans);
  const MergedScans result = merge_scans(scans, arguments.options, run);
  run.stage("files");
  arguments.outputs.write_all(result.mesh, run);
  print_result(result, scans.size(), arguments, terminal);
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
                   "range scans as .ply: with faces, with Stanford's grid, or of points that face "
                   "+z; all in one frame, each in its own, or named with their poses in a .conf")
      ->required();
  add_mesh_outputs(*verb, arguments->outputs);
  static const std::map<std::string, ScanPoses> kPoses = {
      {"auto", ScanPoses::Auto}, {"given", ScanPoses::Given}, {"shape", ScanPoses::Shape}};
  verb->add_option("--poses",
                   arguments->options.poses,
                   "where the scans stand: given, as the files say; shape, found from their shape; "
                   "auto (the default), found when what the files say cannot be")
      ->transform(named(kPoses));
  verb->add_flag("--no-register", arguments->no_register, "take the poses as they are");
  verb->add_option(
          "--max-distance",
          arguments->options.registration.reach_mm,
          "how far surfaces that are one may lie apart at the start, in mm; 3 % of a scan's "
          "size when not given")
      ->check(above_zero());
  verb->add_option("--voxel",
                   arguments->options.fusion.voxel_mm,
                   "sampling of the surface in mm; chosen from the data when not given")
      ->check(above_zero());
  verb->add_flag("--watertight",
                 arguments->options.finish.watertight,
                 "close what was not seen; each such triangle is marked as synthesized");
  verb->add_option("--tolerance",
                   arguments->options.finish.tolerance_mm,
                   "fewer triangles, never farther than this from the mesh, in mm")
      ->check(above_zero());
  verb->callback([arguments, &terminal] { merge(*arguments, terminal); });
}

}  // namespace frangia
