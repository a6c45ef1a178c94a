#include "calibrate_exchange_verbs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/core/parse_length.h"
#include "frangia/exchange/read_calibration_file.h"
#include "frangia/exchange/rig_from_calibration.h"
#include "frangia/exchange/write_calibration_file.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "check_can_write.h"
#include "option_values.h"
#include "print_text.h"
#include "usage.h"

namespace frangia {
namespace {

struct ImportArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;
  std::filesystem::path base;
  std::vector<int> camera_size;
  std::vector<int> projector_size;
  std::string unit;
  std::string second_camera;
  std::vector<std::string> names;
};

std::optional<std::array<int, 2>> size_of(const std::vector<int>& sides) {
  if (sides.empty()) return std::nullopt;
  return std::array<int, 2>{sides[0], sides[1]};
}

/// "K1=mtx" as a name of OpenCV and the name in the file.
CalibrationNames names_of(const std::vector<std::string>& texts) {
  CalibrationNames names;
  for (const std::string& text : texts) {
    const std::size_t equals = std::min(text.find('='), text.size());
    names[text.substr(0, equals)] = equals < text.size() ? text.substr(equals + 1) : "";
  }
  return names;
}

void import_calibration(const ImportArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const Run run = terminal.run();
  ImportRigOptions options;
  options.camera_size_px = size_of(arguments.camera_size);
  options.projector_size_px = size_of(arguments.projector_size);
  options.second_camera = arguments.second_camera;
  if (!arguments.unit.empty()) options.mm_per_unit = parse_length_mm("1" + arguments.unit);
  if (!arguments.base.empty())
    options.base = read_rig(arguments.base, run, RigContent::StartValues);
  const ForeignCalibration calibration =
      read_calibration_files(arguments.files, run, names_of(arguments.names));
  const Rig rig = rig_from_calibration(calibration, options, run);
  write_rig(arguments.output, rig, Durability::Synced, arguments.base);
  terminal.finish();
  const CameraModel& camera = rig.reference().model;
  const double baseline_mm = arguments.second_camera.empty() ? rig.projector.position_mm.norm()
                                                             : rig.cameras[1].position_mm.norm();
  if (terminal.json) {
    print_json(
        nlohmann::ordered_json{{"rig", arguments.output.string()},
                               {"program", calibration.program},
                               {"camera_size_px", {camera.width_px, camera.height_px}},
                               {"camera_focal_px", {camera.focal_px.x(), camera.focal_px.y()}},
                               {"baseline_mm", baseline_mm},
                               {"warnings", terminal.warnings()}});
    return;
  }
  if (!terminal.quiet) {
    print_text(
        "read a calibration of {}: camera {} x {} px, focal length {:.2f} px, baseline {:.2f} "
        "mm\n",
        calibration.program,
        camera.width_px,
        camera.height_px,
        camera.focal_px.x(),
        baseline_mm);
  }
  terminal.print_written(arguments.output.string());
}

void add_import_subcommand(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<ImportArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "import", "make a rig.toml of a calibration of OpenCV, SLStudio, MATLAB, COLMAP, ...");
  verb->footer(
      "Examples:\n  frangia calibrate import calibration.xml -o rig.toml\n"
      "  frangia calibrate import intrinsics.yml extrinsics.yml --camera-size 1280,1024 \\\n"
      "      --projector-size 1920,1080 -o rig.toml\n"
      "The first camera of a stereo calibration is the camera, the second one the projector, or "
      "with\n"
      "--second-camera another camera.\n"
      "See docs/calibration.md.");
  verb->add_option("FILES", arguments->files, "files of one calibration")->required();
  verb->add_option("-o,--output", arguments->output, "rig.toml to write")->required();
  verb->add_option("--base",
                   arguments->base,
                   "a rig.toml for what the calibration does not state, such as the turntable and "
                   "the devices");
  verb->add_option("--camera-size", arguments->camera_size, "width,height of the camera, px")
      ->delimiter(',')
      ->expected(2)
      ->check(from_to(1, 65535));
  verb->add_option(
          "--projector-size", arguments->projector_size, "width,height of the projector, px")
      ->delimiter(',')
      ->expected(2)
      ->check(from_to(1, 65535));
  verb->add_option("--second-camera",
                   arguments->second_camera,
                   "name of the second camera of a calibration of two cameras; the projector is a "
                   "label of --projector-size")
      ->check(CLI::Validator(
          [](const std::string& name) {
            const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
              return std::isalnum(letter) != 0 || letter == '-' || letter == '_';
            });
            return plain && !name.empty() && name != "rejected"
                       ? std::string()
                       : std::string("use letters, digits, - and _ only");
          },
          "NAME"));
  verb->add_option("--map",
                   arguments->names,
                   "names that the files give to K1 and D1 of the camera, K2 and D2 of the "
                   "projector, R and T, such as K1=mtx; repeat for several")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("NAME=NAME");
  verb->add_option("--unit", arguments->unit, "unit of the calibration: mm, cm, m or in")
      ->check(one_of({"mm", "cm", "m", "in"}));
  verb->callback([arguments, &terminal] { import_calibration(*arguments, terminal); });
}

struct ExportArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  std::optional<CalibrationLayout> layout;  ///< of the ending without one
};

void export_calibration(const ExportArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const CalibrationLayout by_ending = layout_of(arguments.output);
  const CalibrationLayout layout = arguments.layout.value_or(by_ending);
  const bool storage = layout != CalibrationLayout::Matlab && layout != CalibrationLayout::Colmap;
  const bool fits = storage ? by_ending == CalibrationLayout::OpenCv : by_ending == layout;
  require_usage(
      fits,
      "the ending of the output does not fit `layout`; leave `layout` out or change the ending");
  const Run run = terminal.run();
  write_calibration_file(arguments.output, read_rig(arguments.rig, run), layout);
  terminal.finish();
  if (terminal.json) print_json(nlohmann::ordered_json{{"calibration", arguments.output.string()}});
  terminal.print_written(arguments.output.string());
}

void add_export_subcommand(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* verb =
      calibrate.add_subcommand("export", "write camera and projector of a rig for another program");
  verb->footer(
      "Example:\n  frangia calibrate export rig.toml -o calibration.yml\n"
      "The ending chooses the program: .yml, .yaml, .xml OpenCV, .json MATLAB, .txt COLMAP.");
  verb->add_option("RIG", arguments->rig, "the rig.toml")->required();
  verb->add_option("-o,--output", arguments->output, "file to write")->required();
  verb->add_option(
          "--layout",
          arguments->layout,
          "names of the values: opencv, slstudio, scan3d, matlab or colmap; default: by the "
          "ending")
      ->transform(named<CalibrationLayout>());
  verb->callback([arguments, &terminal] { export_calibration(*arguments, terminal); });
}

}  // namespace

void add_calibrate_exchange_verbs(CLI::App& calibrate, Terminal& terminal) {
  add_import_subcommand(calibrate, terminal);
  add_export_subcommand(calibrate, terminal);
}

}  // namespace frangia
