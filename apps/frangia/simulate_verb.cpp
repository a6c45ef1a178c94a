#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/files/read_mesh.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "option_values.h"
#include "verbs.h"

namespace frangia {
namespace {

/// What the command line says. Angles in degrees, as everywhere on screen.
struct SimulateArguments {
  std::string part;
  std::string rig = "digital";
  std::filesystem::path output;
  int views = 8;
  std::vector<double> setup_tilts_deg;
  PatternPlan patterns;
  SimulateOptions options;
  bool no_noise = false;
  double step_jitter_deg = 0.0;
  double angle_error_deg = 0.0;
  double axis_tilt_deg = 0.0;
};

void add_scan_options(CLI::App& verb, SimulateArguments& arguments) {
  verb.add_option("part",
                  arguments.part,
                  fmt::format("{}; or a .stl, .ply or .obj file in mm, standing on z = 0 about the "
                              "z axis",
                              fmt::join(part_names(), ", ")))
      ->required();
  verb.add_option("-o,--output", arguments.output, "the scan folder to write")->required();
  verb.add_option("--rig",
                  arguments.rig,
                  fmt::format("{}; or a rig.toml", fmt::join(rig_preset_names(), ", ")))
      ->capture_default_str();
  verb.add_option("--views", arguments.views, "stations of the turntable, evenly over a turn")
      ->check(from_to(1, 3600))
      ->capture_default_str();
  verb.add_option("--setups",
                  arguments.setup_tilts_deg,
                  "further setups of as many views, in each of which the part is tilted by so many "
                  "degrees and set down anyhow, such as 180 or 90,180")
      ->delimiter(',')
      ->check(from_to(-360.0, 360.0));
  verb.add_option("--shifts", arguments.patterns.shifts, "frames of each fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  verb.add_option("--periods",
                  arguments.patterns.periods_px,
                  "a digital projector's fringe periods in pixels, such as 1280,160,20")
      ->delimiter(',')
      ->check(above_zero());
  verb.add_option("--fringes-per-degree",
                  arguments.patterns.fringes_per_degree,
                  "an angular projector's finest fringes")
      ->check(above_zero())
      ->capture_default_str();
  verb.add_option("--sequence",
                  arguments.patterns.sequence,
                  "instead: doubling, negative-exponential, heterodyne or gray, up to --fringes");
  verb.add_option("--exposures",
                  arguments.patterns.exposures_ms,
                  "take each frame at these exposures in ms, such as 2,8; the first is --exposure")
      ->delimiter(',')
      ->check(above_zero());
  verb.add_option("--ramp",
                  arguments.patterns.ramp,
                  "levels of a grey ramp, to measure the projector's response by; 0 for none")
      ->check(from_to(0, 256));
  verb.add_option("--fringes", arguments.patterns.fringes, "over the field, of the --sequence")
      ->check(above_zero())
      ->capture_default_str();
  verb.add_option("--seed", arguments.options.seed, "another seed, other noise")
      ->check(zero_or_more())
      ->capture_default_str();
  verb.add_option("--samples", arguments.options.samples_per_px, "rays a pixel; 4 mix its edges")
      ->capture_default_str();
}

void add_camera_faults(CLI::App& verb, SimulateArguments& arguments) {
  SimulateOptions& options = arguments.options;
  const auto add = [&](const char* name, auto& value, const char* help) {
    verb.add_option(name, value, help)->capture_default_str()->group("Camera");
  };
  add("--bits", options.bits, "8, 10, 12 or 16");
  add("--full-well", options.full_well_e, "electrons of a white pixel");
  add("--read-noise", options.read_e, "electrons");
  add("--exposure", options.exposure, "1 puts the brightest diffuse pixel at 80 % of white");
  add("--ambient", options.ambient, "other light, as a share of white");
  verb.add_flag("--no-noise", arguments.no_noise, "no shot and no read noise")->group("Camera");
}

void add_projector_faults(CLI::App& verb, SimulateArguments& arguments) {
  SimulateOptions& options = arguments.options;
  const auto add = [&](const char* name, double& value, const char* help) {
    verb.add_option(name, value, help)->capture_default_str()->group("Projector");
  };
  add("--contrast", options.contrast, "of the fringes, 0 to 1");
  add("--step-error", options.step_error, "all shifts too large by this share");
  add("--step-jitter", arguments.step_jitter_deg, "degrees rms, for each frame");
  add("--display-gamma", options.display_gamma, "of a digital projector");
  add("--line-width", options.line_sigma_mm, "sigma of the laser sheet, mm");
}

void add_part_faults(CLI::App& verb, SimulateArguments& arguments) {
  SimulateOptions& options = arguments.options;
  const auto add = [&](const char* name, double& value, const char* help) {
    verb.add_option(name, value, help)->capture_default_str()->group("Part");
  };
  add("--texture", options.texture, "dark patches on the surface, 0 to 1");
  add("--gloss", options.gloss, "strength of the highlight");
  add("--shininess", options.shininess, "exponent of the highlight");
  add("--speckle", options.speckle, "contrast of laser speckle, 0 to 1");
  add("--speckle-grain", options.speckle_grain_px, "pixels");
  add("--speckle-correlation",
      options.speckle_correlation,
      "of the two interfering beams; below 1 it moves the phase");
}

void add_turntable_faults(CLI::App& verb, SimulateArguments& arguments) {
  const auto add = [&](const char* name, double& value, const char* help) {
    verb.add_option(name, value, help)->capture_default_str()->group("Turntable");
  };
  add("--angle-error", arguments.angle_error_deg, "degrees rms, for each view");
  add("--axis-offset", arguments.options.axis_offset_mm, "mm from where rig.toml says");
  add("--axis-tilt", arguments.axis_tilt_deg, "degrees from where rig.toml says");
  add("--turntable-top",
      arguments.options.turntable_top_radius_mm,
      "radius of a disc below the part, mm");
}

Mesh part_of(const std::string& name) {
  for (const std::string& known : part_names()) {
    if (known == name) return make_part(name);
  }
  if (std::filesystem::path(name).has_extension()) return read_mesh(name);
  throw Error(ErrorKind::Input,
              fmt::format("there is no part \"{}\"; choose one of {}, or name a .stl, .ply or .obj "
                          "file",
                          name,
                          fmt::join(part_names(), ", ")));
}

Rig rig_of(const std::string& name, const Run& run) {
  return std::filesystem::path(name).has_extension() ? read_rig(name, run) : rig_preset(name);
}

/// The stations of every setup, and how the part stands in the further ones.
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

void simulate(SimulateArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  SimulateOptions& options = arguments.options;
  options.noise = !arguments.no_noise;
  options.step_jitter_rad = rad_from_deg(arguments.step_jitter_deg);
  options.angle_error_rad = rad_from_deg(arguments.angle_error_deg);
  options.axis_tilt_rad = rad_from_deg(arguments.axis_tilt_deg);

  run.stage("part");
  Scan plan;
  plan.folder = arguments.output;
  plan.name = std::filesystem::path(arguments.part).stem().string();
  plan.rig = rig_of(arguments.rig, run);
  plan.patterns = default_patterns(plan.rig, arguments.patterns);
  const Mesh part = part_of(arguments.part);
  add_setups(plan, part, arguments);
  run.stage("render");
  const Scan scan = simulate_scan(part, plan, options, run);
  const auto seconds = terminal.stage_seconds();
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json result{{"scan", scan.folder.string()},
                                  {"truth", (scan.folder / "truth.ply").string()},
                                  {"views", scan.views.size()},
                                  {"patterns", scan.patterns.size()}};
    for (const auto& stage : seconds)
      result["seconds"][stage.first] = stage.second;
    result["warnings"] = terminal.warnings();
    fmt::print("{}\n", result.dump(2));
    return;
  }
  run.note(fmt::format("{}: {} views of {} patterns, and truth.ply",
                       scan.folder.string(),
                       scan.views.size(),
                       scan.patterns.size()));
}

}  // namespace

void add_simulate_verb(CLI::App& program, Terminal& terminal) {
  auto* verb =
      program.add_subcommand("simulate", "render a scan of a part, with the truth beside it");
  verb->footer(
      "Example:\n"
      "  frangia simulate bust --rig carducci -o bust-scan\n"
      "  frangia simulate bracket --setups 90 -o bracket-stood-and-laid\n"
      "  frangia simulate bracket.stl --views 12 --samples 4 --axis-offset 0.5 -o bracket-scan");
  auto arguments = std::make_shared<SimulateArguments>();
  add_scan_options(*verb, *arguments);
  add_camera_faults(*verb, *arguments);
  add_projector_faults(*verb, *arguments);
  add_part_faults(*verb, *arguments);
  add_turntable_faults(*verb, *arguments);
  verb->callback([arguments, &terminal] { simulate(*arguments, terminal); });
}

}  // namespace frangia
