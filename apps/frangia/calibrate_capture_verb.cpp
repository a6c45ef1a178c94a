#include "calibrate_capture_verb.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/calibrate_capture.h"
#include "frangia/core/angles.h"
#include "frangia/core/folder_lock.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/default_patterns.h"

#include "ask.h"
#include "counted.h"
#include "drivers.h"
#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct CapturePosesArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  std::vector<int> corners = {10, 7};
  Board board;
  bool table = false;
  double turn_deg = 60.0;
  int poses = 0;  ///< 0: 12 by hand, 7 on the turntable
  PatternPlan patterns;
  CaptureOptions capture;
};

Board board_wanted(const CapturePosesArguments& arguments) {
  Board board = arguments.board;
  board.columns = arguments.corners.at(0);
  board.rows = arguments.corners.at(1);
  check_board(board);
  return board;
}

Scan plan_poses(const CapturePosesArguments& arguments, const Run& run) {
  Scan plan;
  plan.folder = arguments.output;
  plan.name = "poses";
  plan.rig = read_rig(arguments.rig, run, RigContent::StartValues);
  plan.board = board_wanted(arguments);
  plan.patterns = calibration_patterns(plan.rig, arguments.patterns);
  for (int i = 0; arguments.table && i < arguments.poses; ++i) {
    const double share = static_cast<double>(i) / (arguments.poses - 1) - 0.5;
    plan.views.push_back(
        {rad_from_deg(arguments.turn_deg) * share, fmt::format("views/{:03}", i), 0});
  }
  return plan;
}

std::string coverage_text(const PoseCoverage& coverage) {
  const auto& [left, right, up, down] = coverage.tilts_deg;
  return fmt::format(
      "{:.0f} % of the field; distances differ by {:.0f} %; tilts: left {:.0f}, right {:.0f}, "
      "upper {:.0f}, lower {:.0f} degrees",
      100.0 * coverage.field(),
      coverage.poses > 0 ? 100.0 * (coverage.farthest / coverage.nearest - 1.0) : 0.0,
      left,
      right,
      up,
      down);
}

nlohmann::ordered_json coverage_json(const PoseCoverage& coverage) {
  return {{"poses", coverage.poses},
          {"field", coverage.field()},
          {"cells", coverage.cells},
          {"distance_ratio", coverage.poses > 0 ? coverage.farthest / coverage.nearest : 1.0},
          {"tilts_deg", coverage.tilts_deg},
          {"sufficient", coverage.sufficient()},
          {"next", coverage.next.text()}};
}

/// What the program asks for before a pose by hand.
std::string prompt_for(std::size_t number, std::size_t wanted, const PoseCoverage& coverage) {
  const std::string place =
      number == 1 ? "hold the board still in the middle of the light, facing the camera"
                  : coverage.next.text();
  return fmt::format("pose {} of {}: {}. Enter captures, q ends:", number, wanted, place);
}

void print_captured(const CalibrateCaptureReport& report,
                    const CapturePosesArguments& arguments,
                    Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    const nlohmann::ordered_json json{{"scan", arguments.output.string()},
                                      {"captured_frames", report.capture.captured},
                                      {"resumed_frames", report.capture.resumed},
                                      {"coverage", coverage_json(report.coverage)},
                                      {"without_board", report.without_board},
                                      {"warnings", terminal.warnings()}};
    print_json(json);
    return;
  }
  if (terminal.quiet) return;
  print_text("{} with the board: {}\n",
             counted(report.coverage.poses, "pose"),
             coverage_text(report.coverage));
  if (!report.without_board.empty()) {
    print_text("the board is not found in {}\n",
               fmt::format("{}", fmt::join(report.without_board, ", ")));
  }
  if (!arguments.table && !report.coverage.sufficient())
    print_text("next: {}; the same command goes on\n", report.coverage.next.text());
  terminal.print_written(arguments.output.string());
}

void calibrate_capture_verb(CapturePosesArguments arguments, Terminal& terminal) {
  constexpr int kByHand = 12;
  constexpr int kOnTable = 7;
  if (arguments.poses == 0) arguments.poses = arguments.table ? kOnTable : kByHand;
  if (arguments.table && arguments.poses < 2)
    throw Error(ErrorKind::Input, "`poses` on a turntable must be at least 2");
  const Run run = terminal.run();
  run.stage("devices");
  const Scan plan = plan_poses(arguments, run);
  const FolderLock lock(plan.folder);  // before opening the devices, which may be in use
  OpenRig rig(arguments.rig,
              plan.rig,
              SimulatedBoard{.board = *plan.board,
                             .poses = arguments.table ? 1 : arguments.poses,
                             .on_turntable = arguments.table,
                             .turn_rad = rad_from_deg(arguments.turn_deg)},
              run);
  CalibrateCaptureOptions options;
  options.capture = arguments.capture;
  options.poses = static_cast<std::size_t>(arguments.poses);
  if (!arguments.table) {
    options.wait_for_pose = [&](std::size_t number, const PoseCoverage& coverage) {
      terminal.finish();
      const auto answer = read_answer(prompt_for(number, options.poses, coverage), run);
      return answer && *answer != "q" && *answer != "Q";
    };
  }
  options.on_pose = [&](const CapturedPose& pose) {
    if (terminal.quiet || terminal.json) return;
    terminal.finish();
    print_text("pose {}: {} of {} points; {}\n",
               pose.number,
               pose.points,
               pose.expected,
               coverage_text(pose.coverage));
  };
  run.stage("poses");
  try {
    const CalibrateCaptureReport report =
        calibrate_capture(plan, rig.devices(), lock, options, run);
    // With the [devices] tables, so that the rig calibrated from the poses has them, too.
    const std::filesystem::path written = plan.folder / "rig.toml";
    write_rig(written,
              read_rig(written, run, RigContent::StartValues),
              Durability::Synced,
              arguments.rig);
    print_captured(report, arguments, terminal);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled) throw;
    throw Error(ErrorKind::Cancelled,
                fmt::format("{}; continue with: {}", error.what(), terminal.command_line));
  }
}

}  // namespace

void add_calibrate_capture_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<CapturePosesArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "capture", "capture poses of a board by hand or on the turntable, guided");
  verb->footer(
      "Example:\n"
      "  frangia calibrate capture rig.toml -o poses --board checkerboard --square 22mm\n"
      "  frangia calibrate capture rig.toml -o turned --square 22mm --table\n"
      "Repeat the same command to continue. `frangia calibrate board` prints a board.");
  verb->add_option("rig,--rig", arguments->rig, "the rig.toml, with sizes and [devices.*]")
      ->required();
  verb->add_option("-o,--output", arguments->output, "scan folder to write or to continue")
      ->required();
  verb->add_option("--board", arguments->board.kind, "checkerboard (default), charuco or circles")
      ->transform(named<BoardKind>());
  verb->add_option("--corners", arguments->corners, "inner corners, or circles, along x and y")
      ->delimiter(',')
      ->expected(2)
      ->check(from_to(3, 100))
      ->capture_default_str();
  verb->add_option("--square",
                   arguments->board.square_mm,
                   "side of a square, or distance of circles, as the ruler on the print shows it")
      ->required()
      ->transform(length_above_zero());
  verb->add_option("--marker", arguments->board.marker_mm, "side of a ChArUco marker")
      ->transform(length_above_zero());
  verb->add_option("--dictionary", arguments->board.dictionary, "of the ChArUco markers")
      ->capture_default_str();
  verb->add_option(
          "--first-id", arguments->board.first_id, "id of the first ChArUco marker of the board")
      ->check(from_to(0, 249))
      ->capture_default_str();
  verb->add_flag("--legacy-layout",
                 arguments->board.legacy_layout,
                 "ChArUco squares as OpenCV before version 4.6 laid them out");
  verb->add_flag("--table", arguments->table, "the board stands on the turntable, which turns it");
  verb->add_option(
          "--turn", arguments->turn_deg, "of the turntable, degrees from first to last pose")
      ->check(from_to(1.0, 180.0))
      ->capture_default_str();
  verb->add_option("--poses", arguments->poses, "poses to capture; 12 by hand, 7 on the turntable")
      ->check(from_to(1, 100));
  verb->add_option("--periods",
                   arguments->patterns.periods_px,
                   "periods of the vertical fringes, px, such as 1280,160,20")
      ->delimiter(',')
      ->check(above_zero());
  verb->add_option("--shifts", arguments->patterns.shifts, "frames per fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  verb->add_option("--exposure", arguments->capture.camera.exposure_ms, "exposure, ms")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--settle", arguments->capture.settle_s, "wait after each turntable move, s")
      ->check(zero_or_more())
      ->capture_default_str();
  verb->callback([arguments, &terminal] { calibrate_capture_verb(*arguments, terminal); });
}

}  // namespace frangia
