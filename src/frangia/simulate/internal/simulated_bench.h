#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/devices/camera_device.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/internal/view_renderer.h"
#include "frangia/simulate/simulated_drivers.h"

namespace frangia {

/// A picture of the digital projector, and when it appears on the screen.
struct TimedPicture {
  double from_s = 0.0;   ///< on the clock of the bench
  Image<float> picture;  ///< linear; empty: dark
};

/// The physical state of the simulated rig, which all simulated drivers share. A frame depends only
/// on this state and on its label, so that an interrupted scan continues with the same bytes; with
/// a latency, a flicker or a warm-up also on the clock.
struct SimulatedBench {
  std::shared_ptr<const SimulatedScene> scene;  ///< null until a simulated camera is opened
  std::optional<SimulatedBoard> board;          ///< stands in place of the part
  /// Motions of the part away from where the scene has it, object frame, one for each view in turn;
  /// empty: it stays.
  std::vector<Eigen::Isometry3d> moves;

  double table_rad = 0.0;    ///< true angle of the turntable top
  bool fringe_light = true;  ///< the lamp, or the laser through the interferometer
  bool line_light = false;   ///< the laser sheet
  /// Advances by exposures and by the delays of the display alone, not by real time.
  double clock_s = 0.0;
  /// Of the digital projector, in the order of their times: the one on the screen, and those that
  /// are under way. The first one is there from the beginning on.
  std::vector<TimedPicture> pictures{{}};
  double mains_hz = 0.0;            ///< of the room light, which flickers twice as fast; 0: steady
  double room_flicker = 0.0;        ///< amplitude of the room light over its mean
  int clips_at_counts = 0;          ///< what the sensor's electronics give at most; 0: no limit
  double fringes_per_degree = 1.0;  ///< of the interferometer
  double piezo_rad = 0.0;           ///< true phase of the interferometer's fringes
  double drift_rad_per_view = 0.0;
  double jitter_rad = 0.0;  ///< rms, independent per piezo position

  /// Pose of the part in a view.
  [[nodiscard]] Eigen::Isometry3d rig_from_part(std::size_t view) const {
    const Eigen::Isometry3d on_table = scene->rig.rig_from_object(table_rad);
    return moves.empty() ? on_table : on_table * moves[view % moves.size()];
  }

  CameraSettings camera;
  double reference_exposure_ms = 10.0;  ///< puts the brightest diffuse pixel at 80 % of white
};

/// Faults of a single frame.
struct FrameFaults {
  double light = 1.0;       ///< factor on the light
  double motion_rad = 0.0;  ///< rms of the fringes' motion between frames
};

/// Renders frames of the bench. Caches the light of the last pose, which most frames share.
class BenchCamera {
 public:
  [[nodiscard]] Frame capture(const SimulatedBench& bench,
                              const FrameLabel& label,
                              const FrameFaults& faults = {});

 private:
  struct Light;
  std::shared_ptr<Light> light_;
};

}  // namespace frangia
