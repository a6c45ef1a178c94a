#include "frangia/scan_plan/virtual_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia {
namespace {

/// A folder for the frames, which are gone afterwards.
class FrameFolder {
 public:
  FrameFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "frangia-plan-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Error(ErrorKind::File,
                  fmt::format("{}: the temporary folder cannot hold the frames of a planned scan; "
                              "set TMPDIR to a folder with room",
                              name));
    }
    path_ = name;
  }
  ~FrameFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;
  FrameFolder(FrameFolder&&) = delete;
  FrameFolder& operator=(FrameFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What the simulation needs to make the camera as noisy as the rig states.
SimulateOptions simulation_of(const Rig& rig, const VirtualScanOptions& options) {
  SimulateOptions simulated;
  simulated.seed = options.seed;
  simulated.samples_per_px = 4;  // edges of a pixel
  simulated.exposure = options.reflectance;
  simulated.gloss = options.gloss;
  simulated.ambient = options.ambient;
  simulated.full_well_e = options.full_well_e;
  simulated.read_e = options.read_e;
  const Camera& camera = rig.reference();
  while ((1 << simulated.bits) - 1 < camera.white_level && simulated.bits < 16)
    simulated.bits += simulated.bits == 12 ? 4 : 2;
  if (!camera.noise || !(camera.noise->slope_counts > 0.0)) return simulated;
  const double electrons_per_count = 1.0 / camera.noise->slope_counts;
  simulated.full_well_e = electrons_per_count * camera.white_level;
  constexpr double kRounding_counts2 = 1.0 / 12.0;
  simulated.read_e = electrons_per_count *
                     std::sqrt(std::max(0.0, camera.noise->floor_counts2 - kRounding_counts2));
  return simulated;
}

/// The stations of all setups, with the poses of the part.
Scan plan_of(const Mesh& part, const Rig& rig, const ScanRecipe& recipe) {
  Scan plan;
  plan.name = "plan";
  plan.rig = rig;
  plan.patterns = recipe.patterns(rig);
  for (std::size_t setup = 0; setup < recipe.tilts_rad.size(); ++setup) {
    for (int i = 0; i < recipe.stations; ++i) {
      plan.views.push_back({kTwoPi * i / recipe.stations,
                            fmt::format("views/{:03}", plan.views.size()),
                            static_cast<int>(setup)});
    }
    if (setup > 0) {
      plan.part_poses[static_cast<int>(setup)] = pose_on_table(part, recipe.tilts_rad[setup], 0.0);
    }
  }
  return plan;
}

}  // namespace

void VirtualScanOptions::check() const {
  require(reflectance > 0.0 && reflectance <= 1.0, "reflectance must be above 0, and 1 at most");
  require(std::isfinite(gloss) && gloss >= 0.0, "gloss must be 0 or more");
  require(ambient >= 0.0 && ambient < 1.0, "ambient must be 0 or more, and below 1");
  require(full_well_e >= 1.0 && read_e >= 0.0, "full_well_e and read_e must be above 0");
  require(divisor >= 1, "divisor must be 1 or more");
}

Rig coarser_rig(Rig rig, int divisor) {
  for (PosedCamera& posed : rig.cameras) {
    CameraModel& model = posed.camera.model;
    model.width_px /= divisor;
    model.height_px /= divisor;
    model.focal_px /= divisor;
    model.principal_point_px = (model.principal_point_px.array() + 0.5) / divisor - 0.5;
  }
  if (!rig.calibration) return rig;
  RigCovariance& known = rig.calibration->covariance;
  for (std::size_t i = 0; i < known.parameters.size(); ++i) {
    const std::string& name = known.parameters[i];
    const bool of_camera = name.starts_with("camera.") || name.starts_with("camera-");
    if (!of_camera || !name.ends_with("_px")) continue;
    const auto at = static_cast<Eigen::Index>(i);
    known.covariance.row(at) /= divisor;
    known.covariance.col(at) /= divisor;
  }
  return rig;
}

VirtualScan virtual_scan(const Mesh& part,
                         const Rig& rig,
                         const ScanRecipe& recipe,
                         const VirtualScanOptions& options,
                         const Run& run) {
  options.check();
  require(rig.turntable || recipe.stations == 1,
          "the rig has no turntable; plan one station, or add [turntable] to rig.toml");
  VirtualScan found;
  found.rig = coarser_rig(rig, options.divisor);
  found.table_from_part = pose_on_table(part, recipe.tilts_rad.front(), 0.0);
  const Mesh standing = transform_mesh(part, found.table_from_part);
  Scan plan = plan_of(standing, found.rig, recipe);
  for (const ScanView& view : plan.views) {
    Eigen::Isometry3d rig_from_part =
        found.rig.rig_from_object(view.angle_rad) * found.table_from_part;
    if (view.setup > 0) {
      rig_from_part = found.rig.rig_from_object(view.angle_rad) * plan.part_poses.at(view.setup) *
                      found.table_from_part;
    }
    found.rig_from_part.push_back(rig_from_part);
  }
  const FrameFolder folder;
  plan.folder = folder.path();
  run.stage("render");
  Scan scan = simulate_scan(standing, plan, simulation_of(rig, options), run);
  scan.part_poses = plan.part_poses;  // as far as an operator can place a part
  scan.rig.calibration = found.rig.calibration;
  run.stage("reconstruct");
  found.mesh = reconstruct(scan, {}, run).mesh;
  return found;
}

}  // namespace frangia
