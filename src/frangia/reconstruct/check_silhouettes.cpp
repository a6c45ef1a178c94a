#include "frangia/reconstruct/check_silhouettes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Light of part and background; the edge of the silhouette is at the middle.
struct BacklitLevels {
  double dark = 0.0;
  double lit = 0.0;
  [[nodiscard]] double middle() const { return 0.5 * (dark + lit); }
};

/// The levels of a view; none if its background is not lit.
std::optional<BacklitLevels> levels_of(const BacklitView& view) {
  std::vector<float> part;
  std::vector<float> beside;
  for (std::size_t i = 0; i < view.counts.pixels().size(); ++i) {
    const bool measured = !std::isnan(view.depth_mm.pixels()[i]);
    (measured ? part : beside).push_back(view.counts.pixels()[i]);
  }
  constexpr std::size_t kFewest = 200;  // pixels of each
  if (part.size() < kFewest || beside.size() < kFewest) return std::nullopt;
  BacklitLevels levels;
  levels.dark = static_cast<double>(median(std::move(part)));
  // A fifth of what was not measured: shadows and the stage are dark, too.
  const auto high = beside.begin() + static_cast<std::ptrdiff_t>(beside.size() * 4 / 5);
  std::nth_element(beside.begin(), high, beside.end());
  levels.lit = static_cast<double>(*high);
  constexpr double kContrast = 3.0;
  constexpr double kLeast_counts = 10.0;
  if (levels.lit < kContrast * levels.dark || levels.lit < levels.dark + kLeast_counts)
    return std::nullopt;
  return levels;
}

/// A place of the edge of a silhouette, and the unit direction from the part to the background.
struct SilhouetteEdge {
  Eigen::Vector2d place_px;
  Eigen::Vector2d outwards;
};

/// The edge in a row: between pixels, at the middle of the levels.
std::vector<SilhouetteEdge> edges_of_row(const Image<float>& counts,
                                         const BacklitLevels& levels,
                                         int y) {
  constexpr int kMargin = 3;
  std::vector<SilhouetteEdge> edges;
  if (y < kMargin || y >= counts.height() - kMargin) return edges;
  const auto at = [&](int u, int v) { return static_cast<double>(counts(u, v)); };
  for (int x = kMargin; x + kMargin < counts.width(); ++x) {
    for (const bool across : {true, false}) {
      const double here = at(x, y) - levels.middle();
      const double next = (across ? at(x + 1, y) : at(x, y + 1)) - levels.middle();
      if ((here < 0.0) == (next < 0.0)) continue;
      const Eigen::Vector2d slope(at(x + 1, y - 1) + 2 * at(x + 1, y) + at(x + 1, y + 1) -
                                      at(x - 1, y - 1) - 2 * at(x - 1, y) - at(x - 1, y + 1),
                                  at(x - 1, y + 1) + 2 * at(x, y + 1) + at(x + 1, y + 1) -
                                      at(x - 1, y - 1) - 2 * at(x, y - 1) - at(x + 1, y - 1));
      // A steep edge of the full contrast; others are of the stage or of a shadow on it.
      constexpr double kSteep = 1.0;  // of the contrast, in the eight pixels of the slope
      if (slope.norm() < kSteep * (levels.lit - levels.dark)) continue;
      // Each place once: along the direction that the edge crosses.
      const bool steeper = std::abs(slope.x()) >= std::abs(slope.y());
      if (steeper != across) continue;
      const double share = here / (here - next);
      const Eigen::Vector2d place(x + (across ? share : 0.0), y + (across ? 0.0 : share));
      edges.push_back({place, slope.normalized()});
    }
  }
  return edges;
}

/// How far outside of the edge the surface begins, px and mm; none where there is no surface.
struct RimOffset {
  double px = 0.0;
  double mm = 0.0;
  double pixel_mm = 0.0;
};

std::optional<RimOffset> rim_at(const SilhouetteEdge& edge,
                                const RayScene& surface,
                                const CameraModel& camera,
                                const Eigen::Isometry3d& object_from_rig) {
  constexpr double kOutside_px = 6.0;
  constexpr double kInside_px = 3.0;  // farther in, the rim of the part was not measured
  constexpr double kStep_px = 0.1;
  for (double out = kOutside_px; out > -kInside_px; out -= kStep_px) {
    const Eigen::Vector2d ray = camera.ray(edge.place_px + out * edge.outwards);
    const Eigen::Vector3d direction = object_from_rig.linear() * ray.homogeneous();
    const auto hit = surface.first_hit(object_from_rig.translation(), direction);
    if (!hit) continue;
    if (out > kOutside_px - kStep_px) return std::nullopt;  // another part of the surface
    // Between two rays; the direction has a depth of 1, so that the distance is the depth.
    const double px = out + 0.5 * kStep_px;
    const double pixel_mm = hit->distance / camera.focal_px.x();
    return RimOffset{px, px * pixel_mm, pixel_mm};
  }
  return std::nullopt;
}

double quantile(std::vector<double> values, double share) {
  const auto index = std::min(values.size() - 1,
                              static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(
      values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
  return values[index];
}

}  // namespace

bool SilhouetteReport::contradicts() const {
  return outside_mm > limit_mm;
}

std::string SilhouetteReport::text() const {
  if (rims == 0) return "";
  if (contradicts()) {
    return fmt::format(
        "the surface reaches beyond the silhouettes of the part before the lit background, by "
        "{:.3f} "
        "mm in the median of {} places in {} views: no motion of part or rig explains that, but "
        "views that are not where they are taken to be, or a rig of another scale",
        outside_mm,
        rims,
        views);
  }
  return fmt::format(
      "the rims of the surface lie {:.3f} mm {} the silhouettes in {} views, 99 % at most {:.3f} "
      "mm "
      "outside: a surface that is farther out by more than {:.3f} mm is excluded",
      std::abs(outside_mm),
      outside_mm > 0.0 ? "outside of" : "within",
      views,
      std::max(0.0, largest_mm),
      excluded_mm);
}

SilhouetteReport check_silhouettes(const RayScene& surface,
                                   std::size_t count,
                                   const std::function<BacklitView(std::size_t)>& load,
                                   const CameraModel& camera,
                                   const Run& run) {
  SilhouetteReport report;
  std::vector<double> outside_mm;
  std::vector<double> pixels_mm;
  for (std::size_t i = 0; i < count; ++i) {
    run.check();
    const BacklitView view = load(i);
    require(same_size(view.counts, view.depth_mm) && view.counts.width() == camera.width_px &&
                view.counts.height() == camera.height_px,
            "check_silhouettes: a view and the camera differ in size");
    const auto levels = levels_of(view);
    if (!levels) continue;
    ++report.views;
    const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
    std::vector<std::vector<RimOffset>> rows(static_cast<std::size_t>(view.counts.height()));
    parallel_rows(view.counts.height(), [&](int y) {
      for (const SilhouetteEdge& edge : edges_of_row(view.counts, *levels, y)) {
        if (const auto rim = rim_at(edge, surface, camera, object_from_rig))
          rows[static_cast<std::size_t>(y)].push_back(*rim);
      }
    });
    for (const auto& row : rows) {
      for (const RimOffset& rim : row) {
        outside_mm.push_back(rim.mm);
        pixels_mm.push_back(rim.pixel_mm);
      }
    }
  }
  constexpr std::size_t kFewest = 50;  // places: fewer are chance
  if (outside_mm.size() < kFewest) return report;
  report.rims = outside_mm.size();
  report.outside_mm = quantile(outside_mm, 0.5);
  report.largest_mm = quantile(outside_mm, 0.99);
  report.limit_mm = 0.5 * quantile(pixels_mm, 0.5);
  report.excluded_mm = std::max(0.0, report.limit_mm - report.outside_mm);
  return report;
}

}  // namespace frangia
