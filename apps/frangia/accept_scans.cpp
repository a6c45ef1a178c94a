#include "accept_scans.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "ask.h"
#include "drivers.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// The artifact as it stands in an arrangement, above the turntable's plane.
Mesh placed_artifact(const AcceptancePlan& plan, const Arrangement& arrangement) {
  constexpr double kAboveTable = 2.0;  // mm
  const ReferenceArtifact& artifact = plan.artifact;
  Mesh mesh = make_dumbbell(artifact.diameters_mm, artifact.spacing_mm);
  const double diameter =
      *std::max_element(artifact.diameters_mm.begin(), artifact.diameters_mm.end());
  const double length = artifact.spacing_mm + diameter;
  const bool bar = artifact.diameters_mm.size() == 2;
  // One place for all directions of a bar: as high as the upright one needs. A ball stands on its
  // stem.
  const double height = kAboveTable + (bar ? 0.5 * length : 1.75 * diameter);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.0, 0.0, height) + length * arrangement.offset_share;
  if (bar) {
    pose.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), arrangement.direction)
            .toRotationMatrix();
  }
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    vertex = (pose * vertex.cast<double>()).cast<float>();
  for (Eigen::Vector3f& normal : mesh.normals)
    normal = (pose.linear() * normal.cast<double>()).cast<float>();
  return mesh;
}

Scan plan_of_arrangement(const AcceptancePlan& plan,
                         const Rig& rig,
                         const Arrangement& arrangement,
                         const fs::path& folder) {
  Scan scan;
  scan.folder = folder;
  scan.name = arrangement.name;
  scan.rig = rig;
  scan.patterns = default_patterns(rig);
  for (int i = 0; i < plan.views; ++i)
    scan.views.push_back({kTwoPi * i / plan.views, fmt::format("views/{:03}", i)});
  return scan;
}

void capture_arrangement(const AcceptancePlan& plan,
                         const Scan& scan,
                         std::size_t number,
                         Terminal& terminal) {
  const Run run = terminal.run();
  terminal.finish();
  const auto answer =
      read_answer(fmt::format("arrangement {} of {}: place the {} {}. Enter captures, q ends:",
                              number,
                              plan.arrangements.size(),
                              plan.artifact.diameters_mm.size() == 2 ? "ball bar" : "ball",
                              scan.name),
                  run);
  if (!answer || *answer == "q" || *answer == "Q") {
    throw Error(
        ErrorKind::Cancelled,
        fmt::format(
            "ended before arrangement {}; continue with: {}", number, terminal.command_line));
  }
  const FolderLock lock(scan.folder);  // before opening the devices, which may be in use
  OpenRig rig(plan.rig, scan.rig, run);
  CaptureOptions options;
  options.exposure = ExposureChoice::Automatic;
  const CaptureReport report = capture_scan(scan, rig.devices(), lock, options, run);
  if (!report.skipped.empty()) {
    throw Error(ErrorKind::Device,
                fmt::format("{}: {} of {} views could not be captured; continue with: {}",
                            scan.folder.string(),
                            report.skipped.size(),
                            scan.views.size(),
                            terminal.command_line));
  }
}

}  // namespace

Rig acceptance_rig(const AcceptancePlan& plan, const Run& run) {
  const bool preset = plan.source == AcceptanceSource::Simulation && !plan.rig.has_extension();
  return preset ? rig_preset(plan.rig.string()) : read_rig(plan.rig, run);
}

fs::path acceptance_scan(const AcceptancePlan& plan,
                         const Rig& rig,
                         std::size_t arrangement,
                         const fs::path& output,
                         Terminal& terminal) {
  const Arrangement& wanted = plan.arrangements[arrangement];
  if (plan.source == AcceptanceSource::Scans) return wanted.scan;
  fs::path folder = output / fmt::format("arrangement-{}", arrangement + 1);
  if (fs::exists(folder / "scan.toml")) return folder;
  const Scan scan = plan_of_arrangement(plan, rig, wanted, folder);
  if (plan.source == AcceptanceSource::Devices) {
    capture_arrangement(plan, scan, arrangement + 1, terminal);
    return folder;
  }
  SimulateOptions options{.samples_per_px = 4};
  options.seed = arrangement + 1;
  static_cast<void>(simulate_scan(placed_artifact(plan, wanted), scan, options, terminal.run()));
  return folder;
}

}  // namespace frangia
