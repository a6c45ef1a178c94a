#include "calibrate_turntable_verb.h"

#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/solve/calibrate_turntable.h"
#include "frangia/core/angles.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "check_can_write.h"
#include "counted.h"
#include "print_text.h"

namespace frangia {
namespace {

struct TurntableArguments {
  std::filesystem::path scan;
  std::filesystem::path rig;
  std::filesystem::path output;
};

void calibrate_turntable_verb(const TurntableArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run, RigContent::StartValues);
  const Rig rig = read_rig(arguments.rig, run);
  const TurntableCalibration result = calibrate_turntable(scan, rig, {}, 5.0, run);
  write_rig(arguments.output, result.rig, Durability::Buffered, arguments.rig);
  terminal.finish();
  const TurntableSolution& solution = result.solution;
  const Eigen::Vector3d& point = solution.turntable.point_mm;
  const Eigen::Vector3d& axis = solution.turntable.axis;
  if (terminal.json) {
    const nlohmann::ordered_json json{
        {"rig", arguments.output.string()},
        {"views", result.views.size()},
        {"views_without_board", result.without_board},
        {"point_mm", {point.x(), point.y(), point.z()}},
        {"axis", {axis.x(), axis.y(), axis.z()}},
        {"axis_sigma_deg", deg_from_rad(solution.axis_sigma_rad)},
        {"point_sigma_mm", solution.point_sigma_mm},
        {"angle_rms_deg", deg_from_rad(solution.angle_rms_rad)},
        {"camera_rms_px", solution.camera_residuals.rms_px},
        {"projector_rms_px", solution.projector_residuals.rms_px},
        {"warnings", terminal.warnings()},
    };
    print_json(json);
    return;
  }
  if (!terminal.quiet) {
    print_text(
        "axis from {}: direction ± {:.4f} degrees, place ± {:.4f} mm\n"
        "  camera {:.3f} px rms, projector {:.3f} px rms; the views deviate by {:.4f} degrees rms "
        "from their angles\n",
        counted(result.views.size(), "view"),
        deg_from_rad(solution.axis_sigma_rad),
        solution.point_sigma_mm,
        solution.camera_residuals.rms_px,
        solution.projector_residuals.rms_px,
        deg_from_rad(solution.angle_rms_rad));
  }
  terminal.print_written(arguments.output.string());
}

}  // namespace

void add_calibrate_turntable_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<TurntableArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "turntable", "find the axis of the turntable from a board that stands on it");
  verb->footer(
      "Example:\n  frangia calibrate turntable board-turned --rig rig.toml -o rig-with-axis.toml\n"
      "The views of the scan state angle_deg; their patterns are those of `frangia calibrate "
      "rig`.");
  verb->add_option("SCAN", arguments->scan, "the scan folder with the turned board")->required();
  verb->add_option("--rig", arguments->rig, "the calibrated rig.toml")->required();
  verb->add_option("-o,--output", arguments->output, "rig.toml to write")->required();
  verb->callback([arguments, &terminal] { calibrate_turntable_verb(*arguments, terminal); });
}

}  // namespace frangia
