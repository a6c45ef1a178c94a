#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/drive_curve.h"
#include "frangia/devices/driver_registry.h"
#include "frangia/scan/scan_folder.h"

namespace frangia {

struct CaptureOptions {
  CameraSettings camera;
  bool auto_exposure =
      false;  ///< chosen at the first view, `camera.exposure_ms` is the first guess
  /// Volts of each phase; by default a fringe over the range from 0 V to the high end.
  std::vector<double> curve_rad;
  std::vector<double> curve_v;
  bool control_steps = true;  ///< the steps that a set shows correct the next set's commands
  int frame_attempts = 4;
  int set_attempts = 3;  ///< a set that shows motion is taken again
  int view_attempts = 2;
  std::chrono::milliseconds settle{0};        ///< after a move of the table
  std::chrono::milliseconds patience{10000};  ///< for each call to a device, beyond the exposure
};

struct CaptureReport {
  std::size_t taken = 0;             ///< frames stored in this session
  std::size_t resumed = 0;           ///< frames that lay there already
  std::size_t frame_retries = 0;     ///< lost or incomplete frames taken again
  std::size_t set_retakes = 0;       ///< sets that showed motion
  std::vector<std::string> skipped;  ///< views, each with why
};

/// Captures `plan` into `plan.folder`, or the rest of it when it was interrupted: at the first
/// frame that is missing, to the same bytes as without an interruption.
///
/// Each frame is on the disk, with its checksum in the manifest, before the next but one is
/// exposed. Frames once stored are never changed; those of a set that is taken again move to the
/// view's folder `rejected`. A view that fails is tried again, then skipped and named. scan.toml is
/// written last and holds the views that are complete. Whatever happens, the devices are left safe.
/// errors   Error(Input) when the folder holds another scan, or the devices do not suit the plan;
///          DeviceError when a device is gone, refuses, or no view could be captured; Error(File)
[[nodiscard]] CaptureReport capture_scan(const Scan& plan,
                                         const Devices& devices,
                                         const CaptureOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
