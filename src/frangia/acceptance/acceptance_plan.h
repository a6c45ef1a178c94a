#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"

namespace frangia {

/// The ball bar, or the single ball, of an acceptance test as its calibration certificate states
/// it, at 20 degrees Celsius.
struct ReferenceArtifact {
  std::vector<double> diameters_mm;  ///< of one ball or of two
  double spacing_mm = 0.0;           ///< of the centers of two balls; 0: a single ball
  double u95_mm = 0.0;               ///< expanded uncertainty (k = 2) of diameters and spacing
  double form_mm = 0.0;              ///< form deviation of the balls
  double expansion_ppm_per_k = 0.0;  ///< coefficient of thermal expansion, 1e-6/K
  std::string certificate;           ///< its number; may be empty
};

/// Maximum permissible errors; an absent one is measured and not judged.
struct AcceptanceLimits {
  std::optional<double> probing_form_mm;    ///< of P_Form.Sph.D95%
  std::optional<double> probing_size_mm;    ///< of P_Size.Sph, either sign
  std::optional<double> sphere_spacing_mm;  ///< of the distance of two centers, either sign
  std::optional<double> length_mm;          ///< of the length across both balls, either sign
};

/// Where the scans of an acceptance test come from.
enum class AcceptanceSource {
  Scans,      ///< folders that exist
  Devices,    ///< captured by the rig's devices, with a pause before each arrangement
  Simulation  ///< rendered through the rig
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(AcceptanceSource /*any*/) {
  return EnumNames<AcceptanceSource, 3>{{{AcceptanceSource::Scans, "scans"},
                                         {AcceptanceSource::Devices, "devices"},
                                         {AcceptanceSource::Simulation, "simulation"}}};
}

/// One arrangement of the artifact in the measuring volume.
struct Arrangement {
  std::string name;                                        ///< for the certificate and the user
  std::filesystem::path scan;                              ///< folder; of `Scans` alone
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();    ///< of the bar, object frame, unit
  Eigen::Vector3d offset_share = Eigen::Vector3d::Zero();  ///< of its middle, in bar lengths
};

/// A test of acceptance or reverification: acceptance.toml.
struct AcceptancePlan {
  std::filesystem::path rig;                          ///< rig.toml, or the name of a built-in rig
  AcceptanceSource source = AcceptanceSource::Scans;  ///< of the scans
  int views = 8;                                      ///< of each scan that is made
  ReferenceArtifact artifact;                         ///< what is measured
  AcceptanceLimits limits;                            ///< what is permitted
  std::optional<Eigen::Vector3d> volume_mm;           ///< sides of the measuring volume
  double temperature_c = 20.0;                        ///< of the artifact
  double temperature_u_k = 0.0;                       ///< its standard uncertainty
  std::vector<Arrangement> arrangements;              ///< in the order of measurement
  std::vector<std::pair<std::string, std::string>> conditions;  ///< free text: operator, room, ...
};

/// The seven arrangements of a ball bar that are used where a plan names none: along and across,
/// upright, and along diagonals of the volume. For a single ball: its middle and two edges.
[[nodiscard]] std::vector<Arrangement> usual_arrangements(const ReferenceArtifact& artifact);

/// Reads acceptance.toml, format "frangia-acceptance".
///
/// @units    mm, degrees Celsius
/// @errors   Error(Input) that names the file and the key, also one that is unknown
[[nodiscard]] AcceptancePlan read_acceptance_plan(const std::filesystem::path& path);

/// The same of text; `path` is named in messages, and names of files are relative to its folder. A
/// plan of scans may name none: they are still to be made.
[[nodiscard]] AcceptancePlan parse_acceptance_plan(const std::string& text,
                                                   const std::filesystem::path& path);

}  // namespace frangia
