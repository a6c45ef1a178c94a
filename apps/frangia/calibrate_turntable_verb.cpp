#include "calibrate_turntable_verb.h"

#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/solve/calibrate_turntable.h"
#include "frangia/core/angles.h"
#include "frangia/reconstruct/find_turntable_axis.h"
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
  bool part = false;
};

nlohmann::ordered_json json_of(const Turntable& table, const std::filesystem::path& output) {
  const Eigen::Vector3d& point = table.point_mm;
  const Eigen::Vector3d& axis = table.axis;
  return {{"rig", output.string()},
          {"point_mm", {point.x(), point.y(), point.z()}},
          {"axis", {axis.x(), axis.y(), axis.z()}}};
}

/// By the surfaces of a part that stands on the table.
void find_axis_of_part(const TurntableArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  Scan scan = read_scan(arguments.scan, run, RigContent::StartValues);
  scan.rig = read_rig(arguments.rig, run);
  const AxisOfPart found = find_turntable_axis(scan, {}, run);
  scan.rig.turntable = found.table;
  write_rig(arguments.output, scan.rig, Durability::Buffered, arguments.rig);
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = json_of(found.table, arguments.output);
    json["views"] = found.views;
    json["views_left_out"] = found.left_out;
    json["axis_sigma_deg"] = deg_from_rad(found.table.axis_sigma_rad);
    json["point_sigma_mm"] = found.table.point_sigma_mm;
    json["angle_rms_deg"] = deg_from_rad(found.table.angle_sigma_rad);
    json["surface_rms_mm"] = found.rms_mm;
    json["warnings"] = terminal.warnings();
    print_json(json);
    return;
  }
  if (!terminal.quiet) {
    print_text(
        "axis from {} of the part: direction ± {:.4f} degrees, place ± {:.4f} mm\n"
        "  its surfaces agree to {:.4f} mm RMS\n",
        counted(found.views, "view"),
        deg_from_rad(found.table.axis_sigma_rad),
        found.table.point_sigma_mm,
        found.rms_mm);
    if (!found.left_out.empty()) {
      const std::string names = fmt::format("{}", fmt::join(found.left_out, ", "));
      print_text("  left out: view {}\n", names);
    }
  }
  terminal.print_written(arguments.output.string());
}

void calibrate_turntable_verb(const TurntableArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  if (arguments.part) return find_axis_of_part(arguments, terminal);
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run, RigContent::StartValues);
  const Rig rig = read_rig(arguments.rig, run);
  const TurntableCalibration result = calibrate_turntable(scan, rig, {}, 5.0, run);
  write_rig(arguments.output, result.rig, Durability::Buffered, arguments.rig);
  terminal.finish();
  const TurntableSolution& solution = result.solution;
  if (terminal.json) {
    nlohmann::ordered_json json = json_of(solution.turntable, arguments.output);
    json["views"] = result.views.size();
    json["views_without_board"] = result.without_board;
    json["axis_sigma_deg"] = deg_from_rad(solution.axis_sigma_rad);
    json["point_sigma_mm"] = solution.point_sigma_mm;
    json["angle_rms_deg"] = deg_from_rad(solution.angle_rms_rad);
    json["camera_rms_px"] = solution.camera_residuals.rms_px;
    json["projector_rms_px"] = solution.projector_residuals.rms_px;
    json["warnings"] = terminal.warnings();
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
      "turntable", "find the axis of the turntable from a board or any part that stands on it");
  verb->footer(
      "Examples:\n  frangia calibrate turntable board-turned --rig rig.toml -o rig-with-axis.toml\n"
      "  frangia calibrate turntable first-scan --part --rig rig.toml -o rig-with-axis.toml\n"
      "The views of the scan state angle_deg; their patterns are those of `frangia calibrate "
      "rig`.");
  verb->add_option("SCAN", arguments->scan, "the scan folder with the turned board or part")
      ->required();
  verb->add_option("--rig", arguments->rig, "the calibrated rig.toml")->required();
  verb->add_option("-o,--output", arguments->output, "rig.toml to write")->required();
  verb->add_flag("--part",
                 arguments->part,
                 "instead of a board any part without symmetry, scanned at three stations or more");
  verb->callback([arguments, &terminal] { calibrate_turntable_verb(*arguments, terminal); });
}

}  // namespace frangia
