#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/devices/camera_device.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How a project is captured and decoded; the file capture.json of its folder.
struct CaptureSettings {
  CameraSettings camera;  ///< exposure, gain and black level
  /// Exposures of each frame of the scan, which are merged; empty: that of `camera` alone. The
  /// preview uses that of `camera` in any case.
  std::vector<double> exposures_ms;
  int shifts = 4;                  ///< frames per fringe pattern
  std::string algorithm = "auto";  ///< name, see fit_algorithm

  static constexpr int kFewestShifts = 3;           ///< that determine a phase
  static constexpr int kMostShifts = 16;            ///< that the app offers
  static constexpr std::size_t kMostExposures = 6;  ///< of a frame

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
  bool operator==(const CaptureSettings& other) const;  ///< compares all members
};

/// Reads capture.json.
///
/// @missing  the defaults for a file that does not exist
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] CaptureSettings read_capture_settings(const std::filesystem::path& file);

/// Writes capture.json.
///
/// @errors   Error(File) when it cannot be written
void write_capture_settings(const std::filesystem::path& file, const CaptureSettings& settings);

/// The patterns of a scan with these settings.
///
/// @errors   as default_patterns
[[nodiscard]] std::vector<Pattern> patterns_of(const CaptureSettings& settings, const Rig& rig);

}  // namespace frangia
