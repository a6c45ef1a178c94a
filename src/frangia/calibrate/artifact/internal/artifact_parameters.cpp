#include <variant>

#include <Eigen/Geometry>

#include "frangia/calibrate/artifact/internal/artifact_residuals.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/calibrate/internal/intrinsics_block.h"

namespace frangia {

ArtifactParameters artifact_start(const ArtifactProblem& problem) {
  const Rig& rig = problem.start;
  ArtifactParameters out;
  out.camera = intrinsics_block(rig.reference().model);
  if (const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model)) {
    out.projector = intrinsics_block(*pinhole);
  } else {
    const auto& angular = std::get<AngularModel>(rig.projector.model);
    out.pitch_scale = angular.pitch_scale;
    out.wavefront = angular.wavefront.coefficients_rad;
  }
  const Eigen::AngleAxisd turn(rig.projector.rotation);
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const Eigen::Vector3d translation = -(rig.projector.rotation * rig.projector.position_mm);
  for (std::size_t i = 0; i < 3; ++i) {
    out.pose.at(i) = rotation[static_cast<Eigen::Index>(i)];
    out.pose.at(i + 3) = translation[static_cast<Eigen::Index>(i)];
  }
  for (const ArtifactCapture& capture : problem.captures) {
    out.angle_errors.emplace_back(capture.views.size(), 0.0);
    out.surfaces.emplace_back();
    const bool plate = std::holds_alternative<Plate>(capture.artifact);
    for (const Eigen::Vector4d& surface : capture.surfaces) {
      if (plate) {
        out.surfaces.back().push_back({0.0, 0.0, surface[3], 0.0});
      } else {
        out.surfaces.back().push_back({surface[0], surface[1], surface[2], 0.0});
      }
    }
  }
  return out;
}

Rig artifact_rig(const ArtifactProblem& problem, const ArtifactParameters& parameters) {
  Rig rig = problem.start;
  rig.reference().model = with_intrinsics(rig.reference().model, parameters.camera);
  if (auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model)) {
    *pinhole = with_intrinsics(*pinhole, parameters.projector);
  } else {
    auto& angular = std::get<AngularModel>(rig.projector.model);
    angular.pitch_scale = parameters.pitch_scale;
    angular.wavefront.coefficients_rad = parameters.wavefront;
  }
  const Eigen::Isometry3d projector_from_camera = isometry_of(parameters.pose);
  rig.projector.rotation = projector_from_camera.linear();
  rig.projector.position_mm =
      -(rig.projector.rotation.transpose() * projector_from_camera.translation());
  const Eigen::Vector3d axis = problem.start.turntable->axis;
  const Eigen::Vector3d u = axis.unitOrthogonal();
  rig.turntable->axis = tilted(axis, parameters.table[0], parameters.table[1]);
  rig.turntable->point_mm += parameters.table[2] * u + parameters.table[3] * axis.cross(u);
  return rig;
}

Eigen::Vector4d artifact_surface(const ArtifactProblem& problem,
                                 std::size_t capture,
                                 std::size_t surface,
                                 const ArtifactParameters& parameters) {
  const ArtifactCapture& seen = problem.captures[capture];
  const ArtifactParameters::Surface& values = parameters.surfaces[capture][surface];
  if (!std::holds_alternative<Plate>(seen.artifact)) return {values[0], values[1], values[2], 0.0};
  const Eigen::Vector3d normal =
      tilted(Eigen::Vector3d(seen.surfaces[surface].head<3>()), values[0], values[1]);
  return {normal.x(), normal.y(), normal.z(), values[2]};
}

}  // namespace frangia
