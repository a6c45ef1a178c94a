#pragma once

#include <memory>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/devices/camera_device.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/internal/view_renderer.h"

namespace frangia {

/// What really stands and shines on the simulated rig, as its devices have left it: the one state
/// that all simulated drivers share. A frame depends on this state and on its label only, so that a
/// scan which was interrupted goes on to the same bytes.
struct SimulatedBench {
  std::shared_ptr<const SimulatedScene> scene;  ///< null until a simulated camera was opened

  double table_rad = 0.0;           ///< where the turntable top really is
  bool fringe_light = true;         ///< the lamp, or the laser through the interferometer
  bool line_light = false;          ///< the laser sheet
  Image<float> picture;             ///< shown by a digital projector, linear; empty: dark
  double fringes_per_degree = 1.0;  ///< of the interferometer
  double piezo_rad = 0.0;           ///< where the interferometer's fringes are
  double drift_rad_per_view = 0.0;
  double jitter_rad = 0.0;  ///< rms, of each place the piezo goes to

  CameraSettings camera;
  double reference_exposure_ms = 10.0;  ///< puts the brightest diffuse pixel at 80 % of white
};

/// Something that a frame suffers beyond the state of the bench.
struct FrameFaults {
  double light = 1.0;       ///< the light runs away by this factor
  double motion_rad = 0.0;  ///< rms, the fringes jump between the frames
};

/// Takes a picture of the bench. Keeps the light of the last pose: most frames share it.
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
