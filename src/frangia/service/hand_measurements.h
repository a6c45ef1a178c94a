#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "frangia/service/project_folder.h"

namespace frangia {

/// What somebody measured by clicking points of the surface: two for a distance, three for an angle
/// at the second.
struct HandMeasurement {
  std::string label;                       ///< "A": unique among them
  std::string mesh;                        ///< names the mesh on which the points are
  std::vector<Eigen::Vector3d> points_mm;  ///< object frame
  std::vector<double> sigmas_mm;           ///< of the points; NaN where not known
};

/// At most, in a project.
inline constexpr std::size_t kMostMeasurements = 500;

/// Reads measurements from JSON as docs/service-api.md describes them.
///
/// @errors   Error(Input) that names the key and says what is wrong
[[nodiscard]] std::vector<HandMeasurement> hand_measurements_of(const nlohmann::json& json);

/// @missing  a sigma that is not known is null
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<HandMeasurement>& measurements);

/// The measurements of a project; none where there is no file, or a damaged one.
[[nodiscard]] std::vector<HandMeasurement> read_hand_measurements(const ProjectFolder& project);

/// @errors   Error(File) when the file cannot be written
void write_hand_measurements(const ProjectFolder& project,
                             const std::vector<HandMeasurement>& measurements);

}  // namespace frangia
