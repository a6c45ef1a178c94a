#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"

namespace frangia {

/// What the product and manufacturing information of a model asks for.
enum class CadRequirementKind : std::uint8_t {
  Datum,             ///< names faces
  Diameter,          ///< of a cylinder or a sphere
  Distance,          ///< between faces
  Angle,             ///< between faces
  Flatness,          ///< a form
  Roundness,         ///< a form
  Cylindricity,      ///< a form
  Parallelism,       ///< to a datum
  Perpendicularity,  ///< to a datum
  Position,          ///< in a system of datums
  RunOut,            ///< about a datum
  TotalRunOut,       ///< about a datum
  SurfaceProfile,    ///< of faces, or of the whole part where it names none
  Other              ///< what is not read; `CadRequirement::name` says what
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(CadRequirementKind /*any*/) {
  return EnumNames<CadRequirementKind, 14>{
      {{CadRequirementKind::Datum, "datum"},
       {CadRequirementKind::Diameter, "diameter"},
       {CadRequirementKind::Distance, "distance"},
       {CadRequirementKind::Angle, "angle"},
       {CadRequirementKind::Flatness, "flatness"},
       {CadRequirementKind::Roundness, "roundness"},
       {CadRequirementKind::Cylindricity, "cylindricity"},
       {CadRequirementKind::Parallelism, "parallelism"},
       {CadRequirementKind::Perpendicularity, "perpendicularity"},
       {CadRequirementKind::Position, "position"},
       {CadRequirementKind::RunOut, "run-out"},
       {CadRequirementKind::TotalRunOut, "total-run-out"},
       {CadRequirementKind::SurfaceProfile, "surface profile"},
       {CadRequirementKind::Other, "other"}}};
}

/// A dimension, a geometrical tolerance or a datum of a model. Lengths in mm, angles in degrees.
struct CadRequirement {
  CadRequirementKind kind = CadRequirementKind::Other;  ///< what is required
  std::string name;                                     ///< in the file; may be empty
  double value = kMissing;  ///< nominal size; of a geometrical tolerance the width of its zone
  double lower = kMissing;  ///< limits of the difference from a nominal size; NaN: none stated
  double upper = kMissing;  ///< see `lower`
  std::vector<std::size_t> faces;        ///< numbers from 1 of what it is about
  std::vector<std::size_t> other_faces;  ///< of a distance or an angle: to what
  std::vector<std::string> datums;       ///< names, in their order
};

/// The semantic product and manufacturing information of a STEP file, AP242.
struct CadPmi {
  std::string schema;                        ///< of the file: "AP203", "AP214", "AP242", or empty
  bool has_graphics = false;                 ///< the file holds drawn annotations
  std::vector<CadRequirement> requirements;  ///< in the order of the file
};

}  // namespace frangia
