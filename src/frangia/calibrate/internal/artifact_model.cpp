#include "frangia/calibrate/internal/artifact_model.h"

#include <cmath>
#include <variant>

#include <Eigen/Geometry>

namespace frangia {

std::vector<ArtifactDistance> artifact_distances(const ArtifactCalibration& result,
                                                 std::size_t capture,
                                                 std::size_t view) {
  const ArtifactCapture& seen = result.captures[capture];
  const ArtifactView& at = seen.views[view];
  const ArtifactSolution& table = *result.table;
  const double angle_rad = at.angle_rad + table.angle_errors_rad[capture][view];
  const Eigen::Isometry3d back = table_turn(result.rig, angle_rad).inverse();
  const bool plate = std::holds_alternative<Plate>(seen.artifact);
  const std::vector<Eigen::Vector3d> points = site_points(at.sites, result.rig);
  std::vector<ArtifactDistance> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const auto which = static_cast<std::size_t>(at.surface[i]);
    const Eigen::Vector4d& surface = table.surfaces[capture][which];
    // The point as it was at table angle 0.
    const Eigen::Vector3d point = back * points[i];
    const double distance_mm =
        plate ? surface.head<3>().dot(point) - surface[3]
              : (point - surface.head<3>()).norm() - 0.5 * table.diameters_mm[capture][which];
    out.push_back({at.sites[i].camera_px, distance_mm});
  }
  return out;
}

double rms_mm(const std::vector<ArtifactDistance>& distances) {
  double sum = 0.0;
  for (const ArtifactDistance& one : distances)
    sum += one.distance_mm * one.distance_mm;
  return distances.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(distances.size()));
}

}  // namespace frangia
