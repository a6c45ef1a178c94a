#include "calibrate_display_verb.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/with_display.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/read_file.h"
#include "frangia/rig/read_rig.h"

#include "check_can_write.h"
#include "drivers.h"
#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct DisplayArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  CaptureOptions capture;
};

void print_figures(const DisplayMeasurement& found) {
  print_text("latency {:.0f} ms: delay_s = {:g}\n", 1e3 * found.latency_s, found.delay_s);
  print_text("{:.1f} frames a second of one picture, {:.1f} patterns a second\n",
             found.camera_fps,
             found.patterns_per_s);
  if (found.mains_hz > 0.0) {
    print_text("the light of the room flickers by {:.1f} % of the display's, mains of {:g} Hz\n",
               100.0 * found.room_flicker,
               found.mains_hz);
  }
  if (found.exposure_step_ms > 0.0)
    print_text("exposures of whole {:.4g} ms see even light\n", found.exposure_step_ms);
  if (found.response) {
    print_text("half of full drive gives {:.1f} % of full light\n",
               100.0 * found.response->light_of(0.5));
  }
  print_text("fringes of 12 px keep {:.0f} % of their contrast\n", 100.0 * found.sharpness);
  print_text("pixels are saturated from {} counts on; {:.1f} % have 0 in the dark\n",
             found.white_level,
             100.0 * found.dark_zeros);
}

nlohmann::ordered_json json_of(const DisplayMeasurement& found) {
  nlohmann::ordered_json json{
      {"exposure_ms", found.exposure_ms},
      {"latency_s", found.latency_s},
      {"delay_s", found.delay_s},
      {"late_frames", found.late_frames},
      {"camera_fps", found.camera_fps},
      {"patterns_per_s", found.patterns_per_s},
      {"mains_hz", found.mains_hz},
      {"room_flicker", found.room_flicker},
      {"exposure_step_ms", found.exposure_step_ms},
      {"light",
       found.response ? nlohmann::ordered_json(found.response->light) : nlohmann::ordered_json()},
      {"sharpness", found.sharpness},
      {"white_level", found.white_level},
      {"dark_zeros", found.dark_zeros},
      {"findings", found.findings}};
  return json;
}

void calibrate_display(const DisplayArguments& arguments, Terminal& terminal) {
  if (!arguments.output.empty()) check_can_write(arguments.output);
  const Run run = terminal.run();
  run.stage("devices");
  const Rig rig = read_rig(arguments.rig, run, RigContent::StartValues);
  DisplayMeasurement found;
  {
    OpenRig open(arguments.rig, rig, run);
    found = measure_display(open.devices(), rig, arguments.capture, run);
  }
  if (!arguments.output.empty()) {
    const std::string text = with_display(read_text_file(arguments.rig), rig, found);
    write_text_file(arguments.output, text);
  }
  for (const std::string& finding : found.findings)
    run.warn(finding);
  terminal.finish();
  if (terminal.json) {
    print_json(json_of(found));
  } else if (!terminal.quiet) {
    print_figures(found);
    if (!arguments.output.empty()) terminal.print_written(arguments.output.string());
  }
}

}  // namespace

void add_calibrate_display_verb(CLI::App& calibrate, Terminal& terminal) {
  auto* verb = calibrate.add_subcommand(
      "display",
      "measure latency, response and focus of a digital projector, and the light of the room");
  verb->footer(
      "Example:\n  frangia calibrate display rig.toml -o rig-display.toml\n"
      "Put a white sheet of paper where camera and projector look; nothing moves.");
  auto arguments = std::make_shared<DisplayArguments>();
  verb->add_option("rig,--rig", arguments->rig, "the rig.toml, with [devices.*]")->required();
  verb->add_option("-o,--output",
                   arguments->output,
                   "write the rig with what was measured to this file: delay_s, exposure_step_ms, "
                   "white_level and [projector.response]");
  verb->add_option("--exposure",
                   arguments->capture.camera.exposure_ms,
                   "exposure to begin with, ms; a fitting one is looked for")
      ->check(above_zero())
      ->capture_default_str();
  verb->callback([arguments, &terminal] { calibrate_display(*arguments, terminal); });
}

}  // namespace frangia
