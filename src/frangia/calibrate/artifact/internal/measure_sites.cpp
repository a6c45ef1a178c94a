#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/calibrate/board/board_image.h"
#include "frangia/calibrate/board/measure_light.h"
#include "frangia/calibrate/board/select_plane.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/noise_model.h"
#include "frangia/geometry/fit_primitives.h"
#include "frangia/range/laser_profile.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// The pattern of which `LightSite::light` counts the units.
Pattern unit_pattern(const Rig& rig) {
  Pattern pattern;
  if (rig.projector.is_angular()) {
    pattern.fringes_per_degree = 1.0;
  } else {
    pattern.period_px = 1.0;
  }
  return pattern;
}

/// Throws an input error that names scan.toml.
[[noreturn]] void fail_artifact(const Scan& scan, const std::string& sentence) {
  throw Error(ErrorKind::Input,
              fmt::format("{}: {}", (scan.folder / "scan.toml").string(), sentence));
}

/// Distance of sites, px, of which there are `sites` along the longer side of the image.
int site_step(const CameraModel& model, int sites) {
  return std::max(1, std::max(model.width_px, model.height_px) / sites);
}

/// Windows that overlap just so far that the value of a quadratic in a window has the variance of
/// the mean of `step_px` squared pixels: the sites together then hold the information of all
/// pixels, and their standard deviations state it, though neighbors are correlated.
MeasureLightOptions site_options(int step_px) {
  constexpr double kQuadratic = 1.87;  // root of the variance factor of its value, 3.5
  constexpr int kLargest_px = 12;      // beyond it the time grows, and a surface is not quadratic
  MeasureLightOptions options;
  options.step_px = step_px;
  options.fit.radius_px =
      std::clamp(static_cast<int>(std::lround(0.5 * (kQuadratic * step_px - 1.0))), 2, kLargest_px);
  const int side = 2 * options.fit.radius_px + 1;
  options.fit.min_pixels = side * side / 2;
  return options;
}

/// Sites of all views, measured with the same rig.
std::vector<std::vector<LightSite>> measure_sites(const Scan& scan,
                                                  const Rig& rig,
                                                  const MeasureLightOptions& options,
                                                  const Run& run) {
  std::vector<std::vector<LightSite>> views;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.check();
    views.push_back(measure_light(read_frames(scan, i, run), rig, options, run));
  }
  return views;
}

}  // namespace

std::vector<Eigen::Vector3d> site_points(const std::vector<LightSite>& sites, const Rig& rig) {
  const Pattern pattern = unit_pattern(rig);
  const double phase_per_light = rig.projector.is_angular() ? kTwoPi * deg_from_rad(1.0) : kTwoPi;
  std::vector<Eigen::Vector3d> points;
  for (const LightSite& site : sites) {
    const Eigen::Vector2d ray = rig.reference().model.ray(site.camera_px);
    const double phase = phase_per_light * site.light.x();
    points.emplace_back(intersect_fringe(ray, phase, pattern, rig.projector).depth_mm *
                        ray.homogeneous());
  }
  return points;
}

Eigen::Isometry3d table_turn(const Rig& rig, double angle_rad) {
  return rig.rig_from_object(angle_rad) * rig.rig_from_object(0.0).inverse();
}

namespace {

/// Sites on balls, along the longer side of the image.
constexpr int kBallSites = 128;

/// Centers in the order of those of an earlier view.
void order_balls(const std::vector<Eigen::Vector3d>& before,
                 const Eigen::Isometry3d& to_zero,
                 std::vector<FoundBall>& balls) {
  if (balls.size() < 2 || before.empty()) return;
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (to_zero * balls[a].sphere.center_mm - before[0]).squaredNorm() +
           (to_zero * balls[b].sphere.center_mm - before[1]).squaredNorm();
  };
  if (distance(1, 0) < distance(0, 1)) std::swap(balls[0], balls[1]);
}

/// Whether a site is seen from the front, where the phase of a ball is well measured.
bool is_frontal(const Eigen::Vector3d& point, const Eigen::Vector3d& center, const Rig& rig) {
  constexpr double kLeastCosine = 0.55;
  const Eigen::Vector3d normal = (point - center).normalized();
  return -normal.dot(point.normalized()) > kLeastCosine &&
         normal.dot((rig.projector.position_mm - point).normalized()) > kLeastCosine;
}

}  // namespace

ArtifactCapture measure_balls(const Scan& scan, const Rig& rig, const Run& run) {
  const auto& balls = std::get<Balls>(*scan.artifact);
  constexpr double kFarOff = 12.0;  // diameters, where the rig has no turntable
  const std::size_t count = balls.spacing_mm ? 2 : 1;
  // Within a tenth of the radius the surface of a ball is quadratic to 1e-5 of it.
  const double apparent_px =
      0.5 * balls.diameter_mm * rig.reference().model.focal_px.x() /
      (rig.turntable ? rig.turntable->point_mm.z() : kFarOff * balls.diameter_mm);
  const int step = std::max(2,
                            std::min(static_cast<int>(std::lround(0.1 * apparent_px)),
                                     site_step(rig.reference().model, kBallSites)));
  const auto measured = measure_sites(scan, rig, site_options(step), run);
  ArtifactCapture capture{balls, {}, {}};
  std::vector<Eigen::Vector3d> before;
  std::vector<Eigen::Vector3d> sums(count, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::vector<Eigen::Vector3d> points = site_points(measured[i], rig);
    std::vector<FoundBall> found = find_balls(points, 0.5 * balls.diameter_mm, count);
    ArtifactView view{scan.views[i].folder.generic_string(), scan.views[i].angle_rad, {}, {}, {}};
    if (found.size() < count) {
      capture.left_out.push_back(view.name);
      continue;
    }
    const Eigen::Isometry3d to_zero = table_turn(rig, -view.angle_rad);
    order_balls(before, to_zero, found);
    for (std::size_t b = 0; b < count; ++b) {
      const Eigen::Vector3d& center = found[b].sphere.center_mm;
      sums[b] += to_zero * center;
      for (const std::size_t k : found[b].points) {
        if (!is_frontal(points[k], center, rig)) continue;
        view.sites.push_back(measured[i][k]);
        view.surface.push_back(static_cast<int>(b));
      }
    }
    capture.views.push_back(std::move(view));
    before.clear();
    for (const Eigen::Vector3d& sum : sums)
      before.emplace_back(sum / static_cast<double>(capture.views.size()));
  }
  if (capture.views.empty()) {
    fail_artifact(scan,
                  fmt::format("no view shows {} of {:g} mm; check diameter_mm, and that camera and "
                              "projector see them whole",
                              count == 2 ? "both balls" : "a ball",
                              balls.diameter_mm));
  }
  for (const Eigen::Vector3d& center : before)
    capture.surfaces.emplace_back(center.x(), center.y(), center.z(), 0.0);
  return capture;
}

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

namespace {

/// Sites along the longer side of the image.
constexpr int kScreenSites = 40;

}  // namespace

std::vector<ScreenView> measure_screen(const Scan& scan, const Run& run) {
  const auto& screen = std::get<Screen>(*scan.artifact);
  bool vertical = false;
  bool horizontal = false;
  for (const Pattern& pattern : scan.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (pattern.source != PatternSource::Screen) {
      fail_artifact(scan,
                    fmt::format("pattern \"{}\" is not shown by the screen; add source = "
                                "\"screen\" to it",
                                pattern.name));
    }
    (pattern.direction == FringeDirection::Vertical ? vertical : horizontal) = true;
  }
  if (!vertical || !horizontal) {
    const char* name = vertical ? "horizontal" : "vertical";
    fail_artifact(scan,
                  fmt::format("there are no {} fringes; a screen needs both directions, so add "
                              "patterns with direction = \"{}\" and capture the poses again",
                              name,
                              name));
  }
  Rig display = scan.rig;
  display.projector = Projector{};
  display.projector.model =
      PinholeModel{.width_px = screen.width_px, .height_px = screen.height_px};
  const int step = site_step(scan.rig.reference().model, kScreenSites);
  auto measured = measure_sites(scan, display, site_options(step), run);
  std::vector<ScreenView> views;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    ScreenView view{scan.views[i].folder.generic_string(), {}};
    for (const LightSite& site : measured[i]) {
      const bool usable = site.light.allFinite() && site.sigma.minCoeff() > 0.0 &&
                          std::abs(site.by_camera.determinant()) > 1e-6;
      if (usable) view.points.push_back(site);
    }
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace frangia
