#pragma once

#include <string>
#include <vector>

#include "frangia/core/enum_names.h"

namespace frangia {

/// What the frames of a pattern show.
enum class PatternKind {
  Fringe,  ///< sinusoidal fringes, one frame per shift
  Line,    ///< the laser sheet, one frame
  Gray,    ///< Gray code of the projector's columns or rows, one frame per bit
  Ramp,    ///< a uniformly lit field, one frame per level
  White,   ///< full light over the whole field, one frame
  Ambient  ///< the projector is dark, one frame
};

/// Orientation of the fringes.
enum class FringeDirection {
  Vertical,   ///< the phase varies with the projector's column
  Horizontal  ///< the phase varies with the projector's row
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(FringeDirection /*any*/) {
  return EnumNames<FringeDirection, 2>{
      {{FringeDirection::Vertical, "vertical"}, {FringeDirection::Horizontal, "horizontal"}}};
}

/// Which frames of a Gray code are shown inverted as well.
enum class InvertedFrames {
  None,        ///< none
  After,       ///< all, after the last bit
  Alternating  ///< all, each right after its bit
};

/// Order of the bits of a Gray code in time.
enum class BitOrder {
  MostSignificantFirst,  ///< widest stripes first
  LeastSignificantFirst  ///< narrowest stripes first
};

/// The display that shows a pattern.
enum class PatternSource {
  Projector,  ///< the projector of the rig
  Screen      ///< a monitor; its periods count in pixels of the monitor
};

/// A pattern that the projector or a monitor shows in one or more frames; a [[pattern]] table of
/// scan.toml.
struct Pattern {
  std::string name;                                 ///< also the prefix of its file names
  PatternKind kind = PatternKind::Fringe;           ///< what the frames show
  PatternSource source = PatternSource::Projector;  ///< which display shows it
  /// Of fringes and of the stripes of a Gray code.
  FringeDirection direction = FringeDirection::Vertical;
  double fringes_per_degree = 0.0;  ///< for an angular projector; 0 for a pinhole one
  double period_px = 0.0;           ///< for a pinhole projector; 0 for an angular one
  std::vector<double> shifts_rad;   ///< sigma_i of the paper's equation (1), one per frame
  int bits = 0;                     ///< Gray code: number of bits
  double stripe_px = 1.0;           ///< Gray code: width of a stripe
  /// Gray code: added to a column before its stripe is numbered, for codes centred in their range.
  double offset_px = 0.0;
  bool is_binary = false;  ///< Gray code: the stripe's number in binary code instead
  InvertedFrames inverted = InvertedFrames::None;   ///< Gray code: inverted frames
  BitOrder order = BitOrder::MostSignificantFirst;  ///< Gray code: order of the bits
  std::vector<double> levels;                       ///< ramp: projector levels from 0 to 1
  std::vector<double> exposures_ms;  ///< exposures of each frame; empty: one, of unknown length

  /// Spatial frequency in fringes per degree (angular) or per projector pixel (pinhole).
  [[nodiscard]] double fringes_per_unit() const {
    return fringes_per_degree > 0.0 ? fringes_per_degree : 1.0 / period_px;
  }
  /// Number of frames at one exposure.
  [[nodiscard]] int frame_count() const {
    switch (kind) {
      case PatternKind::Line:
      case PatternKind::White:
      case PatternKind::Ambient:
        return 1;
      case PatternKind::Gray:
        return inverted == InvertedFrames::None ? bits : 2 * bits;
      case PatternKind::Ramp:
        return static_cast<int>(levels.size());
      case PatternKind::Fringe:
        break;
    }
    return static_cast<int>(shifts_rad.size());
  }
  /// Returns the number of exposures of each frame: 1 unless `exposures_ms` lists several.
  [[nodiscard]] int exposure_count() const {
    return exposures_ms.empty() ? 1 : static_cast<int>(exposures_ms.size());
  }
};

}  // namespace frangia
