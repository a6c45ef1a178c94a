#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/camera_device.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What a preview shows and how it is exposed.
struct PreviewSettings {
  CameraSettings camera;          ///< exposure, gain and black level
  std::vector<Pattern> patterns;  ///< shown in turn, at least one
  double table_rad = 0.0;         ///< turntable angle, for a rig with a turntable
};

/// A frame of a preview.
struct PreviewFrame {
  Frame frame;              ///< of the reference camera
  std::size_t pattern = 0;  ///< index in `PreviewSettings::patterns`
  int number = 0;           ///< of the frame within its pattern
  CameraSettings settings;  ///< as the camera reports them
  int generation = 0;       ///< counts the changes of the settings, from 1
};

/// What a preview asks for and reports to.
struct PreviewEvents {
  /// Called before each frame: new settings, or empty for the present ones. The first call returns
  /// settings. New patterns begin with their first frame.
  std::function<std::optional<PreviewSettings>()> next_settings;
  std::function<void(PreviewFrame)> on_frame;  ///< called with each complete frame
};

/// Shows patterns and captures their frames in turn until `run` is stopped, which ends it with
/// Error(Cancelled). Nothing is stored. All devices are safe when it returns or throws.
///
/// A turntable moves when `table_rad` changes, not at the beginning: a table without a home switch
/// keeps its angle.
/// @errors   Error(Input) for settings without patterns; Error(Device) when the camera cannot
///          expose so, or a device is lost
void preview(RigDevices& devices, const Rig& rig, const PreviewEvents& events, const Run& run);

}  // namespace frangia
