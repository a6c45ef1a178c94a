#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "frangia/core/text.h"
#include "frangia/files/ply.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/reconstruct/reconstruct.h"

#include "check_can_write.h"
#include "exit_codes.h"
#include "option_values.h"
#include "reconstruct_options.h"
#include "reconstruct_result.h"
#include "refinement_text.h"
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

/// Whether views are not part of the mesh: a warning says why.
bool leaves_out_views(const Reconstruction& result) {
  return std::any_of(result.view_summaries.begin(),
                     result.view_summaries.end(),
                     [](const ViewSummary& view) { return view.left_out || !view.reason.empty(); });
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
  for (const SetupJoin& join : result.setups)
    for (const std::string& sentence : join.open)
      terminal.lead(sentence);
  for (const RigAgreement& agreement : result.agreements) {
    if (!agreement.is_consistent() && agreement.text() != result.untrusted_reason)
      terminal.lead(agreement.text());
  }
  terminal.assess(result.untrusted_reason);
  if (terminal.exit_code == 0 && leaves_out_views(result)) terminal.exit_code = DeviceFault;
  print_reconstruction(result, arguments.outputs.paths, arguments.raw, terminal);
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
  verb.add_flag("--keep-background",
                arguments.options.keep_background,
                "keep the points of what stands still while the part turns, such as a wall, which "
                "are removed by default");
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
  verb.add_flag(
      "--keep-islands",
      arguments.options.finish.keep_islands,
      "keep components of a few voxels, or smaller than their sigma, which are removed by "
      "default");
  verb.add_flag("--fill-targets",
                arguments.options.fill_targets,
                "close the holes under the stickers of [targets]; their triangles are marked as "
                "synthesized");
  verb.add_flag("--watertight",
                arguments.options.finish.watertight,
                "close all holes; their triangles are marked as synthesized (mark 2 in a PLY, a "
                "layer of their own in a DXF)");
  verb.add_option("--tolerance",
                  arguments.options.finish.tolerance_mm,
                  "simplify the mesh within this distance, mm")
      ->transform(length_above_zero());
  add_max_triangles(verb, arguments.options.finish.max_triangles);
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
  verb->add_option("--colors",
                   arguments->options.colors,
                   "colors of the vertices, from the white frames or else the mean of the fringes: "
                   "linear (default; frames proportional to light), encoded (frames coded for a "
                   "screen, as photographs are) or none")
      ->transform(named<FrameColors>());
  verb->callback([arguments, &terminal] {
    arguments->options.register_views = !arguments->no_register;
    arguments->options.indirect_light = !arguments->ignore_indirect_light;
    reconstruct_verb(*arguments, terminal);
  });
}

}  // namespace frangia
