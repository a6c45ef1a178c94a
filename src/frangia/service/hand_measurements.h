#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "frangia/core/missing.h"
#include "frangia/editor/edit_operation.h"
#include "frangia/features/measure_picked.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// What somebody measured, in the frame of the mesh.
struct HandElement {
  std::string kind;  ///< "point", the name of a ShapeKind, "selection" or "surface"
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();   ///< that was clicked
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of the face; the point itself
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();      ///< of the face; no meaning for a point
  double diameter_mm = kMissing;  ///< of the face; NaN for a plane and a point
  double form_mm = kMissing;      ///< range of the residuals of the face; NaN for a point
};

/// What somebody measured by clicking on the surface.
struct HandMeasurement {
  std::string label;  ///< "A": unique among them
  std::string mesh;   ///< names the mesh that it is of, see `mesh_name`
  PickedQuantity quantity = PickedQuantity::Distance;  ///< what was measured
  double value = 0.0;                                  ///< in `unit_of(quantity)`
  double u95 = kMissing;                               ///< NaN where not known
  std::vector<HandElement> elements;                   ///< what it is of, one to three
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();   ///< see `PickedMeasurement`
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();     ///< likewise
};

/// At most, in a project.
inline constexpr std::size_t kMostMeasurements = 500;

/// Names a mesh, also after a restart: the number of the surface's version, and a hash of those of
/// the steps that change the mesh.
[[nodiscard]] std::string mesh_name(int version, std::span<const EditStep> done);

/// The first label, "A" to "Z", then "A2", ..., that no measurement has.
[[nodiscard]] std::string free_label(const std::vector<HandMeasurement>& measurements);

/// A measurement as it is kept.
[[nodiscard]] HandMeasurement hand_measurement_of(const PickedMeasurement& found,
                                                  std::string label,
                                                  std::string mesh);

/// @missing  what is not known is null
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<HandMeasurement>& measurements);

/// The measurements of a project; none where there is no file, or a damaged one. Distances and
/// angles of points that an older program kept have no uncertainty.
[[nodiscard]] std::vector<HandMeasurement> read_hand_measurements(const ProjectFolder& project);

/// @errors   Error(File) when the file cannot be written
void write_hand_measurements(const ProjectFolder& project,
                             const std::vector<HandMeasurement>& measurements);

}  // namespace frangia
