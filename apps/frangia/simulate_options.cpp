#include "simulate_options.h"

#include <charconv>
#include <map>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "allow_memory.h"
#include "direction_option.h"
#include "option_values.h"

namespace frangia {
namespace {

void add_scan_options(CLI::App& verb, SimulateArguments& arguments) {
  verb.add_option(
      "part",
      arguments.part,
      fmt::format("{}; or a .stl, .ply or .obj file in mm, standing on z = 0 around the "
                  "z axis",
                  fmt::join(part_names(), ", ")));
  verb.add_option("-o,--output", arguments.output, "scan folder to write")->required();
  verb.add_option("--rig",
                  arguments.rig,
                  fmt::format("{}; or a rig.toml", fmt::join(rig_preset_names(), ", ")))
      ->capture_default_str();
  verb.add_flag(
      "--label",
      arguments.label,
      "state the projector as a label in rig.toml, without its calibration; the rig needs "
      "two cameras");
  verb.add_option("--views", arguments.views, "turntable stations, evenly over one turn")
      ->check(from_to(1, 3600))
      ->capture_default_str();
  verb.add_option(
          "--setups",
          arguments.setup_tilts_deg,
          "further setups of the same number of views, with the part tilted by these degrees "
          "and at a random place on the table, such as 180 or 90,180")
      ->delimiter(',')
      ->check(from_to(-360.0, 360.0));
  verb.add_option("--shifts", arguments.patterns.shifts, "frames per fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  add_direction_option(verb, arguments.patterns);
  verb.add_option("--periods",
                  arguments.patterns.periods_px,
                  "digital projector: fringe periods, px, such as 1280,160,20")
      ->delimiter(',')
      ->check(above_zero());
  arguments.fringes_per_degree = verb.add_option("--fringes-per-degree",
                                                 arguments.patterns.fringes_per_degree,
                                                 "angular projector: finest fringes")
                                     ->check(above_zero())
                                     ->capture_default_str();
  auto* sequence = verb.add_option(
      "--sequence",
      arguments.patterns.sequence,
      "instead of these: doubling, negative-exponential, heterodyne, gray or gray-alone (no "
      "fringes), with --fringes");
  verb.add_option("--exposures",
                  arguments.patterns.exposures_ms,
                  "capture each frame at these exposures, ms, such as 2,8; the first is --exposure")
      ->delimiter(',')
      ->check(above_zero());
  verb.add_option("--ramp",
                  arguments.patterns.ramp,
                  "levels of a grey ramp to measure the projector response; 0 for none")
      ->check(from_to(0, 256));
  verb.add_flag("--white", arguments.patterns.white, "add a frame of full light for the colors");
  verb.add_flag(
      "--dark", arguments.patterns.dark, "add a frame of the ambient light, which is subtracted");
  verb.add_option(
          "--fringes", arguments.patterns.fringes, "finest fringes of --sequence over the field")
      ->check(above_zero())
      ->needs(sequence)
      ->capture_default_str();
  verb.add_option("--seed", arguments.options.seed, "seed of the random noise")
      ->check(zero_or_more())
      ->capture_default_str();
  arguments.samples =
      verb.add_option("--samples",
                      arguments.options.samples_per_px,
                      "rays per pixel; with 4 a pixel at an edge mixes two surfaces; by default 1, "
                      "and 9 for the poses of a board")
          ->check(from_to(1, 64));
}

void add_calibration_options(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Calibration";
  auto* calibration =
      verb.add_option("--calibration",
                      arguments.calibration,
                      "instead of a part, as many poses of a board as --views: "
                      "checkerboard, charuco or circles; a screen before the "
                      "camera; or a plate or ball-bar that turns on the table")
          ->check(one_of({"checkerboard", "charuco", "circles", "screen", "plate", "ball-bar"}))
          ->group(kGroup);
  verb.add_option("--corners", arguments.corners, "points of the board along x and y")
      ->delimiter(',')
      ->expected(2)
      ->check(from_to(3, 100))
      ->needs(calibration)
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option(
          "--square", arguments.square_mm, "side of a square; by default, it fits the field")
      ->transform(length_above_zero())
      ->needs(calibration)
      ->group(kGroup);
  verb.add_flag("--on-turntable",
                arguments.on_turntable,
                "the board stands on the turntable, which turns by 57 degrees in all")
      ->needs(calibration)
      ->group(kGroup);
}

/// Adds one option to `group`. The caller adds the check of its values.
template <typename Value>
CLI::Option* add_fault(
    CLI::App& verb, const char* group, const char* name, Value& value, const char* help) {
  return verb.add_option(name, value, help)->capture_default_str()->group(group);
}

void add_camera_faults(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Camera";
  SimulateOptions& options = arguments.options;
  add_fault(verb, kGroup, "--bits", options.bits, "8, 10, 12 or 16")
      ->check(one_of({"8", "10", "12", "16"}));
  add_fault(verb, kGroup, "--full-well", options.full_well_e, "electrons of a white pixel")
      ->check(above_zero());
  add_fault(verb, kGroup, "--read-noise", options.read_e, "read noise, electrons rms")
      ->check(zero_or_more());
  add_fault(verb,
            kGroup,
            "--exposure",
            options.exposure,
            "relative exposure; at 1 the brightest diffuse pixel is at 80 % of white")
      ->check(above_zero());
  add_fault(verb, kGroup, "--ambient", options.ambient, "ambient light, as a share of white")
      ->check(zero_or_more());
  add_fault(verb,
            kGroup,
            "--backdrop",
            options.backdrop,
            "light of a lit background behind the part, as a share of white; with --dark the "
            "silhouettes of the part are checked")
      ->check(from_to(0.0, 1.0));
  add_fault(
      verb, kGroup, "--camera-blur", options.camera_blur_px, "sigma of the blur of its lens, px")
      ->check(from_to(0.0, 20.0));
  verb.add_flag("--no-noise", arguments.no_noise, "no shot and no read noise")->group(kGroup);
}

void add_projector_faults(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Projector";
  SimulateOptions& options = arguments.options;
  add_fault(verb, kGroup, "--contrast", options.contrast, "fringe contrast, 0 to 1")
      ->check(from_to(0.0, 1.0));
  add_fault(verb, kGroup, "--step-error", options.step_error, "relative error of all phase steps")
      ->check(a_number());
  add_fault(verb,
            kGroup,
            "--step-jitter",
            arguments.step_jitter_deg,
            "phase-shift jitter of each frame, degrees rms")
      ->check(zero_or_more());
  add_fault(verb, kGroup, "--display-gamma", options.display_gamma, "gamma of a digital projector")
      ->check(above_zero());
  add_fault(verb,
            kGroup,
            "--flicker",
            options.flicker,
            "rms relative error of the projector's light, independent per frame, such as 0.02")
      ->check(from_to(0.0, 0.5));
  verb.add_option("--waveform",
                  options.waveform,
                  "how a digital projector shows fringes: sine (default), binary or dithered")
      ->transform(named<DisplayedWaveform>())
      ->group(kGroup);
  add_fault(verb,
            kGroup,
            "--projector-blur",
            options.projector_blur_px,
            "sigma of the blur of fringes, px of a digital projector; it weakens harmonics of fine "
            "fringes")
      ->check(zero_or_more());
  add_fault(verb, kGroup, "--line-width", options.line_sigma_mm, "sigma of the laser sheet, mm")
      ->transform(length_above_zero());
}

void add_part_faults(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Part";
  SimulateOptions& options = arguments.options;
  add_fault(verb, kGroup, "--texture", options.texture, "strength of dark patches, 0 to 1")
      ->check(from_to(0.0, 1.0));
  constexpr double kChecker_mm = 8.0;
  verb.add_option_function<std::string>(
          "--paint",
          [&options](const std::string& paint) {
            options.checker_mm = paint == "checker" ? kChecker_mm : 0.0;
          },
          "none (default), or checker: cubes of 8 mm, of albedo 0.10 and 0.85")
      ->check(one_of({"none", "checker"}))
      ->group(kGroup);
  verb.add_option("--targets", arguments.discs, "dark discs on flat places")
      ->check(from_to(1, 200))
      ->group(kGroup);
  verb.add_option("--coded-targets",
                  arguments.coded_targets,
                  "stickers with a marker of DICT_4X4_50 on flat places, with the codes 0, 1, ...")
      ->check(from_to(1, 50))
      ->group(kGroup);
  add_fault(verb,
            kGroup,
            "--target-size",
            arguments.target_mm,
            "diameter of the discs; the markers are twice as wide, mm")
      ->transform(length_above_zero());
  add_fault(verb, kGroup, "--color", options.color, "strength of bands of changing hue, 0 to 0.95")
      ->check(from_to(0.0, 0.95));
  add_fault(verb, kGroup, "--gloss", options.gloss, "strength of the highlight")
      ->check(zero_or_more());
  add_fault(verb, kGroup, "--shininess", options.shininess, "exponent of the highlight")
      ->check(above_zero());
  add_fault(verb,
            kGroup,
            "--bounces",
            options.bounces,
            "1: diffuse light that one part of the surface throws on another (indirect light)")
      ->check(from_to(0, 1));
  add_fault(
      verb, kGroup, "--albedo", options.albedo, "diffuse reflectance of white, with --bounces")
      ->check(from_to(0.0, 1.0));
  add_fault(verb,
            kGroup,
            "--subsurface",
            options.subsurface_mm,
            "mean distance that light travels below the surface, as in wax or skin, mm; 0 for none")
      ->transform(length_zero_or_more());
  add_fault(verb, kGroup, "--speckle", options.speckle, "contrast of laser speckle, 0 to 1")
      ->check(from_to(0.0, 1.0));
  add_fault(verb, kGroup, "--speckle-grain", options.speckle_grain_px, "speckle size, px")
      ->check(above_zero());
  add_fault(verb,
            kGroup,
            "--speckle-correlation",
            options.speckle_correlation,
            "correlation of the speckle of the two interfering beams; below 1 it shifts the phase")
      ->check(from_to(0.0, 1.0));
}

void add_turntable_faults(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Turntable";
  add_fault(verb,
            kGroup,
            "--angle-error",
            arguments.angle_error_deg,
            "error of each view's angle, degrees rms")
      ->check(zero_or_more());
  add_fault(verb,
            kGroup,
            "--axis-offset",
            arguments.options.axis_offset_mm,
            "offset of the axis from the one in rig.toml, mm")
      ->transform(a_length());
  add_fault(verb,
            kGroup,
            "--axis-tilt",
            arguments.axis_tilt_deg,
            "tilt of the axis against the one in rig.toml, degrees")
      ->check(a_number());
  add_fault(verb,
            kGroup,
            "--turntable-top",
            arguments.options.turntable_top_radius_mm,
            "radius of a turntable top below the part, mm; 0 for none")
      ->transform(length_zero_or_more());
}

void add_motion_faults(CLI::App& verb, SimulateArguments& arguments) {
  constexpr const char* kGroup = "Motion during the scan, which rig.toml does not state";
  MotionFaults& motion = arguments.options.motion;
  verb.add_option("--slide-part",
                  arguments.slide_part,
                  "the part slides over the table before a view: VIEW:MM, such as 4:0.4")
      ->group(kGroup);
  verb.add_option("--lost-step",
                  arguments.lost_step,
                  "the table stays behind from a view on: VIEW:DEGREES, such as 4:1.8")
      ->group(kGroup);
  add_fault(verb,
            kGroup,
            "--drift",
            motion.drift_mm,
            "way of the projector during the scan, mm; it turns by half a degree for each mm")
      ->transform(a_length());
  add_fault(verb,
            kGroup,
            "--wobble",
            motion.wobble_mm,
            "standard deviation of the table's top from view to view, mm; it tilts by one degree "
            "for each mm")
      ->transform(length_zero_or_more());
  add_fault(verb, kGroup, "--table-scale", motion.table_scale, "angles over those commanded")
      ->check(a_number());
}

}  // namespace

void read_motion_faults(SimulateArguments& arguments, std::size_t views) {
  const auto read = [&](const std::string& text, const char* option, std::size_t& view) {
    if (text.empty()) return 0.0;
    const auto colon = text.find(':');
    const char* const end = text.data() + text.size();
    double amount = 0.0;
    if (colon != std::string::npos) {
      const auto first = std::from_chars(text.data(), text.data() + colon, view);
      const auto second = std::from_chars(text.data() + colon + 1, end, amount);
      if (first.ptr == text.data() + colon && second.ptr == end && second.ec == std::errc() &&
          view > 0 && view < views)
        return amount;
    }
    throw Error(
        ErrorKind::Input,
        fmt::format("`{}` {}: give VIEW:AMOUNT, such as 2:0.4, with a view from 1 to {}; view 0 "
                    "is that of the beginning",
                    option,
                    text,
                    views - 1));
  };
  MotionFaults& motion = arguments.options.motion;
  motion.slide_mm = read(arguments.slide_part, "slide_part", motion.slide_view);
  motion.lost_step_rad =
      rad_from_deg(read(arguments.lost_step, "lost_step", motion.lost_step_view));
}

void add_simulate_options(CLI::App& verb, SimulateArguments& arguments) {
  add_scan_options(verb, arguments);
  add_calibration_options(verb, arguments);
  add_camera_faults(verb, arguments);
  add_projector_faults(verb, arguments);
  add_part_faults(verb, arguments);
  add_turntable_faults(verb, arguments);
  add_motion_faults(verb, arguments);
  add_frame_faults(verb, arguments.frame_faults);
  add_allow_memory(verb, arguments.read);
}

}  // namespace frangia
