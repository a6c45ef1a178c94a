#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/decode/explain/frame_hypothesis.h"
#include "frangia/diagnose/explanation.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// What explains the frames of one pattern.
struct FrameExplanation {
  std::string pattern;      ///< name of the pattern
  bool decided = false;     ///< lit pixels suffice for an explanation
  Explanation explanation;  ///< the classes of hypotheses, and the odds
  FrameHypothesis best;     ///< the most likely hypothesis of the best class
  /// All hypotheses of the best class; the first one is `best`.
  std::vector<FrameHypothesis> alike;
  /// Standard uncertainty of the phase by what the best hypothesis leaves unexplained; 0 where that
  /// is within the uncertainty of the noise model.
  ///
  /// @units    rad
  double unexplained_rad = 0.0;
  /// The frames that remain show no fringes with these shifts: the best hypothesis leaves more than
  /// the variance of the fringes.
  bool are_fringes = true;

  /// Whether a structural fault is named: its class wins by 100 : 1.
  [[nodiscard]] bool has_fault() const;
};

/// Explains the frames of a fringe pattern by the hypothesis with the most evidence.
///
/// All hypotheses of `frame_hypotheses`, and pairs of the likely ones, are scored on the same
/// pixels. Camera noise, gains of the frames of 3 %, and harmonics that are coherent with the phase
/// are part of every hypothesis. The samples count by their design effect, and what a hypothesis
/// leaves beyond the noise counts as few witnesses: it may be one unknown field over the image.
/// `references` are fringe patterns of the same view that are as described: mean and modulation
/// that a hypothesis finds have to agree with theirs.
///
/// @shape    a fringe pattern of 3 to 24 frames, at one exposure; not decided for others
/// @missing  not decided for fewer than 200 lit pixels in the sample
/// @source   MacKay 2003, chapter 28, for evidence and the Occam factor; Kish 1965
[[nodiscard]] FrameExplanation explain_frames(const FrameStack& stack,
                                              const NoiseModel& noise,
                                              std::span<const FrameStack* const> references = {});

/// A level below the white level at which the frames are cut off.
struct Ceiling {
  int counts = 0;         ///< the level, which no pixel exceeds
  double share = 0.0;     ///< of the samples that lie at it
  double log_odds = 0.0;  ///< natural logarithm, against frames that happen to end there
};

/// Looks for the level at which the frames of a camera are cut off although their white level is
/// higher: video levels end at 235 or 240, and frames of 8 bits may be stored with 16.
///
/// The camera's noise spreads the brightest pixels over several levels. A level that no pixel
/// exceeds and that holds four times as many as any of those below it is a ceiling.
///
/// @shape    all stacks of one view
/// @missing  nothing where the noise is too low to tell, or pixels reach the white level
[[nodiscard]] std::optional<Ceiling> find_ceiling(std::span<const FrameStack> stacks,
                                                  const NoiseModel& noise);

}  // namespace frangia
