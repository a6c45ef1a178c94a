#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/missing.h"

namespace frangia {

/// What can move the surfaces of views against each other.
enum class PoseCause : std::uint8_t {
  AsStated,      ///< rig and table are what is stated, within the standard deviations
  Turntable,     ///< axis or angles are farther from the statement than its standard deviations
  Turned,        ///< from one view on, the table or the part is turned about the axis
  AnglesScaled,  ///< the table turns by another angle than was commanded, in proportion
  AnglesWrong,   ///< the angles of views are not those stated, by any amount
  PartMoved,     ///< the part moved between two views
  PartMovedTwice,
  ViewMoved,   ///< one view alone was taken in another pose
  ViewsMoved,  ///< several views, each by itself
  PartDrift,   ///< the part, or the table, moves evenly with time
  Wobble,      ///< table or part move at random from view to view
  Rig,         ///< projector or camera are not where the rig states, all through the scan
  RigDrift,    ///< projector or camera drift with time
  TableMoved,  ///< the table moved between two views, or camera and projector together
  RigMoved,    ///< projector or camera moved between two views
  Unexplained  ///< every view is elsewhere
};

/// The word for a cause in `--json`: "part-moved".
[[nodiscard]] const char* name_of(PoseCause cause);

/// The explanation of the poses of a scan's views, chosen by evidence.
///
/// @units    mm, rad
struct PoseExplanation {
  PoseCause best = PoseCause::AsStated;    ///< by evidence, even where it is not decided
  std::vector<PoseCause> alike;            ///< causes that predict the same as the best
  PoseCause second = PoseCause::AsStated;  ///< the best of those that predict something else
  double log_odds = 0.0;                   ///< natural logarithm, of the best against the second
  double log_odds_stated = 0.0;            ///< the same against what is stated
  bool decided = true;                     ///< the odds are above 100 : 1
  /// Views of the best: those before which the part moved, or those that are elsewhere.
  std::vector<std::size_t> views;
  double effect_mm = 0.0;  ///< what the best changes between the views, root mean square of pairs
  double moved_mm = kMissing;          ///< of the part's centre, where the part moved
  double moved_sigma_mm = kMissing;    ///< its standard deviation
  double turned_rad = kMissing;        ///< of the table; of the part about its centre, if it did
  double turned_sigma_rad = kMissing;  ///< its standard deviation, of the part
  double scale = kMissing;  ///< of the angles, or the standard deviation of a wobble in mm
  /// Of angles that are not those stated: of `views`, what they are off by; whether two views have
  /// each other's; and the spacing, where all views have one stated angle and are evenly spaced.
  std::vector<double> turns_rad{};
  bool exchanged = false;          ///< two views have each other's angle
  double spacing_rad = kMissing;   ///< between neighbouring views that state one angle; NaN: none
  std::vector<std::string> terms;  ///< of the rig, that changed most
  /// Of a drift that approaches its end exponentially, as a share of the time between the first
  /// view and the last.
  double time_constant = kMissing;
  bool times_assumed = false;   ///< the views state no times: they are taken for even in time
  double unexplained_mm = 0.0;  ///< what the pairs of two views still have in common
  std::string text{};           ///< one sentence, empty when all is as stated
  std::string remedy{};         ///< what to do, empty for nothing
};

}  // namespace frangia
