#pragma once

#include <cstddef>
#include <string>

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/choose_exposures.h"
#include "frangia/acquisition/internal/frame_store.h"
#include "frangia/acquisition/internal/set_capture.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/acquisition/internal/view_assessor.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

namespace frangia {

/// One session of a capture: all views of the plan, from the first missing frame on. A failing view
/// is retried, then skipped.
class CaptureSession {
 public:
  /// The folder of the plan is claimed; the references must outlive this object.
  CaptureSession(Scan plan, RigDevices& devices, const CaptureOptions& options, const Run& run);

  /// @errors   see `capture_scan`
  CaptureReport capture();

 private:
  void check_stored_frames();
  [[nodiscard]] bool is_something_left() const;
  void capture_views();
  enum class Ready { Yes, No, End };
  Ready set_up(std::size_t view);
  void capture_view_once(std::size_t view);
  std::string capture_view(std::size_t view);
  void skip(std::size_t view, const std::string& why);
  void finish();
  void return_table();
  void count(std::ptrdiff_t frames);

  Deadline::Clock::time_point begin_ = Deadline::Clock::now();
  Scan plan_;
  const CaptureOptions& options_;
  const Run& run_;
  CaptureDevices devices_;
  CaptureManifest manifest_;
  TableMover table_;
  ChosenExposures exposures_;  ///< adds the exposures of a bracket to the plan
  SetFiles files_;
  FrameStore store_;
  ViewAssessor assessor_;
  SetCapture sets_;
  CaptureReport report_;
  Scan captured_;  ///< with the complete views only
  std::ptrdiff_t total_ = 0;
  std::ptrdiff_t counted_ = 0;
};

}  // namespace frangia
