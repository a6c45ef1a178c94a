#include "frangia/simulate/internal/light_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/rig/board.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {
namespace {

/// Reflectance of a printed board at a point of its plane, relative to the middle of its grid.
///
/// @units    mm; 1 is white paper
double board_albedo(const Board& board, const Eigen::Vector2d& point_mm) {
  constexpr double kInk = 0.06;  // reflectance of black laser print
  const Eigen::Vector2d half =
      0.5 * board.square_mm * Eigen::Vector2d(board.columns - 1, board.rows - 1);
  return is_printed_black(board, point_mm + half) ? kInk : 1.0;
}

using Eigen::Vector3d;

double lattice_value(const Eigen::Vector3i& cell) {
  std::uint64_t stream = 0x7E47;
  for (const int coordinate : cell)
    stream = hash(stream, static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)));
  return uniform_from(stream);
}

/// Smooth patches between 0 and 1, about `size_mm` across (value noise).
double value_noise(const Vector3d& position_mm, double size_mm) {
  const Vector3d p = position_mm / size_mm;
  const Vector3d low = p.array().floor();
  const Vector3d f = p - low;
  const Vector3d s = f.array().square() * (3.0 - 2.0 * f.array());
  double value = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3i step(i & 1, (i >> 1) & 1, i >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      weight *= step[axis] == 1 ? s[axis] : 1.0 - s[axis];
    value += weight * lattice_value(low.cast<int>() + step);
  }
  return value;
}

double albedo_at(const Vector3d& position_mm, const SimulatedScene& scene) {
  if (scene.options.board) {
    constexpr double kFace_mm = 0.01;
    const Vector3d point = scene.part_from_object * position_mm;
    return std::abs(point.z()) < kFace_mm ? board_albedo(*scene.options.board, point.head<2>())
                                          : 1.0;
  }
  if (!scene.options.stickers.empty()) {
    const double albedo = sticker_albedo(
        scene.options.targets, scene.options.stickers, scene.part_from_object * position_mm);
    if (!std::isnan(albedo)) return albedo;
  }
  if (scene.options.checker_mm > 0.0) {
    constexpr double kDark = 0.10;
    constexpr double kBright = 0.85;
    const Vector3d cell =
        (scene.part_from_object * position_mm / scene.options.checker_mm).array().floor();
    return static_cast<std::int64_t>(cell.sum()) % 2 == 0 ? kBright : kDark;
  }
  const double texture = scene.options.texture;
  if (texture == 0.0) return 1.0;
  return 1.0 -
         texture * (0.65 * value_noise(position_mm, 14.0) + 0.35 * value_noise(position_mm, 5.0));
}

/// Projects a point of the rig frame into the projector; false outside of its field.
bool set_projector_coordinate(const Projector& projector,
                              const Vector3d& point,
                              LightSample& sample) {
  const Vector3d p = projector.from_rig(point);
  if (const auto* pinhole = std::get_if<PinholeModel>(&projector.model)) {
    if (p.z() <= 0.0) return false;
    const Eigen::Vector2d pixel = pinhole->project(p);
    sample.u = static_cast<float>(pixel.x());
    sample.v = static_cast<float>(pixel.y());
    return pixel.minCoeff() >= -0.5 && pixel.x() <= pinhole->width_px - 0.5 &&
           pixel.y() <= pinhole->height_px - 0.5;
  }
  const auto& field = std::get<AngularModel>(projector.model);
  const double psi = std::atan2(p.x(), p.z());
  sample.u = static_cast<float>(deg_from_rad(field.fringe_angle_rad(p)));
  return psi >= field.field_min_rad && psi <= field.field_max_rad;
}

Vector3d shading_normal(const SimulatedScene& scene, const RayHit& hit) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    normal += hit.barycentric[static_cast<Eigen::Index>(corner)] *
              scene.normals[hit.triangle][corner].cast<double>();
  }
  return normal.squaredNorm() > 0.0 ? normal.normalized() : hit.normal;
}

/// The light of a monitor, which shines evenly in all directions; none outside its pixels.
LightSample screen_light(const Screen& screen, const Vector3d& point) {
  constexpr double kFace_mm = 0.01;
  LightSample sample;
  sample.albedo = 1.0F;
  sample.u = static_cast<float>(point.x() / screen.pixel_mm + 0.5 * (screen.width_px - 1));
  sample.v = static_cast<float>(point.y() / screen.pixel_mm + 0.5 * (screen.height_px - 1));
  const bool shows = std::abs(point.z()) < kFace_mm && std::min(sample.u, sample.v) >= -0.5F &&
                     sample.u <= static_cast<float>(screen.width_px) - 0.5F &&
                     sample.v <= static_cast<float>(screen.height_px) - 0.5F;
  sample.diffuse = shows ? 1.0F : 0.0F;
  return sample;
}

}  // namespace

std::optional<SurfacePoint> find_surface_point(const SimulatedScene& scene,
                                               const Vector3d& origin,
                                               const Vector3d& direction) {
  const auto hit = scene.surface.first_hit(origin, direction);
  if (!hit) return std::nullopt;
  // An open mesh is a thin shell: it shows the side that is looked at.
  const double side = hit->normal.dot(direction) > 0.0 ? -1.0 : 1.0;
  SurfacePoint found;
  found.point_mm = origin + hit->distance * direction;
  found.face_normal = side * hit->normal;
  found.normal = side * shading_normal(scene, *hit);
  found.albedo = static_cast<float>(albedo_at(found.point_mm, scene));
  found.distance = hit->distance;
  if (scene.options.color > 0.0) {
    const Vector3d color =
        surface_color(scene.part_from_object * found.point_mm, scene.options.color);
    const double grey = luminance_of_color(color);
    found.albedo *= static_cast<float>(grey);
    for (std::size_t channel = 0; channel < found.tint.size(); ++channel)
      found.tint.at(channel) = static_cast<float>(color[static_cast<Eigen::Index>(channel)] / grey);
  }
  return found;
}

std::optional<Eigen::Vector2d> projector_coordinate(const Projector& projector,
                                                    const Vector3d& point) {
  LightSample sample;
  const Vector3d p = projector.from_rig(point);
  if (p.z() <= 0.0) return std::nullopt;
  set_projector_coordinate(projector, point, sample);
  return Eigen::Vector2d(sample.u, sample.v);
}

LightSample light_on(const SimulatedScene& scene,
                     const Eigen::Isometry3d& object_from_rig,
                     const SurfacePoint& on,
                     const Vector3d& in_rig) {
  LightSample sample;
  sample.albedo = on.albedo;
  sample.tint = on.tint;
  if (!set_projector_coordinate(scene.rig.projector, in_rig, sample)) return sample;
  const Vector3d light = object_from_rig * scene.rig.projector.position_mm;
  const Vector3d to_light = light - on.point_mm;
  const double distance = to_light.norm();
  const double cosine = on.normal.dot(to_light / distance);
  if (cosine <= 0.0 || on.face_normal.dot(to_light) <= 0.0) return sample;
  if (scene.surface.occluded(on.off_surface(), light)) return sample;

  const double nearness = scene.working_distance_mm / distance;
  sample.diffuse = static_cast<float>(nearness * nearness * cosine) * sample.albedo;
  if (scene.rig.laser_sheet) {
    const double off =
        (scene.rig.laser_sheet->normal.dot(in_rig) - scene.rig.laser_sheet->offset_mm) /
        scene.options.line_sigma_mm;
    sample.line = static_cast<float>(std::exp(-0.5 * off * off));
  }
  return sample;
}

LightSample sample_light(const SimulatedScene& scene,
                         const Eigen::Isometry3d& rig_from_object,
                         const Eigen::Vector2d& ray) {
  const Eigen::Isometry3d object_from_rig = rig_from_object.inverse();
  const Vector3d direction = object_from_rig.linear() * ray.homogeneous();
  const auto on = find_surface_point(scene, object_from_rig.translation(), direction);
  if (!on) return {};
  if (scene.options.screen)
    return screen_light(*scene.options.screen, scene.part_from_object * on->point_mm);
  const Vector3d seen = on->distance * ray.homogeneous();  // in the rig frame, exactly
  LightSample sample = light_on(scene, object_from_rig, *on, seen);
  if (sample.diffuse > 0.0F && scene.options.gloss > 0.0) {
    const Vector3d to_light = object_from_rig * scene.rig.projector.position_mm - on->point_mm;
    const double nearness = scene.working_distance_mm / to_light.norm();
    const Vector3d halfway = (to_light.normalized() - direction.normalized()).normalized();
    sample.glossy = static_cast<float>(
        nearness * nearness * scene.options.gloss *
        std::pow(std::max(on->normal.dot(halfway), 0.0), scene.options.shininess));
  }
  return sample;
}

}  // namespace frangia
