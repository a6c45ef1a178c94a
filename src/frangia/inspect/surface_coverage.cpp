#include "frangia/inspect/surface_coverage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/mesh/sample_surface.h"

namespace frangia {
namespace {

/// How far a ray starts off the surface it leaves, mm.
constexpr double kStepOff = 1e-3;

bool in_picture(const Lens& lens, const Eigen::Vector3d& point) {
  if (point.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = lens.project(point);
  return pixel.minCoeff() >= -0.5 && pixel.x() <= lens.width_px - 0.5 &&
         pixel.y() <= lens.height_px - 0.5;
}

bool in_field(const Projector& projector, const Eigen::Vector3d& point_in_rig) {
  const Eigen::Vector3d point = projector.from_rig(point_in_rig);
  if (const auto* lens = std::get_if<PinholeModel>(&projector.model)) {
    return in_picture(*lens, point);
  }
  const auto& field = std::get<AngularModel>(projector.model);
  const double psi = std::atan2(point.x(), point.z());
  return psi >= field.field_min_rad && psi <= field.field_max_rad;
}

/// What became of a sample of the truth.
enum class Found : std::uint8_t { Uncounted, Bare, Covered };

using Counts = std::function<bool(const SurfaceSample&)>;

SurfaceCoverage coverage_of(const RayScene& truth,
                            const RayScene& mesh,
                            const Counts& counts,
                            const CoverageOptions& options,
                            const Run& run) {
  const auto samples = sample_surface(truth.mesh(), options.samples, options.seed);
  require(!samples.empty(), "surface_coverage: the truth has no surface");
  std::vector<Found> found(samples.size(), Found::Uncounted);
  constexpr std::size_t kChunk = 1024;
  parallel_chunks(samples.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!counts(samples[i])) continue;
      found[i] =
          mesh.nearest(samples[i].point_mm, options.within_mm) ? Found::Covered : Found::Bare;
    }
  });
  run.report(1.0);
  const auto covered = std::count(found.begin(), found.end(), Found::Covered);
  const auto bare = std::count(found.begin(), found.end(), Found::Bare);
  SurfaceCoverage coverage;
  coverage.count = static_cast<std::size_t>(covered + bare);
  if (coverage.count > 0) {
    coverage.share = static_cast<double>(covered) / static_cast<double>(coverage.count);
  }
  return coverage;
}

}  // namespace

bool is_measurable(const RayScene& scene,
                   const Eigen::Vector3d& point_mm,
                   const Eigen::Vector3d& normal,
                   const SeenFrom& view,
                   double max_angle_rad) {
  const double min_cos = std::cos(max_angle_rad);
  const Eigen::Vector3d start = point_mm + kStepOff * normal;
  return std::any_of(
      view.rig_from_object.begin(), view.rig_from_object.end(), [&](const Eigen::Isometry3d& pose) {
        const Eigen::Vector3d seen = pose * point_mm;
        if (!in_picture(view.rig.camera.lens, seen)) return false;
        if (!in_field(view.rig.projector, seen)) return false;
        const Eigen::Isometry3d object_from_rig = pose.inverse();
        const Eigen::Vector3d camera = object_from_rig.translation();
        const Eigen::Vector3d light = object_from_rig * view.rig.projector.position_mm;
        return (camera - point_mm).normalized().dot(normal) >= min_cos &&
               (light - point_mm).normalized().dot(normal) >= min_cos &&
               !scene.occluded(start, camera) && !scene.occluded(start, light);
      });
}

SurfaceCoverage surface_coverage(const RayScene& truth,
                                 const RayScene& mesh,
                                 const CoverageOptions& options,
                                 const Run& run) {
  return coverage_of(
      truth, mesh, [](const SurfaceSample&) { return true; }, options, run);
}

SurfaceCoverage surface_coverage(const RayScene& truth,
                                 const RayScene& mesh,
                                 const SeenFrom& views,
                                 const CoverageOptions& options,
                                 const Run& run) {
  const auto counts = [&](const SurfaceSample& sample) {
    return is_measurable(truth, sample.point_mm, sample.normal, views, options.max_angle_rad);
  };
  return coverage_of(truth, mesh, counts, options, run);
}

}  // namespace frangia
