#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/decode/own_stages.h"
#include "frangia/decode/phase_files.h"
#include "frangia/decode/survey_scan.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/spatial/unwrap_spatially.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/temporal/correct_order_jumps.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/wrap/fill_enclosed.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Which directions of fringes of a scan that has both are used.
enum class DirectionChoice {
  Fused,      ///< both, combined by least squares in triangulation
  Best,       ///< at each pixel, the one whose point has the smaller standard deviation
  Vertical,   ///< vertical fringes only
  Horizontal  ///< horizontal fringes only
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(DirectionChoice /*any*/) {
  return EnumNames<DirectionChoice, 4>{{{DirectionChoice::Fused, "fused"},
                                        {DirectionChoice::Best, "best"},
                                        {DirectionChoice::Vertical, "vertical"},
                                        {DirectionChoice::Horizontal, "horizontal"}}};
}

/// Which colors of the pixels are kept, see `view_color`.
enum class FrameColors {
  None,    ///< none
  Linear,  ///< the frames are proportional to light, as those of machine cameras
  Encoded  ///< the frames are coded for a screen, as photographs are
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(FrameColors /*any*/) {
  return EnumNames<FrameColors, 3>{{{FrameColors::Linear, "linear"},
                                    {FrameColors::Encoded, "encoded"},
                                    {FrameColors::None, "none"}}};
}

/// Options of the stages from frames to absolute phase.
struct DecodeOptions {
  std::string algorithm = "auto";  ///< name, see `fit_algorithm`
  /// An algorithm of the user, instead of the named one.
  std::optional<LinearAlgorithm> own_algorithm;
  /// Recovers the one saturated frame of four instead of discarding the pixel as the 1997 paper
  /// does.
  bool recover_saturated = false;
  /// Response of a projector that showed the patterns without its look-up table; its effect on the
  /// phase is removed.
  std::optional<ResponseCurve> response;
  /// Waveforms of such a projector's fringes, by period; they take precedence over `response`.
  std::vector<FringeWaveform> waveforms;
  /// Removes the effect of the harmonics that the frames themselves show where they shift the phase
  /// by more than their own uncertainty would; not where `response` or `waveforms` are given.
  bool undo_own_response = true;
  /// Corrects the phase for the blur of the camera where the brightness changes or the surface
  /// bends, if the patterns of a direction show how wide it is, else for the area of the pixels.
  bool undo_blur = true;
  /// Keeps the wrapped maps. Otherwise a sequence is decoded in one pass over its frames if all its
  /// unwrapping levels are safe for every pixel that `wrap` keeps.
  bool keep_maps = true;
  DirectionChoice directions = DirectionChoice::Fused;  ///< of a scan that has both directions
  /// Triangulates frames that do not fit scan.toml.
  bool accept_inconsistent = false;
  /// Decodes with the shifts that fit the frames where those of scan.toml do not, if the same check
  /// then passes.
  bool accept_remedy = false;
  SequenceCheckOptions sequence_check;  ///< comparison of the patterns with each other
  ScanSurvey survey;                    ///< noise and gain error pooled over several views
  /// Variance that the storage of the frames added to each pixel, counts squared. Empty: that of
  /// `FrameStack::compression_counts2`, or of the traces that it left (`find_storage_loss`).
  std::optional<double> storage_counts2{};
  WrapOptions wrap;                        ///< limit of the phase noise
  TemporalUnwrapOptions temporal;          ///< temporal unwrapping
  OrderJumpOptions order_jumps;            ///< correction of regions whose order is wrong
  SpatialUnwrapOptions spatial;            ///< spatial unwrapping, for scans without a sequence
  LaserProfileOptions line;                ///< detection of the laser line
  FringeOrderOptions fringe_order;         ///< fringe orders from the laser line
  FillOptions fill;                        ///< interpolation of enclosed pixels
  FrameColors colors = FrameColors::None;  ///< colors of the pixels that are kept
  OwnStages own;                           ///< functions of the caller instead of ours
  std::optional<PhaseFiles> phase_files;   ///< maps of another program instead of ours
};

/// The options of one view: its functions take the maps of `phase_files`, where these are given.
[[nodiscard]] DecodeOptions options_of_view(const DecodeOptions& options, std::size_t view);

}  // namespace frangia
