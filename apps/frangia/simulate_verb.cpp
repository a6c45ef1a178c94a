#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/files/read_mesh.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_artifact.h"
#include "frangia/simulate/simulate_calibration.h"
#include "frangia/simulate/simulate_scan.h"

#include "counted.h"
#include "print_text.h"
#include "simulate_options.h"
#include "verbs.h"

namespace frangia {
namespace {

Mesh part_of(const std::string& name, const ReadOptions& options, const Run& run) {
  for (const std::string& known : part_names()) {
    if (known == name) return make_part(name, run);
  }
  if (std::filesystem::path(name).has_extension()) return read_mesh(name, run, options);
  throw Error(ErrorKind::Input,
              fmt::format("there is no part \"{}\"; choose one of {}, or a .stl, .ply or .obj file",
                          name,
                          fmt::join(part_names(), ", ")));
}

Rig rig_of(const std::string& name, const Run& run) {
  return std::filesystem::path(name).has_extension() ? read_rig(name, run) : rig_preset(name);
}

/// The stations of all setups, and the part poses of the further ones.
void add_setups(Scan& plan, const Mesh& part, const SimulateArguments& arguments) {
  const int setups = 1 + static_cast<int>(arguments.setup_tilts_deg.size());
  for (int i = 0; i < setups * arguments.views; ++i) {
    plan.views.push_back({kTwoPi * (i % arguments.views) / arguments.views,
                          fmt::format("views/{:03}", i),
                          i / arguments.views});
  }
  for (int setup = 1; setup < setups; ++setup) {
    const double tilt_deg = arguments.setup_tilts_deg[static_cast<std::size_t>(setup) - 1];
    const auto stream = hash(arguments.options.seed, static_cast<std::uint64_t>(setup));
    plan.part_poses[setup] =
        pose_on_table(part, rad_from_deg(tilt_deg), kTwoPi * uniform_from(stream));
  }
}

void print_result(const Scan& scan, const char* truth, Terminal& terminal) {
  const auto seconds = terminal.stage_seconds();
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json result{{"scan", scan.folder.string()},
                                  {"truth", (scan.folder / truth).string()},
                                  {"views", scan.views.size()},
                                  {"patterns", scan.patterns.size()}};
    for (const auto& stage : seconds)
      result["seconds"][stage.first] = stage.second;
    result["warnings"] = terminal.warnings();
    print_json(result);
    return;
  }
  terminal.print_written(fmt::format("{}: {} of {}, and {}",
                                     scan.folder.string(),
                                     counted(scan.views.size(), "view"),
                                     counted(scan.patterns.size(), "pattern"),
                                     truth));
}

/// Renders a screen, a plate or a ball bar instead of a part.
void simulate_artifacts(const SimulateArguments& arguments,
                        const SimulateOptions& options,
                        const Run& run,
                        Terminal& terminal) {
  ArtifactPlan plan;
  plan.folder = arguments.output;
  plan.rig = rig_of(arguments.rig, run);
  plan.views = arguments.views;
  plan.patterns = arguments.patterns;
  if (arguments.calibration == "screen")
    plan.artifact = Screen{.width_px = 1920, .height_px = 1080, .pixel_mm = 0.25};
  if (arguments.calibration == "ball-bar") {
    plan.artifact = Balls{.diameter_mm = 40.0, .spacing_mm = 70.0};
    plan.turn_rad = 1.0;  // one ball does not hide the other
  }
  run.stage("render");
  print_result(simulate_artifact(plan, options, run), "truth-rig.toml", terminal);
}

/// Refuses faults of a scan of a part where poses or artifacts of a calibration are rendered.
void refuse_faults_of_parts(const SimulateArguments& arguments) {
  const SimulatedFrameFaults& frames = arguments.frame_faults;
  const MotionFaults& motion = arguments.options.motion;
  const std::pair<const char*, bool> faults[] = {{"lose_frame", !frames.lost.empty()},
                                                 {"repeat_frame", !frames.repeated.empty()},
                                                 {"lamp_on", !frames.lamps_on.empty()},
                                                 {"video_levels", frames.video_levels},
                                                 {"targets", arguments.discs > 0},
                                                 {"coded_targets", arguments.coded_targets > 0},
                                                 {"slide_part", !arguments.slide_part.empty()},
                                                 {"lost_step", !arguments.lost_step.empty()},
                                                 {"drift", motion.drift_mm != 0.0},
                                                 {"wobble", motion.wobble_mm != 0.0},
                                                 {"table_scale", motion.table_scale != 1.0}};
  for (const auto& [name, is_set] : faults) {
    if (is_set) {
      throw Error(ErrorKind::Input,
                  fmt::format("`{}` is for the scan of a part; leave it out where "
                              "`calibration` is set",
                              name));
    }
  }
}

void refuse_label_of_one_camera(const SimulateArguments& arguments, const Rig& rig) {
  if (!arguments.label || rig.cameras.size() > 1) return;
  throw Error(ErrorKind::Input, "`label` needs a rig with two cameras, such as `--rig binocular`");
}

/// Writes the projector as a label into the rig.toml of a scan, if that was asked for.
void state_label(const SimulateArguments& arguments, Scan& scan) {
  if (!arguments.label) return;
  scan.rig.projector.is_label = true;
  write_rig(scan.folder / "rig.toml", scan.rig);
}

/// Renders poses of a board instead of a part.
void simulate_poses(const SimulateArguments& arguments,
                    const SimulateOptions& options,
                    const Run& run,
                    Terminal& terminal) {
  CalibrationPlan plan;
  plan.folder = arguments.output;
  plan.rig = rig_of(arguments.rig, run);
  plan.board.kind = find_named<BoardKind>(arguments.calibration).value_or(plan.board.kind);
  plan.board.columns = arguments.corners.at(0);
  plan.board.rows = arguments.corners.at(1);
  plan.board.square_mm = arguments.square_mm;
  plan.poses = arguments.views;
  plan.on_turntable = arguments.on_turntable;
  plan.patterns = arguments.patterns;
  refuse_label_of_one_camera(arguments, plan.rig);
  run.stage("render");
  Scan scan = simulate_calibration(plan, options, run);
  state_label(arguments, scan);
  print_result(scan, "truth-rig.toml", terminal);
}

/// Places the stickers that were asked for, and states them in the scan.
void add_stickers(const SimulateArguments& arguments,
                  const Mesh& part,
                  Scan& plan,
                  SimulateOptions& options,
                  const Run& run) {
  if (arguments.discs + arguments.coded_targets == 0) return;
  TargetSet& targets = options.targets;
  if (arguments.discs > 0) targets.diameter_mm = arguments.target_mm;
  if (arguments.coded_targets > 0) {
    targets.dictionary = "DICT_4X4_50";
    targets.marker_mm = 2.0 * arguments.target_mm;
  }
  options.stickers =
      place_stickers(part, targets, arguments.discs, arguments.coded_targets, options.seed, run);
  plan.targets = targets;
}

void simulate(SimulateArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  SimulateOptions& options = arguments.options;
  options.noise = !arguments.no_noise;
  options.step_jitter_rad = rad_from_deg(arguments.step_jitter_deg);
  options.angle_error_rad = rad_from_deg(arguments.angle_error_deg);
  options.axis_tilt_rad = rad_from_deg(arguments.axis_tilt_deg);

  const std::string& kind = arguments.calibration;
  if (!kind.empty()) refuse_faults_of_parts(arguments);
  if (kind == "screen" || kind == "plate" || kind == "ball-bar") {
    simulate_artifacts(arguments, options, run, terminal);
    return;
  }
  if (!kind.empty()) {
    // The corners of a board lie at edges, which one ray a pixel would shift by a quarter of a
    // pixel.
    constexpr int kBoardSamples = 9;  // edges along rows of pixels to 0.03 px
    if (arguments.samples->count() == 0) options.samples_per_px = kBoardSamples;
    simulate_poses(arguments, options, run, terminal);
    return;
  }
  if (arguments.part.empty())
    throw Error(ErrorKind::Input, "name a part, or set `calibration` to render poses of a board");
  run.stage("part");
  Scan plan;
  plan.folder = arguments.output;
  plan.name = std::filesystem::path(arguments.part).stem().string();
  plan.rig = rig_of(arguments.rig, run);
  if (arguments.fringes_per_degree->count() > 0 && !plan.rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                "`fringes_per_degree` is for an angular projector; the rig's is digital: set "
                "`periods`");
  }
  plan.patterns = default_patterns(plan.rig, arguments.patterns);
  const Mesh part = part_of(arguments.part, arguments.read, run);
  add_setups(plan, part, arguments);
  check_frame_faults(arguments.frame_faults, plan);
  read_motion_faults(arguments, plan.views.size());
  SimulateOptions with_lamps = options;
  add_stickers(arguments, part, plan, with_lamps, run);
  with_lamps.lamps_on = lamps_of(arguments.frame_faults, plan);
  run.stage("render");
  refuse_label_of_one_camera(arguments, plan.rig);
  Scan scan = simulate_scan(part, plan, with_lamps, run);
  apply_frame_faults(arguments.frame_faults, scan, run);
  state_label(arguments, scan);
  print_result(scan, "truth.ply", terminal);
}

}  // namespace

void add_simulate_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("simulate", "render a scan of a part, with the true surface");
  verb->footer(
      "Example:\n"
      "  frangia simulate bust --rig carducci -o bust-scan\n"
      "  frangia simulate bracket --setups 90 -o bracket-two-setups\n"
      "  frangia simulate groove --bounces 1 --albedo 0.8 -o groove-scan\n"
      "  frangia simulate bust --slide-part 4:0.15 --drift 0.1mm -o bust-slid\n"
      "  frangia simulate bracket.stl --views 12 --samples 4 --axis-offset 0.5mm -o bracket-scan\n"
      "  frangia simulate --calibration checkerboard --views 12 -o poses\n"
      "  frangia simulate --calibration plate --rig angular --views 13 -o plate");
  auto arguments = std::make_shared<SimulateArguments>();
  add_simulate_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { simulate(*arguments, terminal); });
}

}  // namespace frangia
