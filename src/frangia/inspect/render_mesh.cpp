#include "frangia/inspect/render_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/corner_normals.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/internal/shading.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSkyRays = 4;  ///< per sample of a pixel

class Renderer {
 public:
  Renderer(const Mesh& mesh, const RenderOptions& options, const Run& run)
      : options_(options),
        scene_(mesh, run),
        normals_(corner_normals(mesh, options.crease_rad)),
        viewpoint_(fit_viewpoint(mesh, options)) {
    Eigen::AlignedBox3d box;
    for (const auto& vertex : mesh.vertices_mm)
      box.extend(vertex.cast<double>());
    size_mm_ = box.diagonal().norm();
    ground_z_ = box.min().z();
  }

  /// The light from one position in the picture.
  [[nodiscard]] Vector3d color_at(double x, double y, const SampleSequence& sequence) const {
    const Viewpoint::Ray ray = viewpoint_.ray(x, y);
    if (const auto hit = scene_.first_hit(ray.origin, ray.direction)) {
      return surface_color(ray, *hit, sequence);
    }
    Vector3d behind = backdrop(x, y);
    if (!options_.ground || options_.elevation_rad <= 0.0 || ray.direction.z() > -1e-3)
      return behind;
    const double along = (ground_z_ - ray.origin.z()) / ray.direction.z();
    return behind * ground_light(ray.origin + along * ray.direction, sequence);
  }

 private:
  /// Offset of rays from the surface that they leave.
  [[nodiscard]] double near_mm() const { return 1e-4 * size_mm_; }
  [[nodiscard]] bool blocked(const Vector3d& from, const Vector3d& direction, double reach) const {
    return scene_.occluded(from + near_mm() * direction, from + reach * size_mm_ * direction);
  }

  [[nodiscard]] double ground_light(const Vector3d& point, const SampleSequence& sequence) const {
    double sky = 0.0;
    for (std::size_t i = 0; i < kSkyRays; ++i) {
      const Vector3d toward = sky_direction(Vector3d::UnitZ(), sequence.point(0, i, kSkyRays));
      if (!blocked(point, toward, 2.0)) sky += 1.0 / kSkyRays;
    }
    const bool lit =
        !blocked(point, light_direction(viewpoint_, lights()[0], sequence.point(1, 0, 1)), 3.0);
    return 0.36 + 0.48 * sky + (lit ? 0.16 : 0.0);
  }

  /// Factor that darkens the edges of triangles; 1 away from edges. The lines fade where triangles
  /// are hardly larger than the line.
  [[nodiscard]] double edge_light(const RayHit& hit) const {
    if (!options_.show_edges) return 1.0;
    const Mesh& mesh = scene_.mesh();
    const auto& [ia, ib, ic] = mesh.triangles[hit.triangle];
    const Vector3d a = mesh.vertices_mm[ia].cast<double>();
    const Vector3d b = mesh.vertices_mm[ib].cast<double>();
    const Vector3d c = mesh.vertices_mm[ic].cast<double>();
    const double twice = (b - a).cross(c - a).norm();
    const Vector3d heights(twice / (c - b).norm(), twice / (a - c).norm(), twice / (b - a).norm());
    const double pixel_mm = 1.1 * size_mm_ / std::min(options_.width_px, options_.height_px);
    if (hit.barycentric.cwiseProduct(heights).minCoeff() > 0.6 * pixel_mm) return 1.0;
    return 1.0 - 0.7 * std::clamp(heights.minCoeff() / (8.0 * pixel_mm), 0.0, 1.0);
  }

  [[nodiscard]] Vector3d shading_normal(const RayHit& hit) const {
    Vector3d normal = Vector3d::Zero();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      normal += hit.barycentric[static_cast<Eigen::Index>(corner)] *
                normals_[hit.triangle][corner].cast<double>();
    }
    return normal.squaredNorm() > 0.0 ? normal.normalized() : hit.normal;
  }

  [[nodiscard]] Vector3d surface_color(const Viewpoint::Ray& ray,
                                       const RayHit& hit,
                                       const SampleSequence& sequence) const {
    const bool inside = hit.normal.dot(ray.direction) > 0.0;
    const double side = inside ? -1.0 : 1.0;
    const Vector3d normal = side * shading_normal(hit);
    const Vector3d point =
        ray.origin + hit.distance * ray.direction + side * near_mm() * hit.normal;

    Vector3d sky = Vector3d::Zero();
    for (std::size_t i = 0; i < kSkyRays; ++i) {
      const Vector3d toward = sky_direction(normal, sequence.point(0, i, kSkyRays));
      if (blocked(point, toward, 0.6)) continue;
      const double up = 0.5 + 0.5 * toward.z();
      sky += (0.10 + 0.26 * up) * Vector3d(0.97, 0.99, 1.03) / kSkyRays;
    }
    // No sky light reaches the inside of a nearly closed mesh, so it gets a constant part.
    Vector3d diffuse = inside ? Vector3d(sky + Vector3d::Constant(0.45)) : sky;
    double gloss = 0.0;
    for (std::size_t i = 0; i < lights().size(); ++i) {
      const Light& light = lights()[i];
      const Vector3d toward = light_direction(viewpoint_, light, sequence.point(1 + i, 0, 1));
      const double cosine = normal.dot(toward);
      if (cosine <= 0.0 || blocked(point, toward, 3.0)) continue;
      diffuse += cosine * light.color;
      const Vector3d halfway = (toward - ray.direction).normalized();
      gloss += 0.10 * light.color.mean() * std::pow(std::max(normal.dot(halfway), 0.0), 36.0);
    }
    const Vector3d base = inside ? inside_color() : front_color(scene_.mesh(), options_, hit);
    return edge_light(hit) * base.cwiseProduct(diffuse) + gloss * Vector3d::Ones();
  }

  const RenderOptions& options_;
  RayScene scene_;
  std::vector<std::array<Eigen::Vector3f, 3>> normals_;
  Viewpoint viewpoint_;
  double size_mm_ = 0.0;
  double ground_z_ = 0.0;
};

}  // namespace

Image<Rgb> render_mesh(const Mesh& mesh, const RenderOptions& options, const Run& run) {
  require(!mesh.empty(),
          "the mesh has no triangles to draw, only points; give a mesh with triangles");
  require(options.width_px > 0 && options.height_px > 0 && options.samples_across > 0,
          "the width, the height and the samples of a picture must be above 0");
  require(options.values.empty() || options.values.size() == mesh.vertices_mm.size(),
          "a picture needs one value per vertex");
  require(options.highlighted.empty() || options.highlighted.size() == mesh.triangles.size(),
          "a picture needs one highlight per triangle");
  const Renderer renderer(mesh, options, run);
  Image<Rgb> picture(options.width_px, options.height_px);
  const double half = 0.5 * std::min(options.width_px, options.height_px);
  const int across = options.samples_across;

  const auto paint_row = [&](int y) {
    for (int x = 0; x < options.width_px; ++x) {
      if (run.stop.stop_requested()) return;
      Vector3d sum = Vector3d::Zero();
      for (int sample = 0; sample < across * across; ++sample) {
        const int row = sample / across;
        const double sx = x + (sample - row * across + 0.5) / across;
        const double sy = y + (row + 0.5) / across;
        const auto pixel = static_cast<std::uint64_t>(y) * 65536U + static_cast<std::uint64_t>(x);
        sum += renderer.color_at((sx - 0.5 * options.width_px) / half,
                                 (0.5 * options.height_px - sy) / half,
                                 {pixel, static_cast<std::size_t>(sample)});
      }
      picture(x, y) = screen_color(sum / (across * across));
    }
  };
  constexpr int kBand = 32;  // rows between two reports of progress
  for (int done = 0; done < options.height_px; done += kBand) {
    const int size = std::min(kBand, options.height_px - done);
    parallel_rows(size, [&](int row) { paint_row(done + row); });
    run.report(static_cast<double>(done + size) / options.height_px);
  }
  return options.legend ? add_legend(picture, surface_legend(mesh, options)) : picture;
}

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The position in halves of the shorter side from the centre: the inverse of `Viewpoint::ray`.
Vector2d projected(const Viewpoint& viewpoint, const Vector3d& point) {
  const Vector3d seen = viewpoint.axes * (point - viewpoint.target);
  const double nearer =
      viewpoint.perspective ? viewpoint.distance / (viewpoint.distance - seen.z()) : 1.0;
  return seen.head<2>() * nearer / viewpoint.scale;
}

}  // namespace

std::vector<std::optional<Vector2d>> picture_positions(const RayScene& mesh,
                                                       const RenderOptions& options,
                                                       const std::vector<PicturedPlace>& places) {
  constexpr double kLeastCosine = 0.1;
  constexpr double kNear = 0.01;  // of the size: a place need not lie on the measured surface
  const Viewpoint viewpoint = fit_viewpoint(mesh.mesh(), options);
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.mesh().vertices_mm)
    box.extend(vertex.cast<double>());
  const double near_mm = kNear * box.diagonal().norm();
  const double half = 0.5 * std::min(options.width_px, options.height_px);
  std::vector<std::optional<Vector2d>> positions;
  for (const PicturedPlace& place : places) {
    positions.emplace_back();
    const Vector2d at = projected(viewpoint, place.point_mm);
    const Vector2d pixel(0.5 * options.width_px + half * at.x(),
                         0.5 * options.height_px - half * at.y());
    if (!(pixel.minCoeff() >= 0.0) || pixel.x() > options.width_px || pixel.y() > options.height_px)
      continue;
    const Viewpoint::Ray ray = viewpoint.ray(at.x(), at.y());
    if (place.normal.dot(ray.direction) > -kLeastCosine) continue;
    const double along = (place.point_mm - ray.origin).dot(ray.direction);
    if (mesh.first_hit(ray.origin, ray.direction, along - near_mm)) continue;
    positions.back() = pixel;
  }
  return positions;
}

}  // namespace frangia
