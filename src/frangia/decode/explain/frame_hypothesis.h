#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// What may differ between the frames of a pattern and their description.
enum class FrameCause {
  AsDescribed,  ///< nothing
  Lost,         ///< a frame shows no fringes: black, white or something else
  Covered,      ///< some frames show something else in a part of the image
  Displaced,    ///< a frame is displaced as a whole against the others
  Repeated,     ///< a frame shows the one before it again
  Exchanged,    ///< two frames show each other
  Sorted,       ///< the frames are in the alphabetical order of their numbers: 1, 10, 11, 2
  Late,         ///< the frames show the one before them, from one of them on
  Gain,         ///< a frame was taken at another gain, exposure or power of the lamp
  Exposure,     ///< several frames were, each at its own: a camera that exposes by itself
  Lamp,         ///< another lamp was switched on or off within the set
  Moved,        ///< the part moved within the set
  Steps,        ///< the shifts differ from those of scan.toml, alike at all pixels
  Start,        ///< the shifts begin elsewhere: only other patterns tell
  Direction,    ///< the shifts run backwards: only other patterns tell
  Unexplained   ///< no cause: the frames differ from the fringes by a broad density
};

/// Returns the word for a cause in JSON and in the table of hypotheses: "as-described", "lost",
/// "covered", "displaced", "repeated", "exchanged", "sorted", "late", "gain", "exposure", "lamp",
/// "moved", "steps", "start", "direction" or "unexplained".
[[nodiscard]] std::string name_of(FrameCause cause);

/// A generative model of the frames of one pattern: what each of them shows.
///
/// Frame k has the counts g_k (A + B cos(phi + delta_k)) + L_k with mean A, modulation B and phase
/// phi of the pixel, or is free of all of them.
struct FrameHypothesis {
  FrameCause cause = FrameCause::AsDescribed;  ///< of the difference
  std::vector<std::size_t> frames;             ///< which differ
  std::vector<double> shifts_rad;              ///< delta_k that frame k shows
  std::vector<double> gains;                   ///< g_k, 1 unless the frame's gain differs
  std::vector<bool> free;                      ///< the frame shows no fringes
  std::optional<std::size_t> lamp_on;          ///< first frame with the light L of another lamp
  std::size_t lamp_off = SIZE_MAX;             ///< first frame after it without that light
  /// The frames show something else in a part of the image: those of `frames`, or any of them.
  bool in_part = false;
  double part = 0.0;                   ///< share of the lit pixels in that part
  std::vector<std::size_t> displaced;  ///< frames whose whole image is displaced, each by itself
  double displacement_px = 0.0;        ///< the largest of them
  /// How far each frame is displaced, over the whole displacement; empty if nothing moved.
  std::vector<double> path;
  /// The displacement is that of a part: it shifts the image of the texture, and the phase
  /// differently over the image. Otherwise it shifts the phase of all pixels alike.
  bool moves_part = false;
  bool moves_image = false;     ///< the displacement is that of all that is seen in the image
  bool has_free_steps = false;  ///< each shift has an error of its own
  int faults = 0;               ///< 0 as described, 1, or 2
  int parameters = 0;           ///< fitted for all pixels together
  std::size_t choices = 1;      ///< hypotheses of its kind: "which frame"
};

/// All hypotheses with one fault, "as described" first. Gains are 1 until they are fitted.
///
/// @shape    a fringe pattern with three shifts or more
[[nodiscard]] std::vector<FrameHypothesis> frame_hypotheses(const Pattern& pattern);

/// Both faults at once; none where they concern the same frame.
[[nodiscard]] std::optional<FrameHypothesis> both_of(const FrameHypothesis& a,
                                                     const FrameHypothesis& b);

/// A clause: "frame 2 repeats frame 1". Frames are counted from 0.
[[nodiscard]] std::string describe(const FrameHypothesis& hypothesis);

/// Whether a frame has the light of another lamp.
[[nodiscard]] bool is_lit_by_lamp(const FrameHypothesis& hypothesis, std::size_t frame);

/// The only frame that shows what is seen elsewhere than the others do: it is displaced, or the
/// part moved behind the first frame or before the last.
[[nodiscard]] std::optional<std::size_t> displaced_alone(const FrameHypothesis& hypothesis);

/// Whether two hypotheses predict the same frames for any phases, so that no frames tell them
/// apart: with three steps two exchanged frames are shifts in the other direction.
[[nodiscard]] bool predict_alike(const FrameHypothesis& a, const FrameHypothesis& b);

}  // namespace frangia
