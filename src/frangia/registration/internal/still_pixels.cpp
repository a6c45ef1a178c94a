#include "frangia/registration/internal/still_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/angles.h"
#include "frangia/views/thin_view.h"

namespace frangia {
namespace {

struct StillLimits {
  double pixels = 12'000.0;                   ///< of a view: 2 mm apart over 200 mm
  std::size_t most_views = 24;                ///< that are compared, evenly picked
  double least_turn_rad = rad_from_deg(1.0);  ///< between two views that count as two
  float noises = 4.0F;                        ///< standard deviations within which depths are equal
  float relative_equal = 5e-4F;  ///< ... and this share of the distance: the light that the part
                                 ///< throws on a wall changes
  /// Three times the standard deviations that registration assumes of a turntable.
  double relative_axis = 3.0 * 0.004;
  double axis_rad = 3.0 * rad_from_deg(1.0);
  double angle_rad = 3.0 * rad_from_deg(0.2);
  double known = 0.5;  ///< share of the pixels about a place that must be measured, all beyond it
};
constexpr StillLimits kStillLimits;

/// How far a turned point may be from where the table states it.
double turned_within_mm(const Eigen::Vector3d& object, double depth_mm) {
  return kStillLimits.relative_axis * depth_mm + kStillLimits.axis_rad * object.norm() +
         kStillLimits.angle_rad * object.head<2>().norm();
}

/// What a view shows where the table turns a point to.
enum class AtPlace : std::uint8_t { Unknown, Something, SeenThrough, OutOfView };

AtPlace look_at(const Image<float>& depth_mm,
                const CameraModel& camera,
                const Eigen::Vector3d& place,
                double within_mm) {
  if (place.z() < 2.0 * within_mm) return AtPlace::OutOfView;
  const Eigen::Vector2d pixel = camera.project(place);
  const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < camera.width_px - 0.5 &&
                      pixel.y() < camera.height_px - 0.5;
  if (!inside) return AtPlace::OutOfView;
  const int reach = static_cast<int>(std::ceil(within_mm * camera.focal_px.x() / place.z()));
  const int column = static_cast<int>(std::lround(pixel.x()));
  const int row = static_cast<int>(std::lround(pixel.y()));
  const auto near_mm = static_cast<float>(place.z() - within_mm);
  const auto far_mm = static_cast<float>(place.z() + within_mm);
  bool hides = false;
  int farther = 0;
  for (int v = std::max(0, row - reach); v <= std::min(depth_mm.height() - 1, row + reach); ++v) {
    for (int u = std::max(0, column - reach); u <= std::min(depth_mm.width() - 1, column + reach);
         ++u) {
      const float z = depth_mm(u, v);
      if (z >= near_mm && z <= far_mm) return AtPlace::Something;
      hides = hides || z < near_mm;
      farther += z > far_mm ? 1 : 0;
    }
  }
  const double all = std::pow(2 * reach + 1, 2);
  return !hides && farther >= kStillLimits.known * all ? AtPlace::SeenThrough : AtPlace::Unknown;
}

}  // namespace

float equal_within_mm(float depth_mm, float sigma_mm) {
  return kStillLimits.noises * sigma_mm + kStillLimits.relative_equal * depth_mm;
}

ThinViews thin_views(const ViewStore& views,
                     const CameraModel& camera,
                     std::span<const int> setups) {
  ThinViews out;
  out.step_px = thinning_step(camera, kStillLimits.pixels);
  out.camera = thinned(camera, out.step_px);
  out.rays = every_nth_pixel(*views.rays(camera), out.step_px);
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool is_new = std::none_of(differing.begin(), differing.end(), [&](std::size_t j) {
      const Eigen::Isometry3d turn = views.rig_from_object(i) * views.rig_from_object(j).inverse();
      return setups[i] == setups[j] &&
             std::abs(Eigen::AngleAxisd(turn.linear()).angle()) < kStillLimits.least_turn_rad;
    });
    if (is_new) differing.push_back(i);
  }
  const std::size_t count = std::min(differing.size(), kStillLimits.most_views);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = differing[n * differing.size() / count];
    out.views.push_back(
        {thinned(views.load_points(i).range, out.step_px), views.rig_from_object(i), setups[i]});
  }
  return out;
}

void turn_into_views(const ThinViews& seen, int x, int y, StillPixel& at) {
  const Eigen::Vector3d point = seen.point(x, y, at.depth_mm);
  for (std::size_t k = 0; k < seen.views.size(); ++k) {
    if ((at.views >> k & 1U) == 0) continue;
    const ThinView& from = seen.views[k];
    const Eigen::Vector3d object = from.rig_from_object.inverse() * point;
    const double within_mm = turned_within_mm(object, at.depth_mm);
    for (const ThinView& to : seen.views) {
      if (&to == &from || to.setup != from.setup) continue;
      const AtPlace found =
          look_at(to.range.depth_mm, seen.camera, to.rig_from_object * object, within_mm);
      at.through += found == AtPlace::SeenThrough ? 1 : 0;
      at.support += found == AtPlace::Something ? 1 : 0;
      at.outside += found == AtPlace::OutOfView ? 1 : 0;
      ++at.turned;
    }
  }
}

StillPixel compare_views(const ThinViews& seen, int x, int y) {
  StillPixel best;
  int measured = 0;
  for (const ThinView& one : seen.views) {
    StillPixel at{.depth_mm = one.range.depth_mm(x, y)};
    if (std::isnan(at.depth_mm)) continue;
    ++measured;
    for (std::size_t k = 0; k < seen.views.size(); ++k) {
      const RangeGrid& other = seen.views[k].range;
      const float gap_mm = other.depth_mm(x, y) - at.depth_mm;
      if (std::isnan(gap_mm)) continue;
      const float noise_mm = std::hypot(one.range.sigma_mm(x, y), other.sigma_mm(x, y));
      if (std::abs(gap_mm) < equal_within_mm(at.depth_mm, noise_mm)) {
        at.views |= 1U << k;
        ++at.agree;
        at.sigma_mm = std::max(at.sigma_mm, other.sigma_mm(x, y));
      } else {
        at.nearer += gap_mm < 0.0F ? 1 : 0;
      }
    }
    const bool farther = at.agree == best.agree && at.depth_mm > best.depth_mm;
    if (at.agree > best.agree || farther) best = at;
  }
  const int beyond = measured - best.agree - best.nearer;
  best.stands = best.agree >= 2 && 4 * beyond <= best.agree;
  best.usual = best.stands && 2 * best.agree >= measured;
  if (best.stands) turn_into_views(seen, x, y, best);
  return best;
}

}  // namespace frangia
