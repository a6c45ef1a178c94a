#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/temporal/check_sequence.h"

namespace frangia {

/// What the recorded frames and the fringes are supposed to show.
struct GrayTrial {
  SequenceFault fault;
  Pattern code;
  std::vector<std::size_t> frame_of;  ///< recorded frame of each declared one
  std::vector<bool> inverted;         ///< recorded frames that show their inverse
  /// A recorded frame without stripes: the fringes decide what it should have shown at each pixel.
  std::optional<std::size_t> missing{};
  double start_rad = 0.0;  ///< of the fringes
  bool reversed = false;   ///< shifts of the fringes
  double period_px = 0.0;  ///< of the fringes
};

/// The hypothesis that the code is as declared, for scans with and without fringes.
[[nodiscard]] GrayTrial declared_trial(const Pattern& code);
[[nodiscard]] GrayTrial declared_trial(const Pattern& code, const Pattern& fringes);

/// Hypotheses about the order of bits and frames, inversions and the code.
[[nodiscard]] std::vector<GrayTrial> code_trials(const Pattern& code);
/// The same of a scan that has fringes, too, with hypotheses about those.
[[nodiscard]] std::vector<GrayTrial> gray_trials(const Pattern& code, const Pattern& fringes);

/// The stripe that a pixel is in, if the recorded frames with a bit in `bright` are bright there.
[[nodiscard]] std::uint32_t shown_stripe(const GrayTrial& trial, std::uint64_t bright);

}  // namespace frangia
