#include "frangia/simulate/internal/gather_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "frangia/core/angles.h"
#include "frangia/geometry/cosine_cells.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/projected_light.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Cells of the hemisphere.
constexpr int kBounceRings = 16;
constexpr int kBounceSectors = 24;

/// Rings of the two exponentials of the diffusion profile, which hold 1/4 and 3/4 of the light.
constexpr int kNearRings = 4;
constexpr int kFarRings = 12;
constexpr int kCellSectors = 12;

/// An extent over which every fringe averages out.
constexpr float kWide = 1e6F;

/// The tangent plane of a point.
struct TangentFrame {
  explicit TangentFrame(const Vector3d& normal)
      : u(normal.unitOrthogonal()), v(normal.cross(u)), n(normal) {}
  [[nodiscard]] Vector3d at(double radius, double angle, double height) const {
    return radius * (std::cos(angle) * u + std::sin(angle) * v) + height * n;
  }
  Vector3d u;
  Vector3d v;
  Vector3d n;
};

/// Collects the cells of one point.
class Gatherer {
 public:
  Gatherer(const SimulatedScene& scene, const Eigen::Isometry3d& rig_from_object)
      : scene_(scene),
        rig_from_object_(rig_from_object),
        object_from_rig_(rig_from_object.inverse()) {}

  /// What the camera sees along a ray.
  [[nodiscard]] std::optional<SurfacePoint> seen_along(const Vector2d& ray) const {
    return find_surface_point(
        scene_, object_from_rig_.translation(), object_from_rig_.linear() * ray.homogeneous());
  }

  void add_bounce(const SurfacePoint& to, double turn, std::vector<GatheredLight>& out) const {
    const Vector3d origin = to.off_surface();
    const double share =
        scene_.options.albedo * static_cast<double>(to.albedo) / (kBounceRings * kBounceSectors);
    for (const CosineCell& cell : cosine_cells(to.normal, kBounceRings, kBounceSectors, turn)) {
      if (to.face_normal.dot(cell.center) <= 0.0) continue;  // below the triangle
      const auto from = find_surface_point(scene_, origin, cell.center);
      if (!from) continue;
      // Where another direction meets the plane of the lit triangle.
      const double height = from->face_normal.dot(from->point_mm - origin);
      const auto meet = [&](const Vector3d& other) -> std::optional<Vector3d> {
        const double slope = from->face_normal.dot(other);
        if (slope >= -1e-6) return std::nullopt;
        return origin + height / slope * other;
      };
      const auto& [across, along] = cell.sides;
      add_cell(*from,
               share,
               {{{meet(across[0]), meet(across[1])}, {meet(along[0]), meet(along[1])}}},
               out);
    }
  }

  void add_scattering(const SurfacePoint& to, double turn, std::vector<GatheredLight>& out) const {
    // The mean distance of the profile is 2.5 of its parameter.
    const double near_mm = scene_.options.subsurface_mm / 2.5;
    add_exponential(to, turn, {near_mm, 0.25, kNearRings}, out);
    add_exponential(to, turn, {3.0 * near_mm, 0.75, kFarRings}, out);
  }

 private:
  /// One exponential of the profile: exp(-r / length) / (2 pi r length).
  struct Exponential {
    double length_mm;
    double share;
    int rings;
  };
  using Sides = std::array<std::array<std::optional<Vector3d>, 2>, 2>;

  static double turned(double turn, int ring) {
    const double golden = turn + 0.6180339887498949 * ring;
    return golden - std::floor(golden);
  }

  void add_exponential(const SurfacePoint& to,
                       double turn,
                       const Exponential& profile,
                       std::vector<GatheredLight>& out) const {
    const TangentFrame frame(to.face_normal);
    const double share = profile.share / (profile.rings * kCellSectors);
    const auto radius = [&](double ring) {
      return -profile.length_mm * std::log(1.0 - ring / profile.rings);
    };
    // Scattered light crosses edges and steps as deep as its length.
    const double depth_mm = 3.0 * profile.length_mm;
    for (int ring = 0; ring < profile.rings; ++ring) {
      const bool last = ring + 1 == profile.rings;
      const double inner = radius(ring);
      const double middle = radius(ring + 0.5);
      const double outer = last ? 2.0 * middle - inner : radius(ring + 1.0);
      for (int sector = 0; sector < kCellSectors; ++sector) {
        const double angle = kTwoPi * (sector + turned(turn, ring)) / kCellSectors;
        const Vector3d above = to.point_mm + frame.at(middle, angle, depth_mm);
        const auto from = find_surface_point(scene_, above, -frame.n);
        if (!from || from->distance > 2.0 * depth_mm) continue;
        const Vector3d radial = frame.at(1.0, angle, 0.0);
        const Vector3d around = frame.n.cross(radial);
        const auto beside = [&](const Vector3d& step) -> std::optional<Vector3d> {
          const double slope = from->face_normal.dot(frame.n);
          if (slope <= 1e-3) return std::nullopt;
          return from->point_mm + step - from->face_normal.dot(step) / slope * frame.n;
        };
        const double half_arc = middle * kPi / kCellSectors;
        add_cell(*from,
                 share,
                 {{{beside((inner - middle) * radial), beside((outer - middle) * radial)},
                   {beside(-half_arc * around), beside(half_arc * around)}}},
                 out);
      }
    }
  }

  /// Adds the light that a cell around a surface point receives; `sides` are the middles of its
  /// edges, missing where they lie at infinity.
  void add_cell(const SurfacePoint& from,
                double share,
                const Sides& sides,
                std::vector<GatheredLight>& out) const {
    const Vector3d in_rig = rig_from_object_ * from.point_mm;
    const LightSample light = light_on(scene_, object_from_rig_, from, in_rig);
    if (light.diffuse <= 0.0F) return;
    GatheredLight cell;
    cell.at = {light.u, light.v};
    double across_sheet_mm = 0.0;  // squared extent
    for (std::size_t k = 0; k < 2; ++k) {
      cell.side[k].setConstant(kWide);
      if (!sides[k][0] || !sides[k][1]) continue;
      const Vector3d low = rig_from_object_ * *sides[k][0];
      const Vector3d high = rig_from_object_ * *sides[k][1];
      const auto from_px = projector_coordinate(scene_.rig.projector, low);
      const auto to_px = projector_coordinate(scene_.rig.projector, high);
      if (from_px && to_px) cell.side[k] = (*to_px - *from_px).cast<float>();
      if (scene_.rig.laser_sheet)
        across_sheet_mm += std::pow(scene_.rig.laser_sheet->normal.dot(high - low), 2);
    }
    cell.diffuse = static_cast<float>(share) * light.diffuse;
    if (scene_.rig.laser_sheet) {
      // The sheet averaged over the cell: a Gaussian widened by the variance of a uniform density.
      const double own = scene_.options.line_sigma_mm * scene_.options.line_sigma_mm;
      const double wide = own + across_sheet_mm / 12.0;
      const double off =
          scene_.rig.laser_sheet->normal.dot(in_rig) - scene_.rig.laser_sheet->offset_mm;
      cell.line = static_cast<float>(std::sqrt(own / wide) * std::exp(-0.5 * off * off / wide));
    }
    out.push_back(cell);
  }

  const SimulatedScene& scene_;
  Eigen::Isometry3d rig_from_object_;
  Eigen::Isometry3d object_from_rig_;
};

}  // namespace

std::vector<GatheredLight> gather_light(const SimulatedScene& scene,
                                        const Eigen::Isometry3d& rig_from_object,
                                        const Vector2d& ray,
                                        double turn) {
  std::vector<GatheredLight> out;
  const SimulateOptions& options = scene.options;
  if (options.bounces == 0 && options.subsurface_mm == 0.0) return out;
  const Gatherer gatherer(scene, rig_from_object);
  const auto seen = gatherer.seen_along(ray);
  if (!seen) return out;
  if (options.bounces > 0) gatherer.add_bounce(*seen, turn, out);
  if (options.subsurface_mm > 0.0) gatherer.add_scattering(*seen, turn, out);
  return out;
}

double total_light(const std::vector<GatheredLight>& cells) {
  double total = 0.0;
  for (const GatheredLight& cell : cells)
    total += static_cast<double>(cell.diffuse);
  return total;
}

namespace {

/// Mean of a fringe over an extent, relative to its amplitude.
double mean_over(double extent_rad) {
  const double half = 0.5 * extent_rad;
  return std::abs(half) < 1e-4 ? 1.0 : std::sin(half) / half;
}

}  // namespace

GatheredLightSum::GatheredLightSum(const Pattern& pattern,
                                   const std::vector<Shot>& shots,
                                   const SimulatedScene& scene)
    : pattern_(pattern),
      shots_(shots),
      scene_(scene),
      is_fringe_(pattern.kind == PatternKind::Fringe && shots.front().picture == nullptr) {
  if (!is_fringe_) return;
  constexpr int kPhases = 64;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = kTwoPi * i / kPhases;
    const auto fringe = std::polar(1.0, phase);
    const double shown = shown_fringe(fringe, pattern.period_px, scene);
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      amplitudes_[h] +=
          (h == 0 ? 1.0 : 2.0) / kPhases * shown * std::cos(static_cast<double>(h) * phase);
    }
  }
}

void GatheredLightSum::add_to(std::vector<double>& light,
                              std::span<const GatheredLight> cells) const {
  if (cells.empty()) return;
  if (is_fringe_) {
    add_fringes(light, cells);
    return;
  }
  for (const GatheredLight& cell : cells) {
    const double reflected = scene_.exposure * static_cast<double>(cell.diffuse);
    if (pattern_.kind == PatternKind::Line) {
      const double peak = (1.0 + scene_.options.contrast) * shots_.front().projector;
      light[0] +=
          reflected * peak * std::max(static_cast<double>(cell.line), scene_.options.line_spill);
      continue;
    }
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] +=
          shots_[i].projector * reflected *
          frame_light(pattern_, static_cast<int>(i), cell.at.cast<double>(), shots_[i], scene_);
    }
  }
}

void GatheredLightSum::add_fringes(std::vector<double>& light,
                                   std::span<const GatheredLight> cells) const {
  std::array<std::complex<double>, kHarmonics> sums{};
  for (const GatheredLight& cell : cells) {
    const auto weight = static_cast<double>(cell.diffuse);
    const double phase = phase_at(pattern_, cell.at.cast<double>());
    const double side0 = phase_at(pattern_, cell.side[0].cast<double>());
    const double side1 = phase_at(pattern_, cell.side[1].cast<double>());
    sums[0] += weight;
    for (std::size_t h = 1; h < kHarmonics; ++h) {
      if (std::abs(amplitudes_[h]) < 1e-12) continue;
      const auto order = static_cast<double>(h);
      sums[h] += weight * mean_over(order * side0) * mean_over(order * side1) *
                 std::polar(1.0, order * phase);
    }
  }
  for (std::size_t i = 0; i < light.size(); ++i) {
    const std::complex<double> shift(shots_[i].cos_shift, shots_[i].sin_shift);
    std::complex<double> turn = 1.0;
    double shown = 0.0;
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      shown += amplitudes_[h] * (sums[h] * turn).real();
      turn *= shift;
    }
    light[i] += shots_[i].projector * scene_.exposure * shown;
  }
}

}  // namespace frangia
