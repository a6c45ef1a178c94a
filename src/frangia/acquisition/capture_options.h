#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frangia/devices/camera_device.h"

namespace frangia {

/// How the exposure time is chosen.
enum class ExposureChoice {
  Given,      ///< `camera.exposure_ms`, or each pattern's `exposures_ms`
  Automatic,  ///< the longest exposure that saturates at most 0.5 % of the lit pixels
  Bracketed   ///< several exposures, for glossy parts
};

struct DecodedView;
class DecodedViews;

/// What the assessment of a captured view found.
struct ViewAssessment {
  std::size_t view = 0;                  ///< index in the plan
  std::string verdict;                   ///< "good", or the fault and its remedy in a few words
  bool good = false;                     ///< nothing to remedy
  double contrast = 0.0;                 ///< of the finest fringes, 0 to 1; 0 without fringes
  double saturated_fraction = 0.0;       ///< of the lit pixels, 0 to 1
  std::size_t points = 0;                ///< pixels with a phase
  const DecodedView* decoded = nullptr;  ///< valid during the call; null: cannot be decoded
};

/// How a scan is captured: exposure, repeated attempts and time limits.
struct CaptureOptions {
  CameraSettings camera;  ///< `exposure_ms` is the initial guess of Automatic and Bracketed
  ExposureChoice exposure = ExposureChoice::Given;  ///< how the exposure time is chosen
  bool control_steps =
      true;  ///< corrects the shifter's commands by the steps measured in earlier sets
  int frame_attempts = 50;  ///< exposures until a frame arrives complete
  int set_attempts = 3;     ///< captures of a set until it shows no motion
  int view_attempts = 2;    ///< captures of a view after device faults
  double settle_s = 0.0;    ///< wait after a table move, in addition to the table's own
  /// Per device call, in addition to the exposure or to 1.5 times the expected duration of a move.
  double timeout_s = 10.0;
  /// The scan begins when the fringes on the part move by less than this from one look at them to
  /// the next, twice in a row; 0 begins at once.
  double drift_limit_mm = 0.0;
  double drift_interval_s = 20.0;    ///< between two looks
  double drift_patience_s = 3600.0;  ///< until the capture gives up
  /// The setup in which the part is clamped now. Views of other setups are kept as earlier sessions
  /// left them: complete, or left out.
  int setup = 0;
  /// Present angle of a turntable without a home switch. Empty: 0 when a scan begins. A scan that
  /// is continued requires it.
  std::optional<double> table_at_rad;
  /// Called before each view that a person sets up, with white light on where the plan has such a
  /// pattern; false ends the capture with the views so far. A view that an earlier session began
  /// but did not complete is left out: nobody can set it up again. Empty: nothing is set up by
  /// hand.
  std::function<bool(std::size_t view)> before_view;
  /// Called after each complete view, also those of earlier sessions; its frames are on the disk.
  std::function<void(std::size_t view)> after_view;
  /// Looks further at each view that is captured in this session and could be decoded, on the
  /// thread that decodes it, while the capture continues. Returns a finding, which becomes the
  /// verdict of a view that is good otherwise; empty for none. It does not throw.
  std::function<std::string(const ViewAssessment&)> check_view;
  /// Called once for each view that is captured in this session, on the thread that decodes it,
  /// while the capture continues. It does not throw.
  std::function<void(const ViewAssessment&)> on_view;
  /// Says how these views are decoded, and keeps them for a reconstruction. Null: by default
  /// options, and nothing is kept.
  std::shared_ptr<DecodedViews> decoded;
};

/// A view that could not be captured.
struct SkippedView {
  std::size_t view = 0;    ///< index in the plan
  double angle_rad = 0.0;  ///< of the turntable
  std::string reason;      ///< the error of the last attempt

  /// "view 3 at 240 degrees: REASON", counted from 1.
  [[nodiscard]] std::string sentence() const;
};

/// Frames, retries and times of a capture session.
struct CaptureReport {
  std::size_t captured = 0;          ///< frames stored in this session
  std::size_t resumed = 0;           ///< frames stored by earlier sessions
  std::size_t frame_retries = 0;     ///< repeated exposures of incomplete frames, all sessions
  std::size_t set_retakes = 0;       ///< sets captured again because of motion, all sessions
  std::vector<SkippedView> skipped;  ///< in the order of the plan
  std::vector<double> exposures_ms;  ///< of the fringes
  std::optional<double> drift_mm{};  ///< between the last two looks at the fringes before the scan
  double device_s = 0.0;             ///< time in device calls: exposing, settling, moving
  double disk_s = 0.0;               ///< time waiting for fsync
  double other_s = 0.0;              ///< remaining time of the session

  /// `other_s` per captured frame.
  [[nodiscard]] double overhead_ms() const {
    return captured == 0 ? 0.0 : 1000.0 * other_s / static_cast<double>(captured);
  }
};

}  // namespace frangia
