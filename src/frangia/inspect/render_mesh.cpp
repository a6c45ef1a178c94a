#include "frangia/inspect/render_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/geometry/corner_normals.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/internal/viewpoint.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSkyRays = 4;  ///< a sample

struct Light {
  Vector3d direction;  ///< towards it, in the viewer's frame: x right, y up, z towards the viewer
  Vector3d color;
  double spread;  ///< softness of its shadow
};

const std::array<Light, 3>& lights() {
  static const std::array<Light, 3> three{
      {{Vector3d(-0.72, 0.70, 0.50).normalized(), Vector3d(0.80, 0.765, 0.71), 0.12},
       {Vector3d(0.80, 0.22, 0.55).normalized(), Vector3d(0.11, 0.13, 0.17), 0.25},
       {Vector3d(0.45, 0.55, -0.75).normalized(), Vector3d(0.30, 0.32, 0.36), 0.15}}};
  return three;
}

/// The background: a light gradient, brighter behind the part.
Vector3d backdrop(double x, double y) {
  const double halo = std::exp(-0.55 * (x * x + (y - 0.15) * (y - 0.15)));
  const double height = std::clamp(0.5 + 0.5 * y, 0.0, 1.0);
  return Vector3d(0.44, 0.465, 0.50) + halo * Vector3d(0.40, 0.395, 0.38) +
         0.05 * height * Vector3d::Ones();
}

/// Points of the unit square that fill it evenly, shifted by another random amount at each pixel.
/// source  the R2 sequence, Roberts 2018
struct SampleSequence {
  std::uint64_t pixel;
  std::size_t sample;  ///< of the pixel

  /// Point i of the `count` that each sample needs for one use.
  [[nodiscard]] Eigen::Vector2d point(std::size_t use, std::size_t i, std::size_t count) const {
    const auto place = static_cast<double>(sample * count + i + 1);
    const std::uint64_t stream = hash(pixel, use);
    const Eigen::Vector2d shift(uniform_from(hash(stream, 1)), uniform_from(hash(stream, 2)));
    const Eigen::Vector2d p =
        shift + place * Eigen::Vector2d(0.7548776662466927, 0.5698402909980532);
    return p - Eigen::Vector2d(p.array().floor());
  }
};

/// A direction of the hemisphere about n, more often near n: a diffuse surface's view of the sky.
Vector3d sky_direction(const Vector3d& n, const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const double out2 = point.y();
  const Vector3d u = n.unitOrthogonal();
  return std::sqrt(out2) * (std::cos(around) * u + std::sin(around) * n.cross(u)) +
         std::sqrt(1.0 - out2) * n;
}

/// A light's direction, moved about within its disc.
Vector3d light_direction(const Viewpoint& viewpoint,
                         const Light& light,
                         const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const Vector3d u = light.direction.unitOrthogonal();
  const Vector3d off = std::cos(around) * u + std::sin(around) * light.direction.cross(u);
  return viewpoint.axes.transpose() *
         (light.direction + light.spread * std::sqrt(point.y()) * off).normalized();
}

class Renderer {
 public:
  Renderer(const Mesh& mesh, const RenderOptions& options)
      : options_(options),
        scene_(mesh),
        normals_(corner_normals(mesh, options.crease_rad)),
        viewpoint_(fit_viewpoint(mesh, options)) {
    Eigen::AlignedBox3d box;
    for (const auto& vertex : mesh.vertices_mm)
      box.extend(vertex.cast<double>());
    size_mm_ = box.diagonal().norm();
    ground_z_ = box.min().z();
  }

  /// The light from one place of the picture.
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
  /// Far enough off a surface to leave it, and far enough away to be out of everything.
  [[nodiscard]] double near_mm() const { return 1e-4 * size_mm_; }
  [[nodiscard]] bool blocked(const Vector3d& from, const Vector3d& direction, double reach) const {
    return scene_.occluded(from + near_mm() * direction, from + reach * size_mm_ * direction);
  }

  [[nodiscard]] double ground_light(const Vector3d& place, const SampleSequence& sequence) const {
    double sky = 0.0;
    for (std::size_t i = 0; i < kSkyRays; ++i) {
      const Vector3d way = sky_direction(Vector3d::UnitZ(), sequence.point(0, i, kSkyRays));
      if (!blocked(place, way, 2.0)) sky += 1.0 / kSkyRays;
    }
    const bool lit =
        !blocked(place, light_direction(viewpoint_, lights()[0], sequence.point(1, 0, 1)), 3.0);
    return 0.36 + 0.48 * sky + (lit ? 0.16 : 0.0);
  }

  [[nodiscard]] Vector3d base_color(const RayHit& hit, bool inside) const {
    if (inside) return {0.62, 0.20, 0.13};
    if (!options_.highlighted.empty() && options_.highlighted[hit.triangle] != 0)
      return {0.46, 0.13, 0.62};
    if (options_.show_marks && mark_of(scene_.mesh(), hit.triangle) != Mark::Measured) {
      const bool moved = mark_of(scene_.mesh(), hit.triangle) == Mark::Displaced;
      return moved ? Vector3d(0.80, 0.58, 0.12) : Vector3d(0.12, 0.36, 0.72);
    }
    if (options_.values.empty()) return {0.80, 0.775, 0.74};
    float value = 0.0F;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      value += static_cast<float>(hit.barycentric[static_cast<Eigen::Index>(corner)]) *
               options_.values[scene_.mesh().triangles[hit.triangle][corner]];
    }
    const float share = (value - options_.value_min) / (options_.value_max - options_.value_min);
    // Maps are made for the screen; light adds up in its square.
    return color_of(options_.color_map, share).cast<double>().array().pow(2.2);
  }

  /// What a line along the triangle's edges leaves of the light, 1 away from them. Where triangles
  /// are hardly larger than the line it fades.
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
    const Vector3d place =
        ray.origin + hit.distance * ray.direction + side * near_mm() * hit.normal;

    Vector3d sky = Vector3d::Zero();
    for (std::size_t i = 0; i < kSkyRays; ++i) {
      const Vector3d way = sky_direction(normal, sequence.point(0, i, kSkyRays));
      if (blocked(place, way, 0.6)) continue;
      const double up = 0.5 + 0.5 * way.z();
      sky += (0.10 + 0.26 * up) * Vector3d(0.97, 0.99, 1.03) / kSkyRays;
    }
    // No sky reaches the inside of a nearly closed mesh: let it glow enough to be seen.
    Vector3d diffuse = inside ? Vector3d(sky + Vector3d::Constant(0.45)) : sky;
    double gloss = 0.0;
    for (std::size_t i = 0; i < lights().size(); ++i) {
      const Light& light = lights()[i];
      const Vector3d way = light_direction(viewpoint_, light, sequence.point(1 + i, 0, 1));
      const double cosine = normal.dot(way);
      if (cosine <= 0.0 || blocked(place, way, 3.0)) continue;
      diffuse += cosine * light.color;
      const Vector3d halfway = (way - ray.direction).normalized();
      gloss += 0.10 * light.color.mean() * std::pow(std::max(normal.dot(halfway), 0.0), 36.0);
    }
    return edge_light(hit) * base_color(hit, inside).cwiseProduct(diffuse) +
           gloss * Vector3d::Ones();
  }

  const RenderOptions& options_;
  RayScene scene_;
  std::vector<std::array<Eigen::Vector3f, 3>> normals_;
  Viewpoint viewpoint_;
  double size_mm_ = 0.0;
  double ground_z_ = 0.0;
};

/// Linear light to the screen's values; highlights roll off instead of clipping.
Rgb screen_color(const Vector3d& light) {
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = light[static_cast<Eigen::Index>(i)];
    const double soft = value < 0.8 ? value : 1.0 - 0.2 * std::exp(-(value - 0.8) / 0.2);
    color[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(soft, 1.0 / 2.2)));
  }
  return color;
}

}  // namespace

Image<Rgb> render_mesh(const Mesh& mesh, const RenderOptions& options, const Run& run) {
  require(!mesh.empty(),
          "the mesh has no triangles to draw, only points; give a mesh with triangles");
  require(options.width_px > 0 && options.height_px > 0 && options.samples_across > 0,
          "render_mesh: the picture needs a width, a height and samples above 0");
  require(options.values.empty() || options.values.size() == mesh.vertices_mm.size(),
          "render_mesh: there must be one value a vertex");
  require(options.highlighted.empty() || options.highlighted.size() == mesh.triangles.size(),
          "render_mesh: there must be one highlight a triangle");
  const Renderer renderer(mesh, options);
  Image<Rgb> picture(options.width_px, options.height_px);
  const double half = 0.5 * std::min(options.width_px, options.height_px);
  const int across = options.samples_across;

  const auto paint_row = [&](int y) {
    for (int x = 0; x < options.width_px; ++x) {
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
  constexpr int kBand = 32;  // rows between two looks at whether to stop
  for (int done = 0; done < options.height_px; done += kBand) {
    const int size = std::min(kBand, options.height_px - done);
    parallel_rows(size, [&](int row) { paint_row(done + row); });
    run.report(static_cast<double>(done + size) / options.height_px);
  }
  return picture;
}

}  // namespace frangia
