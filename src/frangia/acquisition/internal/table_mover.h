#pragma once

#include <optional>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/core/run.h"
#include "frangia/devices/turntable_device.h"

namespace frangia {

/// Turns the table and records the intended and the reached angle of each move in the manifest,
/// before and after it.
class TableMover {
 public:
  /// `table` may be null: then no call does anything. The references must outlive this object.
  TableMover(CaptureDevices& devices,
             CaptureManifest& manifest,
             const TurntableDevice* table,
             std::optional<double> table_at_rad,
             const Run& run)
      : devices_(devices),
        manifest_(manifest),
        table_(table),
        table_at_rad_(table_at_rad),
        run_(run) {}

  /// Moves the table, unless it stands at this angle already.
  /// @errors   Error(Input) before the first move of a table without a home switch that may have
  ///          been turned since the last session; Error(Device)
  void turn_to(double angle_rad);
  /// Makes the next `turn_to` move the table in any case; to be called after a fault.
  void forget() { standing_rad_.reset(); }
  /// Turns the table to 0 if it has moved and its limits allow it.
  void return_to_zero();

 private:
  void establish_angle();

  CaptureDevices& devices_;
  CaptureManifest& manifest_;
  const TurntableDevice* table_;
  std::optional<double> table_at_rad_;
  const Run& run_;
  std::optional<double> standing_rad_;
  bool angle_established_ = false;
};

}  // namespace frangia
