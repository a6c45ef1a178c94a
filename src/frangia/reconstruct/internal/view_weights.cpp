#include "frangia/reconstruct/internal/view_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/interruptible_chunks.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {
namespace {

/// A view that may have measured vertices of a mesh.
struct Observer {
  View view;
  FastCameraModel model;
  double focal_px;
  bool occlusion;  ///< only what it measured, or all that it faces

  /// The weight of the view at a vertex; 0 where it did not measure it.
  [[nodiscard]] double weight_at(const Eigen::Vector3d& vertex,
                                 const Eigen::Vector3d& outward) const {
    constexpr double kGrazing = 0.1;   // cosine below which a view measures nothing
    constexpr double kSpacings = 2.0;  // distance of neighbouring points
    constexpr double kSigmas = 4.0;
    const Eigen::Vector3d point = view.rig_from_object * vertex;
    const Eigen::Vector3d normal = view.rig_from_object.linear() * outward;
    const double cosine = -normal.dot(point.normalized());
    if (!(cosine > kGrazing) || !(point.z() > 0.0)) return 0.0;
    if (!occlusion) return cosine * cosine;
    float u = 0.0F;
    float v = 0.0F;
    const Eigen::Vector3f seen = point.cast<float>();
    model.project(seen.x(), seen.y(), seen.z(), u, v);
    const float x = std::round(u);
    const float y = std::round(v);
    const Image<float>& depths = view.range.depth_mm;
    if (!(x >= 0.0F && y >= 0.0F && x < static_cast<float>(depths.width()) &&
          y < static_cast<float>(depths.height())))
      return 0.0;
    const auto depth = static_cast<double>(depths(static_cast<int>(x), static_cast<int>(y)));
    if (std::isnan(depth)) return 0.0;
    const auto sigma =
        static_cast<double>(view.range.sigma_mm(static_cast<int>(x), static_cast<int>(y)));
    const double limit = kSpacings * depth / focal_px + kSigmas * sigma;
    if (std::abs(depth - point.z()) * cosine > limit) return 0.0;
    return cosine * cosine / std::max(sigma * sigma, 1e-30);
  }
};

}  // namespace

Eigen::MatrixXf view_weights(const Mesh& mesh,
                             const std::vector<std::size_t>& vertices,
                             const std::vector<CameraViews>& cameras,
                             const Run& run) {
  constexpr std::size_t kChunk = 1024;
  const auto views = static_cast<Eigen::Index>(cameras.front().views.size());
  Eigen::MatrixXf weights =
      Eigen::MatrixXf::Zero(views, static_cast<Eigen::Index>(vertices.size()));
  const auto add = [&](bool occlusion, const std::vector<char>& wanted) {
    for (const CameraViews& camera : cameras) {
      for (std::size_t view = 0; view < camera.views.size(); ++view) {
        View seen;  // without occlusion its pose is enough
        if (occlusion) seen = camera.views.load_points(view);
        seen.rig_from_object = camera.views.rig_from_object(view);
        const Observer observer{
            std::move(seen), FastCameraModel(camera.camera), camera.camera.focal_px.x(), occlusion};
        interruptible_chunks(vertices.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            if (wanted[i] == 0) continue;
            const std::size_t vertex = vertices[i];
            weights(static_cast<Eigen::Index>(view), static_cast<Eigen::Index>(i)) +=
                static_cast<float>(observer.weight_at(mesh.vertices_mm[vertex].cast<double>(),
                                                      mesh.normals[vertex].cast<double>()));
          }
        });
      }
    }
  };
  std::vector<char> wanted(vertices.size(), 1);
  add(true, wanted);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    wanted[i] = weights.col(static_cast<Eigen::Index>(i)).sum() > 0.0F ? 0 : 1;
  if (std::find(wanted.begin(), wanted.end(), 1) != wanted.end()) add(false, wanted);
  for (Eigen::Index i = 0; i < weights.cols(); ++i) {
    const float sum = weights.col(i).sum();
    if (sum > 0.0F) weights.col(i) /= sum;
  }
  return weights;
}

}  // namespace frangia
