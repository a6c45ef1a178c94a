#include "frangia/inspect/surface_completeness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "frangia/core/interruptible_chunks.h"
#include "frangia/geometry/sample_surface.h"

namespace frangia {
namespace {

/// Offset of the start of a ray from the surface, mm.
constexpr double kRayOffset_mm = 1e-3;

bool in_image(const CameraModel& model, const Eigen::Vector3d& point) {
  if (point.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = model.project(point);
  return pixel.minCoeff() >= -0.5 && pixel.x() <= model.width_px - 0.5 &&
         pixel.y() <= model.height_px - 0.5;
}

bool in_projector_field(const Projector& projector, const Eigen::Vector3d& point_in_rig) {
  const Eigen::Vector3d point = projector.from_rig(point_in_rig);
  if (const auto* model = std::get_if<PinholeModel>(&projector.model)) {
    return in_image(*model, point);
  }
  const auto& field = std::get<AngularModel>(projector.model);
  const double psi = std::atan2(point.x(), point.z());
  return psi >= field.field_min_rad && psi <= field.field_max_rad;
}

/// Whether a sample of the reference counts and has mesh near it.
enum class SampleStatus : std::uint8_t { Excluded, Missed, Covered };

using SampleFilter = std::function<bool(const SurfaceSample&)>;

SurfaceCompleteness completeness_of(const RayScene& reference,
                                    const RayScene& mesh,
                                    const SampleFilter& counts,
                                    const CompletenessOptions& options,
                                    const Run& run) {
  const auto samples = sample_surface(reference.mesh(), options.samples, options.seed);
  require(!samples.empty(),
          "the reference has no triangles, only points; give a mesh with triangles");
  std::vector<SampleStatus> found(samples.size(), SampleStatus::Excluded);
  constexpr std::size_t kChunk = 1024;
  interruptible_chunks(samples.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!counts(samples[i])) continue;
      found[i] = mesh.nearest(samples[i].point_mm, options.within_mm) ? SampleStatus::Covered
                                                                      : SampleStatus::Missed;
    }
  });
  run.report(1.0);
  const auto covered = std::count(found.begin(), found.end(), SampleStatus::Covered);
  const auto missed = std::count(found.begin(), found.end(), SampleStatus::Missed);
  SurfaceCompleteness completeness;
  completeness.count = static_cast<std::size_t>(covered + missed);
  if (completeness.count > 0) {
    completeness.share = static_cast<double>(covered) / static_cast<double>(completeness.count);
  }
  return completeness;
}

}  // namespace

bool is_measurable(const RayScene& scene,
                   const Eigen::Vector3d& point_mm,
                   const Eigen::Vector3d& normal,
                   const MeasurementViews& view,
                   double max_angle_rad) {
  const double min_cos = std::cos(max_angle_rad);
  const Eigen::Vector3d start = point_mm + kRayOffset_mm * normal;
  const bool is_label = view.rig.projector.is_label;
  const std::size_t cameras = view.rig.cameras.size();
  const auto is_faced = [&](const Eigen::Vector3d& eye) {
    return (eye - point_mm).normalized().dot(normal) >= min_cos && !scene.occluded(start, eye);
  };
  return std::any_of(
      view.rig_from_object.begin(), view.rig_from_object.end(), [&](const Eigen::Isometry3d& pose) {
        const Eigen::Vector3d seen = pose * point_mm;
        const Eigen::Isometry3d object_from_rig = pose.inverse();
        if (!is_label && (!in_projector_field(view.rig.projector, seen) ||
                          !is_faced(object_from_rig * view.rig.projector.position_mm)))
          return false;
        std::size_t wanted = is_label ? 2 : 1;
        for (std::size_t camera = 0; camera < cameras && wanted > 0; ++camera) {
          const Eigen::Isometry3d to_camera = view.rig.cameras[camera].camera_from_rig();
          if (in_image(view.rig.cameras[camera].camera.model, to_camera * seen) &&
              is_faced(object_from_rig * to_camera.inverse().translation()))
            --wanted;
        }
        return wanted == 0;
      });
}

SurfaceCompleteness surface_completeness(const RayScene& reference,
                                         const RayScene& mesh,
                                         const CompletenessOptions& options,
                                         const Run& run) {
  return completeness_of(
      reference, mesh, [](const SurfaceSample&) { return true; }, options, run);
}

SurfaceCompleteness surface_completeness(const RayScene& reference,
                                         const RayScene& mesh,
                                         const MeasurementViews& views,
                                         const CompletenessOptions& options,
                                         const Run& run) {
  const auto counts = [&](const SurfaceSample& sample) {
    return is_measurable(reference, sample.point_mm, sample.normal, views, options.max_angle_rad);
  };
  return completeness_of(reference, mesh, counts, options, run);
}

}  // namespace frangia
