#include "frangia/service/turntable_axis.h"

#include <cstdint>
#include <filesystem>

#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/project_scan.h"
#include "frangia/service/rig_history.h"

namespace frangia {
namespace {

/// Puts the axis into a rig.toml, which is complete at all times. Nothing else changes, so that
/// views that were decoded with it stay those of this rig.
void put_axis(const std::filesystem::path& file, const Turntable& table, const Run& run) {
  constexpr std::uint64_t kMostBytes = 64'000'000;
  const std::filesystem::path fresh = file.parent_path() / "rig-with-axis.toml";
  write_text_file(
      fresh, with_turntable(read_text_file(file, kMostBytes), table), Durability::Synced);
  try {
    static_cast<void>(read_rig(fresh));
  } catch (const Error&) {  // a turntable that is no table of its own
    Rig rig = read_rig(file, run);
    rig.turntable = table;
    write_rig(fresh, rig, Durability::Synced, file);
  }
  std::filesystem::rename(fresh, file);
}

}  // namespace

FoundAxis figures_of(const AxisOfPart& found) {
  return {.views = found.views,
          .axis_sigma_deg = deg_from_rad(found.table.axis_sigma_rad),
          .point_sigma_mm = found.table.point_sigma_mm,
          .angles_rms_deg = deg_from_rad(found.table.angle_sigma_rad),
          .distance_mm = found.table.point_mm.norm()};
}

void keep_axis(const ProjectFolder& project, const Turntable& table, const Run& run) {
  // The scan first: a project whose rig has no axis asks for it again.
  std::error_code ignored;
  if (project.scan != project.folder &&
      std::filesystem::exists(project.in_scan("scan.toml"), ignored))
    put_axis(project.in_scan("rig.toml"), table, run);
  keep_rig(project, RigChange::Axis);
  put_axis(project.rig(), table, run);
}

AxisOfPart axis_of_scan(const ProjectFolder& project,
                        const CaptureSettings& settings,
                        const std::shared_ptr<const DecodedViews>& known,
                        const Run& run) {
  ReconstructOptions options;
  options.decode = decode_options_of(settings);
  options.decoded = known;
  return find_turntable_axis(read_scan(project.scan, run), options, run);
}

}  // namespace frangia
