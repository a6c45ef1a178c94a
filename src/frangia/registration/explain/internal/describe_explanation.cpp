#include "frangia/registration/explain/internal/describe_explanation.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// "0.41 ± 0.01 mm and 2.0 ± 0.1°".
std::string text_of_motion(const PoseExplanation& found) {
  std::string words = fmt::format("{:.2g} ± {:.1g} mm", found.moved_mm, found.moved_sigma_mm);
  if (!std::isnan(found.turned_rad)) {
    words += fmt::format(" and {:.2g} ± {:.1g}°",
                         deg_from_rad(found.turned_rad),
                         deg_from_rad(found.turned_sigma_rad));
  }
  return words;
}

const char* assumed_times(const PoseExplanation& found) {
  return found.times_assumed
             ? ", the views being evenly spaced in time, as the scan states no times"
             : "";
}

std::string between(std::size_t view, const ViewNames& names) {
  return fmt::format("between views {} and {}", names(view - 1), names(view));
}

/// "2, 4 and 6".
std::string list_of(const std::vector<std::size_t>& views, const ViewNames& names) {
  std::string list;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i > 0) list += i + 1 == views.size() ? " and " : ", ";
    list += names(views[i]);
  }
  return list;
}

/// What is wrong with stated angles.
std::string text_of_angles(const PoseExplanation& found, const ViewNames& names) {
  constexpr std::size_t kMostListed = 4;
  if (found.exchanged) {
    return fmt::format("views {} have each other's angle", list_of(found.views, names));
  }
  if (!std::isnan(found.spacing_rad)) {
    return fmt::format("the views are evenly spaced by {:.3f}°, where one angle is stated for all",
                       deg_from_rad(found.spacing_rad));
  }
  if (found.views.size() == 1) {
    return fmt::format("the angle of view {} is not the one stated: it is off by {:.3f}°",
                       names(found.views.front()),
                       deg_from_rad(found.turned_rad));
  }
  if (found.views.size() > kMostListed) {
    return fmt::format("the angles of {} views are not those stated: they are off by up to {:.3f}°",
                       found.views.size(),
                       std::abs(deg_from_rad(found.turned_rad)));
  }
  std::vector<std::string> turns;
  for (const double turn : found.turns_rad)
    turns.push_back(fmt::format("{:.3f}°", deg_from_rad(turn)));
  return fmt::format("the angles of views {} are not those stated: they are off by {}",
                     list_of(found.views, names),
                     fmt::join(turns, ", "));
}

std::string cause_text(PoseCause cause, const PoseExplanation& found, const ViewNames& names) {
  switch (cause) {
    case PoseCause::AsStated:
      return "rig and table are as stated";
    case PoseCause::Turntable:
      return "the turntable's axis or angles are farther from what the rig states than its "
             "standard "
             "deviations";
    case PoseCause::Turned:
      return fmt::format("the table lost a step or the part turned about the axis, by {:.3f}°, {}",
                         deg_from_rad(found.turned_rad),
                         between(found.views.front(), names));
    case PoseCause::AnglesScaled:
      return fmt::format("the table turns by {:.4f} times the commanded angles", found.scale);
    case PoseCause::AnglesWrong:
      return text_of_angles(found, names);
    case PoseCause::PartMoved:
      return fmt::format("the part {} by {} {}",
                         std::isnan(found.turned_rad) ? "slid" : "moved",
                         text_of_motion(found),
                         between(found.views.front(), names));
    case PoseCause::PartMovedTwice:
      return fmt::format("the part moved by up to {} {} and {}",
                         text_of_motion(found),
                         between(found.views.front(), names),
                         between(found.views.back(), names));
    case PoseCause::ViewMoved:
      return fmt::format("view {} fits no other view: the part was elsewhere in it alone, by {}",
                         names(found.views.front()),
                         text_of_motion(found));
    case PoseCause::ViewsMoved:
      return fmt::format("in views {} the part was elsewhere, in each by itself and by up to {}",
                         list_of(found.views, names),
                         text_of_motion(found));
    case PoseCause::PartDrift:
      return fmt::format("the part or the table moved {} during the scan, by {}{}",
                         std::isnan(found.time_constant) ? "steadily" : "ever more slowly",
                         text_of_motion(found),
                         assumed_times(found));
    case PoseCause::Wobble:
      return fmt::format(
          "table or part moved at random from view to view, with a standard "
          "deviation of {:.2g} mm",
          found.scale);
    case PoseCause::Rig:
      return fmt::format("the rig is not what rig.toml states, all through the scan ({})",
                         fmt::join(found.terms, ", "));
    case PoseCause::RigDrift:
      return fmt::format("projector or camera drifted{} during the scan ({}){}",
                         std::isnan(found.time_constant) ? "" : " ever more slowly",
                         fmt::join(found.terms, ", "),
                         assumed_times(found));
    case PoseCause::TableMoved:
      return fmt::format("the table moved by {}, or camera and projector together, {}",
                         text_of_motion(found),
                         between(found.views.front(), names));
    case PoseCause::RigMoved:
      return fmt::format("the {} moved against the rest of the rig by {} at the part {}",
                         fmt::join(found.terms, " "),
                         text_of_motion(found),
                         between(found.views.front(), names));
    case PoseCause::Unexplained:
      break;
  }
  return fmt::format("every view is elsewhere, by {:.2g} mm between views", found.effect_mm);
}

/// The name of a cause, without what it found.
const char* words_of(PoseCause cause) {
  switch (cause) {
    case PoseCause::AsStated:
      return "rig and table as stated";
    case PoseCause::Turntable:
      return "an axis or angles that are not as stated";
    case PoseCause::Turned:
      return "a lost step of the table";
    case PoseCause::AnglesScaled:
      return "angles in another proportion";
    case PoseCause::AnglesWrong:
      return "other angles than those stated";
    case PoseCause::PartMoved:
      return "a part that slid once";
    case PoseCause::PartMovedTwice:
      return "a part that moved twice";
    case PoseCause::ViewMoved:
      return "a part that was elsewhere in one view";
    case PoseCause::ViewsMoved:
      return "a part that was elsewhere in several views";
    case PoseCause::PartDrift:
      return "a part or table that moved steadily";
    case PoseCause::Wobble:
      return "a table that wobbles";
    case PoseCause::Rig:
      return "a rig that is not as stated";
    case PoseCause::RigDrift:
      return "a drift of projector or camera";
    case PoseCause::TableMoved:
      return "a table that was knocked";
    case PoseCause::RigMoved:
      return "a camera or projector that was knocked";
    case PoseCause::Unexplained:
      break;
  }
  return "views that are each elsewhere";
}

}  // namespace

std::string describe(const PoseExplanation& found, const ViewNames& names) {
  if (found.best == PoseCause::AsStated) return {};
  if (!found.decided && found.second == found.best) {
    return fmt::format(
        "the views disagree by {:.2g} mm because of {}, but before which views is not decided; "
        "what that leaves open is in sigma",
        found.effect_mm,
        words_of(found.best));
  }
  if (!found.decided) {
    return fmt::format(
        "the views disagree by {:.2g} mm for a reason that is not decided: {} or {}; their "
        "difference is in sigma",
        found.effect_mm,
        words_of(found.best),
        words_of(found.second));
  }
  std::string words = cause_text(found.best, found, names);
  for (const PoseCause cause : found.alike)
    words += fmt::format(", or {}, which moves the views alike", words_of(cause));
  switch (found.best) {
    case PoseCause::PartMoved:
      return words + "; both groups were joined";
    case PoseCause::PartMovedTwice:
      return words + "; the groups were joined";
    case PoseCause::ViewsMoved:
      return words + "; they were joined by their surfaces";
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
    case PoseCause::AnglesWrong:
    case PoseCause::PartDrift:
    case PoseCause::Wobble:
    case PoseCause::RigDrift:
    case PoseCause::TableMoved:
    case PoseCause::RigMoved:
      return words + "; the views were corrected for it";
    case PoseCause::ViewMoved:
      return words + "; it is left out";
    default:
      return words;
  }
}

std::string remedy_of(const PoseExplanation& found, WrongRig wrong_rig) {
  if (!found.decided) return {};
  switch (found.best) {
    case PoseCause::Turntable:
      return "calibrate the turntable, or state its standard deviations";
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
      return "check the table's steps per turn and its load";
    case PoseCause::AnglesWrong:
      return "correct the angles in scan.toml";
    case PoseCause::PartMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::ViewMoved:
    case PoseCause::ViewsMoved:
      return "clamp the part";
    case PoseCause::PartDrift:
    case PoseCause::Wobble:
      return "check the bearing of the table and how the part stands";
    case PoseCause::Rig:
      if (wrong_rig == WrongRig::IsRefined) return {};
      return wrong_rig == WrongRig::AdviseCalibration
                 ? "calibrate the rig again"
                 : "refine the rig by `refine_rig`, or calibrate it";
    case PoseCause::RigDrift:
      return "let camera and projector warm up before a scan, and fasten them";
    case PoseCause::TableMoved:
      return "fix the table against the rig";
    case PoseCause::RigMoved:
      return "fix camera and projector, and calibrate the rig again";
    default:
      return {};
  }
}

}  // namespace frangia
