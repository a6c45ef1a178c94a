#include "frangia/registration/explain/pose_explanation.h"

namespace frangia {

const char* name_of(PoseCause cause) {
  switch (cause) {
    case PoseCause::AsStated:
      return "as-stated";
    case PoseCause::Turntable:
      return "turntable";
    case PoseCause::Turned:
      return "turned";
    case PoseCause::AnglesScaled:
      return "angles-scaled";
    case PoseCause::AnglesWrong:
      return "angles-wrong";
    case PoseCause::PartMoved:
      return "part-moved";
    case PoseCause::PartMovedTwice:
      return "part-moved-twice";
    case PoseCause::ViewMoved:
      return "view-moved";
    case PoseCause::ViewsMoved:
      return "views-moved";
    case PoseCause::PartDrift:
      return "part-drift";
    case PoseCause::Wobble:
      return "wobble";
    case PoseCause::Rig:
      return "rig";
    case PoseCause::RigDrift:
      return "rig-drift";
    case PoseCause::TableMoved:
      return "table-moved";
    case PoseCause::RigMoved:
      return "rig-moved";
    case PoseCause::Unexplained:
      break;
  }
  return "unexplained";
}

}  // namespace frangia
