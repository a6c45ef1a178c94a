#include "frangia/inspect/surface_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/geometry/surface_samples.h"

namespace frangia {
namespace {

std::vector<float> signed_distances(const std::vector<Eigen::Vector3d>& points,
                                    const RayScene& reference,
                                    const ExactSurface* exact,
                                    const Run& run) {
  require(!reference.mesh().empty(),
          "the reference has no triangles, only points; give a mesh with triangles");
  constexpr std::size_t kChunk = 2048;
  constexpr std::size_t kBlock = 64 * kChunk;  // between reports of progress
  std::vector<float> distances(points.size());
  for (std::size_t done = 0; done < points.size(); done += kBlock) {
    const std::size_t size = std::min(kBlock, points.size() - done);
    interruptible_chunks(size, kChunk, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = done + begin; i < done + end; ++i) {
        const NearestPoint near = *reference.nearest(points[i]);
        const double distance = exact == nullptr
                                    ? near.signed_distance_mm
                                    : exact->nearest(points[i], near).signed_distance_mm;
        distances[i] = static_cast<float>(distance);
      }
    });
    run.report(static_cast<double>(done + size) / static_cast<double>(points.size()));
  }
  return distances;
}

std::vector<Eigen::Vector3d> points_of(const Mesh& mesh, const SurfaceErrorOptions& options) {
  std::vector<Eigen::Vector3d> points;
  if (options.samples > 0) {
    for (const SurfaceSample& sample : sample_surface(mesh, options.samples, options.seed)) {
      points.push_back(sample.point_mm);
    }
    return points;
  }
  std::vector<bool> used(mesh.vertices_mm.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle)
      used[vertex] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.emplace_back(mesh.vertices_mm[i].cast<double>());
  }
  return points;
}

/// The smallest value that at least this share of the sorted values does not exceed.
double percentile(const std::vector<float>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size())) - 1.0;
  return static_cast<double>(sorted[static_cast<std::size_t>(std::max(rank, 0.0))]);
}

}  // namespace

SurfaceError surface_error(const Mesh& mesh,
                           const RayScene& reference,
                           const SurfaceErrorOptions& options,
                           const Run& run) {
  const std::vector<Eigen::Vector3d> points = points_of(mesh, options);
  require(!points.empty(), "the mesh has no triangles, only points; give a mesh with triangles");
  std::vector<float> distances = signed_distances(points, reference, options.exact, run);

  SurfaceError error;
  error.count = distances.size();
  double sum2 = 0.0;
  double sum2_within = 0.0;
  std::size_t within = 0;
  for (float& distance : distances) {
    const auto d = static_cast<double>(distance);
    error.bias_mm += d;
    error.mean_mm += std::abs(d);
    sum2 += d * d;
    if (std::abs(d) <= options.max_distance_mm) {
      sum2_within += d * d;
      ++within;
    }
    distance = std::abs(distance);
  }
  const auto count = static_cast<double>(error.count);
  error.bias_mm /= count;
  error.mean_mm /= count;
  error.rms_mm = std::sqrt(sum2 / count);
  error.rms_within_mm = within > 0 ? std::sqrt(sum2_within / static_cast<double>(within)) : 0.0;
  error.share_beyond = 1.0 - static_cast<double>(within) / count;
  std::sort(distances.begin(), distances.end());
  error.p95_mm = percentile(distances, 0.95);
  error.p99_mm = percentile(distances, 0.99);
  error.max_mm = static_cast<double>(distances.back());
  return error;
}

std::vector<float> vertex_errors_mm(const Mesh& mesh,
                                    const RayScene& reference,
                                    const Run& run,
                                    const ExactSurface* exact) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.vertices_mm.size());
  for (const auto& vertex : mesh.vertices_mm)
    points.emplace_back(vertex.cast<double>());
  return signed_distances(points, reference, exact, run);
}

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
