#include "frangia/inspection/calibration_displacements.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/inspection/internal/view_poses.h"
#include "frangia/range/rig_change_field.h"

namespace frangia {
namespace {

constexpr double kGrazing = 0.2;  // cosine below which a view measures nothing

/// The cosine between a normal and the direction to the camera.
double cosine_to_camera(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return -normal.dot(point.normalized());
}

/// Vertices, in the rig frame, of views that they face.
MeasuredVolume facing_points(const Mesh& mesh,
                             const std::vector<Eigen::Vector3f>& normals,
                             const std::vector<Eigen::Isometry3d>& poses) {
  constexpr std::size_t kMost = 600;
  MeasuredVolume volume;
  const std::size_t pairs = mesh.vertices_mm.size() * poses.size();
  const std::size_t step = pairs / (2 * kMost) + 1;  // half of the surface faces a camera
  for (std::size_t i = 0; i < pairs; i += step) {
    const std::size_t vertex = i / poses.size();
    if (!mesh.vertices_mm[vertex].allFinite()) continue;
    const auto seen_at = [&](const Eigen::Isometry3d& pose) {
      return std::pair<Eigen::Vector3d, Eigen::Vector3d>(
          pose * mesh.vertices_mm[vertex].cast<double>(),
          pose.linear() * normals[vertex].cast<double>());
    };
    const auto [point, normal] = seen_at(poses[i % poses.size()]);
    if (!(cosine_to_camera(point, normal) > kGrazing)) continue;
    volume.points_mm.push_back(point);
    for (std::size_t next = 1; next < poses.size(); ++next) {
      const auto [there, turned] = seen_at(poses[(i + next) % poses.size()]);
      if (!(cosine_to_camera(there, turned) > kGrazing)) continue;
      volume.shared.push_back({point, normal, there, turned});
      break;
    }
  }
  return volume;
}

}  // namespace

Eigen::MatrixXf calibration_displacements(const Mesh& mesh, const Scan& scan, const Run& run) {
  const auto fringes =
      std::find_if(scan.patterns.begin(), scan.patterns.end(), [](const Pattern& pattern) {
        return pattern.kind == PatternKind::Fringe;
      });
  if (fringes == scan.patterns.end() || scan.views.empty()) return {};
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  const std::vector<Eigen::Isometry3d> poses = inspection::view_poses(scan);
  const RigChangeField field(scan.rig, *fringes, facing_points(mesh, normals, poses));
  constexpr std::size_t kChunk = 1024;
  const auto count = mesh.vertices_mm.size();
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(field.components(), static_cast<Eigen::Index>(count));
  if (field.components() == 0) return out;
  interruptible_chunks(count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!mesh.vertices_mm[i].allFinite()) continue;
      Eigen::VectorXf sum = Eigen::VectorXf::Zero(field.components());
      double weights = 0.0;
      for (const Eigen::Isometry3d& pose : poses) {
        const Eigen::Vector3d point = pose * mesh.vertices_mm[i].cast<double>();
        const Eigen::Vector3d normal = pose.linear() * normals[i].cast<double>();
        const double cosine = cosine_to_camera(point, normal);
        if (!(cosine > kGrazing)) continue;
        sum += static_cast<float>(cosine * cosine) *
               (field.at(point).transpose() * normal.cast<float>());
        weights += cosine * cosine;
      }
      if (weights > 0.0) out.col(static_cast<Eigen::Index>(i)) = sum / static_cast<float>(weights);
    }
  });
  return out;
}

}  // namespace frangia
