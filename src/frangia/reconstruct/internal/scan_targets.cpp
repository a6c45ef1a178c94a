#include "frangia/reconstruct/internal/scan_targets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/geometry/boundary.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/rig/camera_model.h"

#ifdef FRANGIA_WITH_CALIBRATION
#include "frangia/calibrate/board/board_image.h"
#include "frangia/targets/calibrate_find_targets.h"
#endif

namespace frangia {

ScanTargets find_scan_targets(const Scan& scan, const MeasuredViews& measured, const Run& run) {
  ScanTargets out{scan.targets.value(), {}};
#ifdef FRANGIA_WITH_CALIBRATION
  run.stage("targets");
  std::map<std::string, std::size_t> views;
  for (std::size_t i = 0; i < scan.views.size(); ++i)
    views[scan.views[i].folder.string()] = i;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < measured.stations.size(); ++i) {
    run.check();
    run.report(static_cast<double>(i) / static_cast<double>(measured.stations.size()));
    const std::string& name = measured.stations[i].name;
    const Image<float> counts = board_image(read_frames(scan, views.at(name), run));
    auto& sightings = out.sightings[name];
    sightings = find_targets(
        counts, measured.reference().load_points(i).range, scan.rig.reference().model, out.set);
    seen += sightings.size();
    run.note(fmt::format("{}: {} targets", name, sightings.size()));
  }
  if (seen == 0) {
    run.warn(
        "no view shows a target of [targets] in scan.toml: check its sizes, whether the discs are "
        "dark or light, and that a target spans ten pixels");
  }
#else
  static_cast<void>(measured);
  static_cast<void>(run);
  throw Error(ErrorKind::Input,
              "scan.toml has [targets], which this build without calibration does not find; remove "
              "the table, or build with FRANGIA_CALIBRATION");
#endif
  return out;
}

std::vector<TargetView> target_views(const ScanTargets& targets, const MeasuredViews& measured) {
  std::vector<TargetView> views;
  for (std::size_t i = 0; i < measured.stations.size(); ++i) {
    const std::string& name = measured.stations[i].name;
    const auto found = targets.sightings.find(name);
    views.push_back(
        {name,
         found == targets.sightings.end() ? std::vector<TargetSighting>() : found->second,
         measured.reference().rig_from_object(i)});
  }
  return views;
}

std::vector<PointTie> target_ties(const ScanTargets& targets, const MeasuredViews& measured) {
  const std::vector<TargetView> views = target_views(targets, measured);
  return ties_of(match_targets(views, targets.set), views);
}

namespace {

/// Points beside the edge of a sticker whose fringes hold light of both of its sides.
constexpr double kEdge_px = 2.0;

/// A sticker in the rig frame of a view.
struct Sticker {
  Eigen::Vector3d center_mm;
  Eigen::Vector3d normal;
  double radius_mm = 0.0;
  double depth_mm = 0.0;  ///< farther from its plane a point is of another surface

  [[nodiscard]] bool holds(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d away = point_mm - center_mm;
    const double height = normal.dot(away);
    return std::abs(height) < depth_mm &&
           (away - height * normal).squaredNorm() < radius_mm * radius_mm;
  }
};

/// Removes the points of a sticker from a view; returns their number.
std::size_t remove_sticker(View& view,
                           const Sticker& sticker,
                           const Image<Eigen::Vector2f>& rays,
                           const CameraModel& camera) {
  if (!(sticker.center_mm.z() > 0.0) || sticker.normal.dot(sticker.center_mm) >= 0.0) return 0;
  const Eigen::Vector2d center = camera.project(sticker.center_mm);
  const double reach =
      std::ceil(1.2 * sticker.radius_mm * camera.focal_px.maxCoeff() / sticker.center_mm.z()) + 1.0;
  if (!center.allFinite()) return 0;
  const auto clamped = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int right = clamped(center.x() + reach, view.range.depth_mm.width() - 1);
  const int low = clamped(center.y() + reach, view.range.depth_mm.height() - 1);
  const auto point_of = [&](int x, int y, float depth_mm) {
    const Eigen::Vector2d ray = rays(x, y).cast<double>();
    return Eigen::Vector3d(static_cast<double>(depth_mm) * Eigen::Vector3d(ray.x(), ray.y(), 1.0));
  };
  std::size_t removed = 0;
  for (int y = clamped(center.y() - reach, low); y <= low; ++y) {
    for (int x = clamped(center.x() - reach, right); x <= right; ++x) {
      const float depth_mm = view.range.depth_mm(x, y);
      if (std::isnan(depth_mm) || !sticker.holds(point_of(x, y, depth_mm))) continue;
      view.range.remove(x, y);
      ++removed;
    }
  }
  removed += std::erase_if(view.edge_pixels, [&](const RangePixel& pixel) {
    return sticker.holds(point_of(pixel.x, pixel.y, pixel.depth_mm));
  });
  return removed;
}

std::map<std::string, int> setups_of(const std::vector<ViewSummary>& summaries) {
  std::map<std::string, int> setups;
  for (const ViewSummary& view : summaries)
    setups[view.name] = view.setup;
  return setups;
}

void warn_of_scale(const TargetScale& scale, const Run& run) {
  for (const KnownTargetDistance& known : scale.missing) {
    run.warn(
        fmt::format("the known distance from target {} to target {} is not used: no view saw "
                    "both",
                    known.first,
                    known.second));
  }
  if (scale.contradicts()) {
    run.warn(
        fmt::format("the known distances contradict each other: chi squared is {:.0f} for {} "
                    "of them; check the codes and the distances in [targets] of scan.toml",
                    scale.chi_squared,
                    scale.distances));
  }
}

}  // namespace

std::vector<Target> registered_targets(const ScanTargets& targets, const MeasuredSetup& joined) {
  return match_targets(target_views(targets, joined.measured), targets.set);
}

TargetsReport report_targets(const std::vector<Target>& found,
                             const ScanTargets& targets,
                             const MeasuredSetup& joined,
                             const std::vector<ViewSummary>& summaries,
                             const Run& run) {
  const std::vector<TargetView> views = target_views(targets, joined.measured);
  const std::map<std::string, int> setups = setups_of(summaries);
  TargetsReport report;
  double square_mm2 = 0.0;
  double chi_squared = 0.0;
  double freedom = 0.0;
  std::size_t compared = 0;
  for (const Target& target : found) {
    MeasuredTarget& out = report.targets.emplace_back();
    out.code = target.code;
    out.center_mm = target.center_mm;
    out.sigma_mm = std::sqrt(target.covariance_mm2.trace() / 3.0);
    out.views = target.seen.size();
    std::set<int> numbers;
    for (const Target::Sighting& seen : target.seen)
      numbers.insert(setups.at(views[seen.view].name));
    out.setups.assign(numbers.begin(), numbers.end());
    report.tying_setups += numbers.size() > 1 ? 1U : 0U;
    if (target.seen.size() < 2) continue;
    ++report.tying;
    for (const Target::Sighting& seen : target.seen) {
      const TargetView& view = views[seen.view];
      const TargetSighting& sighting = view.sightings[seen.index];
      const Eigen::Vector3d away = sighting.center_mm - view.rig_from_object * target.center_mm;
      square_mm2 += away.squaredNorm();
      chi_squared += away.dot(sighting.covariance_mm2.inverse() * away);
      ++compared;
    }
    freedom += 3.0 * static_cast<double>(target.seen.size() - 1);
  }
  if (compared > 0) {
    report.rms_mm = std::sqrt(square_mm2 / static_cast<double>(compared));
    report.over_sigma = std::sqrt(chi_squared / freedom);
  }
  report.scale = measure_scale(found, targets.set);
  if (report.scale) {
    warn_of_scale(*report.scale, run);
  } else if (!targets.set.distances.empty()) {
    run.warn("no known distance between targets is used: no view saw both targets of one");
  }
  return report;
}

std::size_t mask_targets(const std::vector<Target>& found,
                         const TargetSet& set,
                         MeasuredViews& measured,
                         const Rig& rig) {
  std::size_t removed = 0;
  for (std::size_t camera = 0; camera < measured.cameras.size(); ++camera) {
    ViewStore& views = measured.cameras[camera];
    const CameraModel& model = rig.cameras[camera].camera.model;
    const auto rays = views.rays(model);
    for (std::size_t i = 0; i < views.size(); ++i) {
      View view = views.load(i);
      std::size_t of_view = 0;
      for (const Target& target : found) {
        const double size_mm = sticker_diameter_mm(set, target.code >= 0);
        Sticker sticker;
        sticker.center_mm = view.rig_from_object * target.center_mm;
        sticker.normal = view.rig_from_object.linear() * target.normal;
        sticker.radius_mm =
            0.5 * size_mm + kEdge_px * sticker.center_mm.z() / model.focal_px.minCoeff();
        sticker.depth_mm = 0.25 * size_mm;
        of_view += remove_sticker(view, sticker, *rays, model);
      }
      if (of_view == 0) continue;
      removed += of_view;
      views.replace(i, view);
    }
  }
  return removed;
}

std::size_t fill_targets(const std::vector<Target>& found,
                         const TargetSet& set,
                         Mesh& mesh,
                         const Run& run) {
  // Of the sticker: the edge that is masked, and triangles that end before it.
  constexpr double kReach = 1.6;
  FillHolesOptions options;
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::vector<std::uint32_t> vertices = vertices_of(mesh, loops[i]);
    const bool under = std::any_of(found.begin(), found.end(), [&](const Target& target) {
      const double reach_mm = 0.5 * kReach * sticker_diameter_mm(set, target.code >= 0);
      return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
        return (mesh.vertices_mm[vertex].cast<double>() - target.center_mm).norm() < reach_mm;
      });
    });
    if (under) options.only.push_back(i);
  }
  const std::size_t filled = options.only.size();
  if (filled > 0) mesh = fill_holes(std::move(mesh), options, run);
  return filled;
}

void apply_scale(Reconstruction& result, double factor) {
  const auto scale = static_cast<float>(factor);
  const auto apply = [scale](std::vector<Eigen::Vector3f>& points) {
    for (Eigen::Vector3f& point : points)
      point *= scale;
  };
  apply(result.mesh.vertices_mm);
  apply(result.raw.points_mm);
  for (PointCloud& points : result.setup_points)
    apply(points.points_mm);
  for (MeasuredTarget& target : result.targets->targets)
    target.center_mm *= factor;
}

}  // namespace frangia
