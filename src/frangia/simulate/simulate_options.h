#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/board.h"
#include "frangia/rig/target_set.h"
#include "frangia/simulate/place_stickers.h"

namespace frangia {

/// Another lamp that is switched on while a view is captured.
struct LampSwitch {
  std::size_t view = 0;   ///< number of the view in the plan
  std::size_t frame = 0;  ///< first frame with its light, counted over all frames of the view
  double light = 0.15;    ///< on a white surface, as a share of white
};

/// What moves during a simulated scan although its rig.toml and scan.toml say otherwise.
struct MotionFaults {
  std::size_t slide_view = 0;  ///< first view after the part slid over the table; 0 for none
  double slide_mm = 0.0;       ///< by how much, in the plane of the table
  double drift_mm = 0.0;   ///< of the projector's place, evenly from the first view to the last; it
                           ///< turns by half a degree for each millimetre
  double wobble_mm = 0.0;  ///< standard deviation of the table's top in each direction, from view
                           ///< to view; it tilts by one degree for each millimetre
  double table_scale = 1.0;        ///< angles over those commanded
  std::size_t lost_step_view = 0;  ///< first view after the table lost steps; 0 for none
  double lost_step_rad = 0.0;      ///< angle that the table lacks from then on
};

/// How a digital projector shows fringes.
enum class DisplayedWaveform {
  Sine,     ///< in levels
  Binary,   ///< black and white stripes
  Dithered  ///< black and white pixels, by an ordered dither of 8 x 8 pixels
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(DisplayedWaveform /*any*/) {
  return EnumNames<DisplayedWaveform, 3>{{{DisplayedWaveform::Sine, "sine"},
                                          {DisplayedWaveform::Binary, "binary"},
                                          {DisplayedWaveform::Dithered, "dithered"}}};
}

/// Brightness and faults of the simulated rig. All faults except camera noise are off by default.
struct SimulateOptions {
  std::uint64_t seed = 1;  ///< of all random numbers
  int samples_per_px = 1;  ///< rays per pixel on a grid; rounded up to a square

  // The camera.
  int bits = 8;                  ///< 8, or 10, 12 or 16 in a 16-bit PNG
  bool noise = true;             ///< shot noise and read noise of the camera
  double full_well_e = 20000.0;  ///< electrons of a white pixel
  double read_e = 8.0;           ///< read noise
  double exposure = 1.0;         ///< relative; 1 puts the brightest diffuse pixel at 80 % of white
  double ambient = 0.0;          ///< ambient light on a white surface, as a share of white
  double backdrop = 0.0;         ///< light of a lit background behind the part, as a share of white
  std::vector<LampSwitch> lamps_on;  ///< other lamps that are switched on during the capture
  double camera_blur_px = 0.0;       ///< sigma of the blur of its lens, px

  // The projector.
  double contrast = 0.9;         ///< gamma0 of the fringes, 0 to 1
  double step_error = 0.0;       ///< relative error of every shift
  double step_jitter_rad = 0.0;  ///< rms, independent per frame
  double display_gamma = 1.0;    ///< of a pinhole projector without linearisation
  double flicker = 0.0;          ///< rms relative error of the projector's light, per frame
  DisplayedWaveform waveform = DisplayedWaveform::Sine;  ///< of a pinhole projector
  double projector_blur_px = 0.0;  ///< sigma of the blur of patterns, px of a pinhole projector
  double line_sigma_mm = 0.25;     ///< of the laser sheet's profile, across the plane
  double line_spill = 0.03;        ///< stray light of the laser sheet, as a share of its peak

  // The surface.
  double texture = 0.0;           ///< 0: white; 1: smooth patches from white to black
  double checker_mm = 0.0;        ///< side of painted cubes of albedo 0.10 and 0.85; 0 for none
  double color = 0.0;             ///< 0: grey; below 1: strength of bands of changing hue
  std::optional<Board> board;     ///< printed on the part's plane z = 0, in black on white
  std::optional<Screen> screen;   ///< the part's plane z = 0 is a monitor that shows the patterns
  TargetSet targets;              ///< what `stickers` are
  std::vector<Sticker> stickers;  ///< on the part, over all other paint
  double gloss = 0.0;             ///< strength of the highlight, relative to the diffuse white
  double shininess = 40.0;        ///< exponent of the highlight
  double albedo = 0.8;            ///< diffuse reflectance of white, for bounces
  int bounces = 0;                ///< 1: diffuse light between parts of the surface, once
  double subsurface_mm = 0.0;     ///< mean distance that light travels below the surface
  double speckle = 0.0;           ///< speckle contrast, 0 to 1, constant within a view
  double speckle_grain_px = 1.5;  ///< size of a grain
  double speckle_correlation =
      1.0;  ///< of the two interfering beams' speckle; below 1 it shifts the phase

  // The turntable.
  double angle_error_rad =
      0.0;  ///< rms, independent per view; 0 for the first, which defines the object frame
  double axis_offset_mm = 0.0;           ///< distance of the true axis from that of rig.toml
  double axis_tilt_rad = 0.0;            ///< tilt of the true axis against that of rig.toml
  double turntable_top_radius_mm = 0.0;  ///< a disc with its top at z = 0; 0 for none
  MotionFaults motion;                   ///< motion that the files do not state
};

}  // namespace frangia
