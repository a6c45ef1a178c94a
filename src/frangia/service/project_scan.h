#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/enum_names.h"
#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decoded_views.h"
#include "frangia/devices/driver.h"
#include "frangia/devices/guardian.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/growing_surface.h"
#include "frangia/service/project_folder.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia {

/// Where the capture of a turntable station is.
enum class StationState {
  Waiting,    ///< not captured yet
  Capturing,  ///< being captured
  Done,       ///< all frames are stored
  Skipped     ///< its capture failed; `ProjectStation::verdict` gives the reason
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(StationState /*any*/) {
  return EnumNames<StationState, 4>{{{StationState::Waiting, "waiting"},
                                     {StationState::Capturing, "capturing"},
                                     {StationState::Done, "done"},
                                     {StationState::Skipped, "skipped"}}};
}

/// A turntable station of a project and what its quality assessment found.
struct ProjectStation {
  double angle_deg = 0.0;                      ///< of the turntable
  int setup = 0;                               ///< the part is turned over from one to the next
  StationState state = StationState::Waiting;  ///< of its capture
  std::string verdict;                         ///< of the assessment; empty without one
  bool good = false;                           ///< nothing to remedy
  double contrast = 0.0;                       ///< of the finest fringes, 0 to 1
  double saturated = 0.0;                      ///< share of the lit pixels, 0 to 1
  std::size_t points = 0;                      ///< measured pixels
  bool has_cloud = false;                      ///< its points are in ProjectFolder::cloud
};

/// What the capture of a project needs from the program.
struct CaptureSetup {
  std::function<std::vector<Driver>()> drivers;  ///< all drivers that a rig may name
  /// The same, with a board before the simulated camera.
  std::function<std::vector<Driver>(const SimulatedBoard&)> board_drivers;
  std::optional<GuardianProgram> guardian;  ///< switches devices off when the program dies
  /// Returns an object that lives as long as devices are open; may be empty.
  std::function<std::shared_ptr<void>()> hold_devices;
  /// Present angle of a turntable without a home switch, for a scan that goes on.
  std::optional<double> table_at_rad;
};

/// A scan cannot go on before somebody states `CaptureSetup::table_at_rad`.
class UnknownTableAngle : public Error {
 public:
  /// `last_deg`: where the table was left; empty when it was turning.
  explicit UnknownTableAngle(std::optional<double> last_deg);

  /// As given.
  [[nodiscard]] std::optional<double> last_deg() const { return last_deg_; }

 private:
  std::optional<double> last_deg_;
};

/// Returns stations evenly over one turn, all waiting.
[[nodiscard]] std::vector<ProjectStation> planned_stations(std::size_t count, int setup = 0);

/// The setup in which the part is clamped now: the last one of the stations; 0 without any.
[[nodiscard]] int present_setup(const std::vector<ProjectStation>& stations);

/// The stations of a project: as stations.json states them, otherwise those of a complete scan.
/// A station that was being captured waits again. Empty for a project that was not scanned.
[[nodiscard]] std::vector<ProjectStation> read_stations(const ProjectFolder& project,
                                                        const Run& run = {});

/// Writes stations.json.
///
/// @errors   Error(File) when it cannot be written
void write_stations(const ProjectFolder& project, const std::vector<ProjectStation>& stations);

/// How the views of a scan are decoded, while it is captured and for its surface.
[[nodiscard]] DecodeOptions decode_options_of(const CaptureSettings& settings);

/// What keeps the views that the next session decodes: `before`, which may be null, where it is of
/// the same scan.
///
/// @errors   as read_rig; Error(File)
[[nodiscard]] std::shared_ptr<DecodedViews> views_to_keep(
    const ProjectFolder& project,
    const std::vector<ProjectStation>& stations,
    const CaptureSettings& settings,
    const std::shared_ptr<DecodedViews>& before,
    const Run& run = {});

/// Writes the points of the stations of a complete scan about the axis of its turntable, once it is
/// found. Returns the stations with what has points. `decoded` holds the views; null: none.
///
/// @errors   as read_scan; Error(File)
[[nodiscard]] std::vector<ProjectStation> place_clouds(
    const ProjectFolder& project,
    std::vector<ProjectStation> stations,
    const Turntable& table,
    const std::shared_ptr<const DecodedViews>& decoded);

/// Captures the present setup of a scan at its stations, or continues it, with the devices of the
/// project's rig, and keeps stations.json and the points of each station. `on_change` receives the
/// stations after each change, on the calling thread or on that which decodes views.
///
/// Its views are decoded into `decoded`, and added to `growing`, which may be null. The points are
/// in the object frame of the rig as calibrated: registration comes later. Where several stations
/// turn about an axis that is not known, none has points, see place_clouds.
/// @errors   UnknownTableAngle; as open_devices and capture_scan
CaptureReport capture_project(
    const ProjectFolder& project,
    std::vector<ProjectStation> stations,
    const CaptureSettings& settings,
    const CaptureSetup& setup,
    const std::shared_ptr<DecodedViews>& decoded,
    const std::function<void(const std::vector<ProjectStation>&)>& on_change,
    GrowingSurface* growing,
    const Run& run = {});

}  // namespace frangia
