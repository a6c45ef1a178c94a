#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"
#include "frangia/devices/device_settings.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// Reason why the previous rig of a project is kept.
enum class RigChange {
  Geometry,     ///< its parts were moved
  Devices,      ///< other devices, or other settings of them
  Display,      ///< its display was measured
  Calibration,  ///< it was calibrated
  Axis,         ///< the axis of its turntable was found
  Restored      ///< an earlier one was brought back
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(RigChange /*any*/) {
  return EnumNames<RigChange, 6>{{{RigChange::Geometry, "geometry"},
                                  {RigChange::Devices, "devices"},
                                  {RigChange::Display, "display"},
                                  {RigChange::Calibration, "calibration"},
                                  {RigChange::Axis, "axis"},
                                  {RigChange::Restored, "restored"}}};
}

/// What a list shows of a rig.toml.
struct RigFigures {
  std::string date = {};                  ///< day of its calibration; empty without one
  int poses = 0;                          ///< of the board; 0 without a calibration
  double point_sigma_mm = kMissing;       ///< as Calibration; NaN without one
  bool has_turntable = false;             ///< devices turn the part
  bool has_axis = false;                  ///< the axis of its turntable is known
  std::vector<std::string> drivers = {};  ///< of its devices, in the order of the file
};

/// A rig that a project had before a change.
struct KeptRig {
  int number = 0;           ///< from 1, the newest is the largest
  std::int64_t kept_s = 0;  ///< seconds since 1970
  std::string before;       ///< name of the change that it was kept for
  RigFigures figures;       ///< for the list
};

/// The rigs that a project had, the newest first. What cannot be read is left out.
[[nodiscard]] std::vector<KeptRig> kept_rigs(const ProjectFolder& project);

/// Keeps the rig.toml of a project, with the covariance, residuals and report of its calibration,
/// before it is changed. Of several moves of its parts in a row only the rig before the first is
/// kept; the oldest ones beyond kMostKeptRigs are removed. Without a rig.toml nothing happens.
///
/// @errors   Error(File) when it cannot be written; Error(Input) for a link in the project
void keep_rig(const ProjectFolder& project, RigChange before);

/// Brings an earlier rig back; the present one is kept before.
///
/// @errors   Error(Input) when there is none of this number; as `keep_rig`
void restore_rig(const ProjectFolder& project, int number);

constexpr std::size_t kMostKeptRigs = 30;  ///< of a project; each takes some 100 kB

/// A rig that is kept for any project.
struct LibraryRig {
  std::string name;         ///< that of its folder
  std::int64_t kept_s = 0;  ///< seconds since 1970
  RigFigures figures;       ///< for the list
};

/// Rigs outside of projects, each in a folder of its name. Names reach the file system only by
/// comparison with the folder's entries, as in ProjectLibrary.
class RigLibrary {
 public:
  /// `root` is created when the first rig is kept.
  explicit RigLibrary(std::filesystem::path root) : root_(std::move(root)) {}

  /// The rigs, the newest first.
  [[nodiscard]] std::vector<LibraryRig> list() const;
  /// Keeps the rig of a project under a name, which it has when it is complete.
  ///
  /// @errors   Error(Input) as `check_project_name`, for a name that is taken, and for a project
  ///           without a rig; Error(File)
  void keep(const ProjectFolder& project, const std::string& name) const;
  /// Writes a rig into a project that has none.
  ///
  /// @errors   Error(Input) when there is no rig of this name; Error(File)
  void give(const std::string& name, const ProjectFolder& project) const;
  /// Moves a rig into the folder .bin of this library.
  ///
  /// @errors   as `give`
  void discard(const std::string& name) const;

 private:
  [[nodiscard]] std::filesystem::path find(const std::string& name) const;
  std::filesystem::path root_;
};

/// A rig.toml that a client gives as text.
struct GivenRig {
  std::string rig;         ///< text of rig.toml
  std::string covariance;  ///< text of the CSV file that its [calibration] names; may be empty
};

/// Checks devices that a client described. They may name serial ports, video devices, addresses and
/// built-in parts, but no file of this machine.
///
/// @errors   Error(Input) that names the file and the key
void check_given_devices(std::span<const DeviceSettings> devices);

/// Writes the rig.toml of a project from a text, unchanged, and its covariance in the same folder.
///
/// @errors   Error(Input) as `read_rig` with start values and `check_given_devices`, or when
///           [calibration] names a file elsewhere or one that was not given; Error(File)
void write_given_rig(const ProjectFolder& project, const GivenRig& given);

}  // namespace frangia
