#pragma once

#include <cstdint>

namespace frangia {

/// What the simulated rig does wrong, and how bright it is. All faults but a mild camera noise are
/// off by default.
struct SimulateOptions {
  std::uint64_t seed = 1;  ///< of everything that is left to chance
  int samples_per_px = 1;  ///< rays a pixel, evenly over it; rounded up to a square

  // The camera.
  int bits = 8;  ///< 8, or 10, 12 or 16 in a 16-bit PNG
  bool noise = true;
  double full_well_e = 20000.0;  ///< electrons of a white pixel
  double read_e = 8.0;           ///< read noise
  double exposure = 1.0;         ///< 1 puts the brightest diffuse pixel at 80 % of white
  double ambient = 0.0;          ///< other light on a white surface, as a share of white

  // The projector.
  double contrast = 0.9;         ///< gamma0 of the fringes, 0 to 1
  double step_error = 0.0;       ///< every shift is larger by this share of itself
  double step_jitter_rad = 0.0;  ///< rms, another error for each frame
  double display_gamma = 1.0;    ///< of a pinhole projector that was not linearised
  double line_sigma_mm = 0.25;   ///< of the laser sheet's profile, across the plane
  double line_spill = 0.03;      ///< light beside the laser sheet, as a share of its peak

  // The surface.
  double texture = 0.0;           ///< 0: all white; 1: smooth patches down to black
  double gloss = 0.0;             ///< strength of the highlight, in whites of the diffuse surface
  double shininess = 40.0;        ///< exponent of the highlight
  double speckle = 0.0;           ///< contrast of the laser's speckle, 0 to 1, the same in a view
  double speckle_grain_px = 1.5;  ///< size of a grain
  double speckle_correlation =
      1.0;  ///< of the two interfering beams' speckle; below 1 it moves phase

  // The turntable.
  double angle_error_rad =
      0.0;  ///< rms, another for each view but the first, which says how the part stands
  double axis_offset_mm = 0.0;           ///< how far the true axis is from the one rig.toml gives
  double axis_tilt_rad = 0.0;            ///< and how much it leans from it
  double turntable_top_radius_mm = 0.0;  ///< a disc with its top at z = 0; 0 for none
};

}  // namespace frangia
