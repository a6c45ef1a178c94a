#include <algorithm>
#include <filesystem>
#include <memory>

#include "frangia/calibrate/board/printed_boards.h"
#include "frangia/calibrate/board/write_board_pdf.h"
#include "frangia/core/error.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/arrange_rig.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/rig_history.h"

namespace frangia {
namespace {

constexpr std::size_t kMostRigNumber = 1'000'000;

/// Replaces a rig.toml; its [devices] tables stay.
void replace_rig(const std::filesystem::path& file, const Rig& rig) {
  const std::filesystem::path fresh = file.parent_path() / "rig-arranged.toml";
  write_rig(fresh, rig, Durability::Synced, file);
  std::filesystem::rename(fresh, file);
}

}  // namespace

nlohmann::ordered_json Service::Implementation::set_rig(CommandArguments& arguments) {
  const OpenProject project = opened();
  RigArrangement wanted;
  wanted.baseline_mm = arguments.positive("baseline_mm");
  wanted.distance_mm = arguments.positive("distance_mm");
  wanted.camera_focal_px = arguments.positive("camera_focal_px");
  wanted.projector_focal_px = arguments.positive("projector_focal_px");
  arguments.check_all_read();
  require(project.rig.has_value(), "this project has no rig");
  require(!project.scan_begun,
          "the scan has begun with this rig; create a project for another one");
  require(is_adjustable(project),
          "only the parts of a simulated rig that is not calibrated can be moved here");
  require_idle();
  stop_live();
  keep_rig(project.folder, RigChange::Geometry);
  const std::filesystem::path truth = true_rig_beside(project.folder.rig());
  std::error_code ignored;
  if (std::filesystem::exists(truth, ignored))  // the simulated parts move as well
    replace_rig(truth, arrange_rig(read_rig(truth), wanted));
  const Rig rig = arrange_rig(*project.rig, wanted);
  replace_rig(project.folder.rig(), rig);
  forget_verdicts();
  reload_rig(project.folder);
  return Json::object();
}

/// Brings an earlier rig of the project back.
nlohmann::ordered_json Service::Implementation::restore_rig_before(CommandArguments& arguments) {
  const OpenProject project = opened();
  const auto number = static_cast<int>(arguments.whole("number", 1, kMostRigNumber));
  arguments.check_all_read();
  require(!project.scan_begun,
          "the scan has begun with this rig; create a project for another one");
  require_idle();
  return started("rig", [this, folder = project.folder, number](const Run& run) {
    run.stage("files");
    restore_rig(folder, number);
    forget_verdicts();
    reload_rig(folder);
  });
}

/// Keeps the rig of the project for other projects.
nlohmann::ordered_json Service::Implementation::keep_rig_as(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  check_project_name(name);
  require_idle();
  return started("rig", [this, folder = folder(), name](const Run& run) {
    run.stage("files");
    rigs_.keep(folder, name);
    refresh_projects();
  });
}

nlohmann::ordered_json Service::Implementation::discard_rig(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  rigs_.discard(name);
  refresh_projects();
  return Json::object();
}

void Service::Implementation::forget_verdicts() {
  change([](OpenProject& now) {
    now.wizard.reset();
    now.axis.reset();
    now.axis_fault.clear();
    now.check.reset();
    now.display.reset();
  });
}

#ifdef FRANGIA_WITH_CALIBRATION
nlohmann::ordered_json Service::Implementation::start_calibration(CommandArguments& arguments) {
  const OpenProject project = opened();
  constexpr std::size_t kFewestPoints = 3;
  constexpr std::size_t kMostPoints = 100;
  constexpr std::size_t kUsualColumns = 10;
  constexpr std::size_t kUsualRows = 7;
  constexpr std::size_t kUsualPoses = 12;
  constexpr double kLeastScale = 0.5;  // of a print; less is a slip of the unit
  WizardBoard board;
  if (const auto ruler_mm = arguments.positive("ruler_mm")) {
    board.scale = *ruler_mm / kPrintedRuler_mm;
    require(
        board.scale > kLeastScale && board.scale < 1.0 / kLeastScale,
        "ruler_mm: the ruler of a printed board is 100 mm long; measure it and state its length");
  } else {
    const auto square_mm = arguments.positive("square_mm");
    require(square_mm.has_value(),
            "square_mm: the side of a square is missing here, or ruler_mm of a printed board");
    Board& described = board.described.emplace();
    described.square_mm = *square_mm;
    described.columns =
        static_cast<int>(arguments.whole_or("columns", kUsualColumns, kFewestPoints, kMostPoints));
    described.rows =
        static_cast<int>(arguments.whole_or("rows", kUsualRows, kFewestPoints, kMostPoints));
    check_board(described);
  }
  const std::size_t poses = arguments.whole_or("poses", kUsualPoses, 3, kMostPoints);
  arguments.check_all_read();
  require(project.can_scan, "this project has no rig with devices");
  require(!project.scan_begun, "the scan has begun with this rig; create a project to calibrate");
  require_idle();
  const auto wizard = std::make_shared<CalibrationWizard>(project.folder, [this] {
    on_change_();
    if (options_.on_picture) options_.on_picture();
  });
  change([&](OpenProject& now) { now.wizard = wizard; });
  return started("calibrate",
                 [this, wizard, board, poses, settings = project.capture, folder = project.folder](
                     const Run& run) {
                   wizard->run(board, poses, settings, options_.capture, run);
                   change([](OpenProject& now) {
                     now.axis.reset();
                     now.check.reset();
                   });
                   reload_rig(folder);
                 });
}

namespace {

/// The board that was captured for the calibration, unless another one is described.
Board board_of(CommandArguments& arguments, const ProjectFolder& folder) {
  constexpr std::size_t kFewestPoints = 3;
  constexpr std::size_t kMostPoints = 100;
  if (const auto square_mm = arguments.positive("square_mm")) {
    Board board;
    board.square_mm = *square_mm;
    board.columns = static_cast<int>(arguments.whole("columns", kFewestPoints, kMostPoints));
    board.rows = static_cast<int>(arguments.whole("rows", kFewestPoints, kMostPoints));
    check_board(board);
    return board;
  }
  std::error_code ignored;
  const std::filesystem::path poses = folder.calibration();
  require(std::filesystem::exists(poses / "scan.toml", ignored),
          "square_mm: the board is not known; state columns, rows and square_mm");
  return read_scan(poses, {}, RigContent::StartValues).board.value();
}

}  // namespace

/// By a board or any part on the table, or by the scan that was captured.
nlohmann::ordered_json Service::Implementation::find_axis(CommandArguments& arguments) {
  const OpenProject project = opened();
  if (arguments.flag("scan")) {
    arguments.check_all_read();
    require(project.scan_complete, "there is no complete scan that could show the axis");
    require(project.rig.has_value() && !project.rig->turntable,
            "the axis of the turntable is known already");
    require_idle();
    return started("axis", [this, folder = project.folder](const Run& run) {
      find_axis_of_scan(folder, run);
    });
  }
  std::optional<Board> board;  // none: any part
  if (!arguments.flag("part")) board = board_of(arguments, project.folder);
  arguments.check_all_read();
  require(project.can_scan, "this project has no rig with devices");
  require(project.rig.has_value(), "calibrate the rig first; the axis needs camera and projector");
  // The frames of a scan without the axis are those of a scan with it.
  require(!project.scan_begun || !project.rig->turntable,
          "the scan has begun with this rig; create a project for another one");
  const bool has_table =
      std::any_of(project.devices.begin(), project.devices.end(), [](const auto& device) {
        return device.test.table == "turntable";
      });
  require(has_table, "this rig has no turntable; choose one among the devices");
  require_idle();
  stop_live();
  return started(
      "axis", [this, board, settings = project.capture, folder = project.folder](const Run& run) {
        const FoundAxis found =
            board ? calibrate_axis(folder, *board, settings, options_.capture, run)
                  : calibrate_axis_by_part(folder, settings, options_.capture, run);
        change([&](OpenProject& now) {
          now.axis = found;
          now.axis_fault.clear();
          now.check.reset();
        });
        reload_rig(folder);
      });
}

/// A board to print, which names itself, as an export.
nlohmann::ordered_json Service::Implementation::print_board(CommandArguments& arguments) {
  const std::string paper = arguments.text("paper");
  arguments.check_all_read();
  const Board board = printed_board(paper);
  return started("export", [this, paper, board, project = folder()](const Run& run) {
    run.stage("files");
    const auto write = [&](const std::filesystem::path& path) {
      static_cast<void>(write_board_pdf(path, board, paper_size(paper)));
    };
    put_export(project, "board-" + paper + ".pdf", std::nullopt, write, run);
  });
}

nlohmann::ordered_json Service::Implementation::capture_pose(CommandArguments& arguments) {
  arguments.check_all_read();
  const auto wizard = opened().wizard;
  require(wizard != nullptr, "no calibration runs; start it first");
  wizard->capture_pose();
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::end_poses(CommandArguments& arguments) {
  arguments.check_all_read();
  const auto wizard = opened().wizard;
  require(wizard != nullptr, "no calibration runs; start it first");
  wizard->end_poses();
  return Json::object();
}
#else
namespace {
[[noreturn]] void fail_without_calibration() {
  throw Error(ErrorKind::Input, "this program was built without calibration");
}
}  // namespace

nlohmann::ordered_json Service::Implementation::start_calibration(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::print_board(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::find_axis(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::capture_pose(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::end_poses(CommandArguments& /*none*/) {
  fail_without_calibration();
}
#endif

}  // namespace frangia
