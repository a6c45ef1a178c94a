#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/calibrate/artifact/internal/measure_sites.h"
#include "frangia/calibrate/board/board_image.h"
#include "frangia/calibrate/board/select_plane.h"
#include "frangia/calibrate/internal/artifact_sites.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/frames/noise_model.h"
#include "frangia/geometry/fit_plane.h"
#include "frangia/range/laser_profile.h"

namespace frangia {
namespace {

/// Share of the sites that move with the table that must lie on one plane.
constexpr double kMinPlateShare = 0.3;

/// Removes sites that are the same at all angles: the top of the turntable and what stands behind.
void remove_static(std::vector<std::vector<LightSite>>& views) {
  constexpr double kStill = 0.002;  // of the range of the light
  constexpr double kSeen = 0.8;     // of the views
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& sites : views) {
    for (const LightSite& site : sites) {
      if (std::isnan(site.light.x())) continue;
      low = std::min(low, site.light.x());
      high = std::max(high, site.light.x());
    }
  }
  constexpr std::size_t kFewestViews = 3;
  if (views.size() < kFewestViews) return;
  for (std::size_t i = 0; i < views.front().size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    std::size_t seen = 0;
    for (const auto& sites : views) {
      if (std::isnan(sites[i].light.x())) continue;
      ++seen;
      least = std::min(least, sites[i].light.x());
      most = std::max(most, sites[i].light.x());
    }
    if (static_cast<double>(seen) < kSeen * static_cast<double>(views.size()) ||
        most - least > kStill * (high - low))
      continue;
    for (auto& sites : views)
      sites[i].light.setConstant(std::nan(""));
  }
}

/// Normal and distance of the plane through points, the normal towards the camera.
Eigen::Vector4d plane_through(const std::vector<Eigen::Vector3d>& points) {
  const auto plane = fit_plane(points);
  const double sign = plane.offset() < 0.0 ? -1.0 : 1.0;
  return (Eigen::Vector4d() << sign * plane.normal(), -sign * plane.offset()).finished();
}

/// Pixels of the laser line that lie among sites of the artifact.
std::vector<LinePixel> line_on(const Scan& scan,
                               std::size_t view,
                               const Rig& rig,
                               const std::vector<LightSite>& sites,
                               int step_px,
                               const Run& run) {
  std::vector<LinePixel> line;
  if (!rig.laser_sheet) return line;
  const std::vector<FrameStack> stacks = read_frames(scan, view, run);
  const auto found = std::find_if(stacks.begin(), stacks.end(), [](const FrameStack& stack) {
    return stack.pattern.kind == PatternKind::Line;
  });
  if (found == stacks.end()) return line;
  std::vector<FrameStack> fringes;
  for (const FrameStack& stack : stacks)
    if (stack.pattern.kind == PatternKind::Fringe) fringes.push_back(stack);
  const NoiseModel noise = rig.reference().noise.value_or(NoiseModel{});
  constexpr std::size_t kEvery = 4;  // rows, which share the noise of one line
  const std::vector<ProfilePoint> profile = laser_profile(*found, board_image(fringes), rig, noise);
  for (std::size_t i = 0; i < profile.size(); i += kEvery) {
    const bool near = std::any_of(sites.begin(), sites.end(), [&](const LightSite& site) {
      return (site.camera_px - profile[i].pixel).cwiseAbs().maxCoeff() < 0.6 * step_px;
    });
    if (near && profile[i].sigma_px > 0.0) line.push_back({profile[i].pixel, profile[i].sigma_px});
  }
  return line;
}

}  // namespace

ArtifactCapture measure_plate(const Scan& scan,
                              const Rig& rig,
                              const CalibrateArtifactsOptions& options,
                              const Run& run) {
  constexpr std::size_t kFewestSites = 60;
  const int step = site_step(rig.reference().model, options.plate_sites);
  auto measured = measure_sites(scan, rig, site_options(step), run);
  remove_static(measured);
  ArtifactCapture capture{Plate{}, {}, {}};
  std::size_t best = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    std::vector<Eigen::Vector2d> rays;
    std::vector<double> light;
    std::size_t seen = 0;
    for (const LightSite& site : measured[i]) {
      rays.push_back(rig.reference().model.ray(site.camera_px));
      const double value = site.light.x();
      light.push_back(rig.projector.is_angular() ? std::tan(value) : value);
      if (!std::isnan(value)) ++seen;
    }
    const std::vector<bool> flags = select_plane(rays, light);
    ArtifactView view{scan.views[i].folder.generic_string(), scan.views[i].angle_rad, {}, {}, {}};
    for (std::size_t k = 0; k < flags.size(); ++k)
      if (flags[k]) view.sites.push_back(measured[i][k]);
    view.surface.assign(view.sites.size(), 0);
    const bool found =
        view.sites.size() >= kFewestSites &&
        static_cast<double>(view.sites.size()) > kMinPlateShare * static_cast<double>(seen);
    if (!found) {
      capture.left_out.push_back(view.name);
      continue;
    }
    view.line = line_on(scan, i, rig, view.sites, step, run);
    // The surface begins as that of the view with most sites.
    if (view.sites.size() > best) {
      std::vector<Eigen::Vector3d> points = site_points(view.sites, rig);
      std::erase_if(points, [](const Eigen::Vector3d& point) { return !point.allFinite(); });
      if (points.size() < kFewestSites) {
        fail_artifact(scan,
                      "the projector of rig.toml does not light the plate; check its position_mm "
                      "and rotation, which must be right within a few degrees and 10 %");
      }
      best = view.sites.size();
      const Eigen::Vector4d plane = plane_through(points);
      const Eigen::Isometry3d back = table_turn(rig, -view.angle_rad);
      const Eigen::Vector3d normal = back.linear() * plane.head<3>();
      capture.surfaces = {Eigen::Vector4d(
          normal.x(), normal.y(), normal.z(), plane[3] + normal.dot(back.translation()))};
    }
    capture.views.push_back(std::move(view));
  }
  if (capture.views.empty())
    fail_artifact(scan, "no view shows a plate; let it fill a third of the lit image");
  return capture;
}

}  // namespace frangia
