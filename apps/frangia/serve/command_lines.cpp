#include "command_lines.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

/// Appends the settings that differ from the defaults of `frangia scan`.
void append_capture(const CaptureSettings& settings, std::vector<std::string>& words) {
  const CaptureSettings usual;
  const auto append = [&](const char* option, double value, double otherwise) {
    if (value == otherwise) return;
    words.insert(words.end(), {option, fmt::format("{:g}", value)});
  };
  append("--shifts", settings.shifts, usual.shifts);
  append("--exposure", settings.camera.exposure_ms, usual.camera.exposure_ms);
  if (!settings.exposures_ms.empty()) {
    words.insert(words.end(),
                 {"--exposures", fmt::format("{:g}", fmt::join(settings.exposures_ms, ","))});
  }
  append("--gain", settings.camera.gain_db, usual.camera.gain_db);
  append("--black-level", settings.camera.black_level_counts, usual.camera.black_level_counts);
}

std::vector<std::string> inspect_line(const ProgressOfInspection& inspection,
                                      const std::filesystem::path& mesh) {
  std::vector<std::string> words = {"frangia", "inspect", mesh.string()};
  if (!inspection.plan.empty()) {
    words.insert(words.end(), {"--plan", inspection.plan.string()});
  } else if (!inspection.reference.empty()) {
    words.insert(words.end(),
                 {"--reference",
                  inspection.reference.string(),
                  "--align",
                  inspection.best_fit ? "best-fit" : "none",
                  fmt::format("--tolerance={:g},{:g}", inspection.lower_mm, inspection.upper_mm)});
  } else {
    words.emplace_back("--features");
  }
  if (!inspection.scan.empty()) words.insert(words.end(), {"--scan", inspection.scan.string()});
  if (inspection.best_fit && !inspection.chosen && inspection.poses > 1)
    words.insert(words.end(), {"--start", std::to_string(inspection.start)});
  return words;
}

std::vector<std::string> calibrate_line(const ProgressOfCalibration& calibration,
                                        const std::filesystem::path& rig) {
  if (calibration.solved)
    return {"frangia", "calibrate", "rig", calibration.poses.string(), "-o", rig.string()};
  const Board& board = calibration.board;
  std::vector<std::string> words{"frangia",
                                 "calibrate",
                                 "capture",
                                 rig.string(),
                                 "-o",
                                 calibration.poses.string(),
                                 fmt::format("--corners={},{}", board.columns, board.rows),
                                 "--square",
                                 fmt::format("{:g}mm", board.square_mm),
                                 "--poses",
                                 std::to_string(calibration.wanted)};
  if (board.kind == BoardKind::Charuco) {
    words.insert(words.end(),
                 {"--board",
                  std::string(name_of(board.kind)),
                  "--dictionary",
                  board.dictionary,
                  "--first-id",
                  std::to_string(board.first_id)});
  }
  return words;
}

}  // namespace

CommandLines command_lines(const ProjectProgress& project) {
  CommandLines lines;
  const ProjectFolder& folder = project.folder;
  if (project.can_scan && project.stations > 0) {
    lines["scan"] = {"frangia",
                     "scan",
                     folder.rig().string(),
                     "-o",
                     folder.scan.string(),
                     "--views",
                     std::to_string(project.stations)};
    if (project.setup > 0)
      lines["scan"].insert(lines["scan"].end(), {"--setup", std::to_string(project.setup)});
    append_capture(project.capture, lines["scan"]);
    lines["rig"] = project.calibration
                       ? calibrate_line(*project.calibration, folder.rig())
                       : std::vector<std::string>{"frangia", "devices", folder.rig().string()};
  }
  if (project.scan_complete) {
    lines["reconstruct"] = {"frangia",
                            "reconstruct",
                            folder.scan.string(),
                            "-o",
                            (folder.exports() / (folder.name + ".ply")).string()};
    if (project.build.voxel_mm > 0.0) {
      lines["reconstruct"].insert(lines["reconstruct"].end(),
                                  {"--voxel", fmt::format("{:g}mm", project.build.voxel_mm)});
    }
    if (project.build.watertight) lines["reconstruct"].emplace_back("--watertight");
    if (project.build.max_triangles > 0) {
      lines["reconstruct"].insert(lines["reconstruct"].end(),
                                  {"--max-triangles", std::to_string(project.build.max_triangles)});
    }
    if (project.capture.algorithm != "auto") {
      lines["reconstruct"].insert(lines["reconstruct"].end(),
                                  {"--algorithm", project.capture.algorithm});
    }
  }
  if (project.has_surface) {
    std::vector<std::string> edit = {"frangia", "edit", project.surface.string()};
    for (const EditStep& step : project.steps) {
      edit.push_back("--" + step.operation);
      if (!step.value.empty()) edit.push_back(step.value);
    }
    edit.insert(edit.end(), {"-o", (folder.exports() / (folder.name + ".dxf")).string()});
    if (project.inspection) {
      // An edited surface is inspected as the command line above writes it.
      const std::filesystem::path edited = folder.exports() / (folder.name + ".ply");
      if (!project.steps.empty()) edit.insert(edit.end(), {"-o", edited.string()});
      lines["inspect"] =
          inspect_line(*project.inspection, project.steps.empty() ? project.surface : edited);
    }
    lines["edit"] = edit;
  }
  return lines;
}

}  // namespace frangia
