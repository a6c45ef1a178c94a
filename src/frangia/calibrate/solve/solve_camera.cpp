#include "frangia/calibrate/solve/solve_camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/solve/internal/rig_covariance.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

constexpr std::size_t kFewestScreenPoints = 50;

Eigen::Vector2d place_on(const Screen& screen, const LightSite& point) {
  const Eigen::Vector2d center(0.5 * (screen.width_px - 1), 0.5 * (screen.height_px - 1));
  return screen.pixel_mm * (point.light - center);
}

/// The observations of all views as the adjustment of rigs has them, for the camera alone.
std::vector<RigObservation> observations_of_screen(const Screen& screen,
                                                   std::span<const ScreenView> views) {
  const Eigen::Vector2d half =
      0.5 * screen.pixel_mm * Eigen::Vector2d(screen.width_px, screen.height_px);
  std::vector<RigObservation> observations;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t i = 0; i < views[view].points.size(); ++i) {
      const LightSite& point = views[view].points[i];
      const Eigen::Vector2d place = place_on(screen, point);
      const Eigen::Vector2d relative = place.cwiseQuotient(half);
      RigObservation seen{
          view, i, BoardSite{place, board_height_terms(relative.x(), relative.y())}};
      seen.pixel = point.camera_px;
      // The camera pixel is exact; the error of the phase is carried over to it.
      const Eigen::Matrix2d carried = point.by_camera.inverse() * point.sigma.asDiagonal();
      seen.sigma_px = carried.rowwise().norm();
      observations.push_back(seen);
    }
  }
  return observations;
}

/// Homography from the screen, in mm, to the camera image in widths of the image about its middle.
Eigen::Matrix3d homography_of(const Screen& screen, const ScreenView& view, int width, int height) {
  std::vector<cv::Point2d> plane;
  std::vector<cv::Point2d> image;
  for (const LightSite& point : view.points) {
    const Eigen::Vector2d place = place_on(screen, point);
    plane.emplace_back(place.x(), place.y());
    image.emplace_back((point.camera_px.x() - 0.5 * width) / width,
                       (point.camera_px.y() - 0.5 * height) / width);
  }
  const cv::Mat found = cv::findHomography(plane, image);
  if (found.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the points of the screen lie on one line; show more of it", view.name));
  }
  Eigen::Matrix3d homography;
  for (int i = 0; i < 9; ++i)
    homography(i / 3, i % 3) = found.at<double>(i / 3, i % 3);
  return homography;
}

void check_screen_views(const Screen& screen,
                        std::span<const ScreenView> views,
                        int width,
                        int height) {
  constexpr std::size_t kFewestViews = 3;
  constexpr double kParallel_rad = 0.08;  // 5 degrees
  if (views.size() < kFewestViews) {
    throw Error(ErrorKind::Input,
                fmt::format("the screen is seen in {} of at least {} poses; capture more, each "
                            "tilted another way",
                            views.size(),
                            kFewestViews));
  }
  std::vector<Eigen::Vector3d> normals;
  for (const ScreenView& view : views) {
    if (view.points.size() < kFewestScreenPoints) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{}: {} points of the screen are measured; show it larger and brighter",
                      view.name,
                      view.points.size()));
    }
    const Eigen::Matrix3d homography = homography_of(screen, view, width, height);
    const Eigen::Vector2d middle = place_on(screen, view.points[view.points.size() / 2]);
    const double turn = homography.determinant() * (homography * middle.homogeneous()).z();
    if (!(turn > 0.0)) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: the screen is seen mirrored; check the key direction of each "
                              "pattern and that the monitor is not seen in a mirror",
                              view.name));
    }
    // The vanishing line of the screen, seen by a camera whose focal length is the image's width.
    const Eigen::Vector3d line = homography.inverse().transpose() * Eigen::Vector3d::UnitZ();
    normals.push_back(line.z() < 0.0 ? Eigen::Vector3d(-line.normalized()) : line.normalized());
  }
  double widest = 0.0;
  for (const Eigen::Vector3d& a : normals)
    for (const Eigen::Vector3d& b : normals)
      widest = std::max(widest, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
  if (widest > kParallel_rad) return;
  throw Error(ErrorKind::Input,
              "all poses of the screen are parallel, which leaves the focal length open; tilt the "
              "camera or the screen by 20 to 40 degrees, each time another way");
}

RigParameters start_of_screen(const Screen& screen,
                              std::span<const ScreenView> views,
                              int width,
                              int height) {
  constexpr std::size_t kSome = 200;  // points a view
  std::vector<std::vector<cv::Point3f>> planes;
  std::vector<std::vector<cv::Point2f>> images;
  for (const ScreenView& view : views) {
    planes.emplace_back();
    images.emplace_back();
    for (std::size_t i = 0; i < view.points.size(); i += view.points.size() / kSome + 1) {
      const Eigen::Vector2f place = place_on(screen, view.points[i]).cast<float>();
      const Eigen::Vector2f pixel = view.points[i].camera_px.cast<float>();
      planes.back().emplace_back(place.x(), place.y(), 0.0F);
      images.back().emplace_back(pixel.x(), pixel.y());
    }
  }
  cv::Mat matrix;
  cv::Mat distortion;
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::calibrateCamera(planes,
                      images,
                      cv::Size(width, height),
                      matrix,
                      distortion,
                      turns,
                      shifts,
                      cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3);
  RigParameters start;
  start.cameras.front().intrinsics = {matrix.at<double>(0, 0),
                                      1.0,
                                      matrix.at<double>(0, 2),
                                      matrix.at<double>(1, 2),
                                      distortion.at<double>(0)};
  for (std::size_t i = 0; i < turns.size(); ++i) {
    RigParameters::Pose pose{};
    for (int k = 0; k < 3; ++k) {
      pose.at(static_cast<std::size_t>(k)) = turns[i].at<double>(k);
      pose.at(static_cast<std::size_t>(k) + 3) = shifts[i].at<double>(k);
    }
    start.camera_from_board.push_back(pose);
  }
  return start;
}

struct CameraFit {
  RigParameters parameters;
  RigFreedom freedom{RigLayout{.has_projector = false}};
  RigNoise noise;
};

void adjust_camera(std::span<const RigObservation> observations,
                   const RigSolveOptions& options,
                   CameraFit& fit,
                   const Run& run) {
  constexpr int kRounds = 4;
  constexpr double kSettled = 0.01;
  const auto count = static_cast<double>(2 * observations.size());
  for (int i = 0; i < kRounds; ++i) {
    const RigBundleResult result = adjust_rig(
        observations, fit.freedom, fit.noise, options.max_iterations, fit.parameters, run);
    if (!result.usable) {
      throw Error(ErrorKind::Numeric,
                  "the calibration of the camera does not converge; check board.size_px, the "
                  "periods of the patterns, and that nothing moved during a pose");
    }
    const double before = fit.noise.camera[0];
    for (int k = 0; k < kRounds; ++k) {
      double weighted = 0.0;
      for (const RigObservation& observation : observations) {
        const double squared = residual_of(observation, fit.parameters)
                                   .cwiseQuotient(observation.sigma_px)
                                   .squaredNorm();
        weighted += robust_weight(std::sqrt(squared) / fit.noise.camera[0]) * squared;
      }
      fit.noise.camera[0] = std::max(std::sqrt(weighted / count), 1e-9);
    }
    if (std::abs(fit.noise.camera[0] / before - 1.0) < kSettled) break;
  }
}

/// Optional terms of a camera before a screen: its pixels are square and evenly spaced.
std::vector<ModelTerm> screen_terms(bool release_board) {
  const RigLayout layout{.has_projector = false};
  std::vector<ModelTerm> terms = optional_terms(layout, {}, release_board);
  std::erase_if(terms, [&](const ModelTerm& term) {
    return term.of_board && term.parameters.front() < layout.board() + 2;  // aspect and shear
  });
  for (ModelTerm& term : terms) {
    const std::size_t at = term.name.find("board");
    if (at != std::string::npos) term.name.replace(at, 5, "screen");
  }
  return terms;
}

void add_screen_residual(const Eigen::Vector2d& residual, ResidualSummary& summary) {
  summary.rms_px += residual.squaredNorm();
  summary.max_px = std::max(summary.max_px, residual.norm());
  ++summary.points;
}

void summarize_screen(std::span<const RigObservation> observations,
                      const CameraFit& fit,
                      CameraSolution& out) {
  out.by_view.resize(fit.parameters.camera_from_board.size());
  out.residuals_px.resize(out.by_view.size());
  for (const RigObservation& observation : observations) {
    const Eigen::Vector2d residual = residual_of(observation, fit.parameters);
    add_screen_residual(residual, out.residuals);
    add_screen_residual(residual, out.by_view[observation.view]);
    out.residuals_px[observation.view].emplace_back(-residual);
    double height = 0.0;
    for (std::size_t i = 0; i < observation.site.height_terms.size(); ++i)
      height += fit.parameters.board.at(i + 2) * observation.site.height_terms.at(i);
    out.bend_mm = std::max(out.bend_mm, std::abs(height));
  }
  const auto finish = [](ResidualSummary& summary) {
    summary.rms_px = std::sqrt(summary.rms_px / static_cast<double>(summary.points));
  };
  finish(out.residuals);
  std::for_each(out.by_view.begin(), out.by_view.end(), finish);
  out.residuals.sigma_px = fit.noise.camera[0];
}

}  // namespace

CameraSolution solve_camera(const Screen& screen,
                            std::span<const ScreenView> views,
                            int width_px,
                            int height_px,
                            const RigSolveOptions& options,
                            const Run& run) {
  check_artifact(screen);
  check_screen_views(screen, views, width_px, height_px);
  const std::vector<RigObservation> observations = observations_of_screen(screen, views);
  CameraFit fit;
  fit.parameters = start_of_screen(screen, views, width_px, height_px);
  adjust_camera(observations, options, fit, run);
  const std::vector<ModelTerm> terms = screen_terms(options.release_board);
  CameraSolution out;
  while (const auto term = best_term(
             observations, terms, fit.freedom, fit.noise, fit.parameters, options.min_gain)) {
    set_free(terms[*term], fit.freedom);
    adjust_camera(observations, options, fit, run);
    out.terms.push_back(terms[*term].name);
  }
  for (const ModelTerm& term : terms)
    if (!is_free(term, fit.freedom)) out.held.push_back(term.name);
  const RigParameters::Intrinsics& found = fit.parameters.cameras.front().intrinsics;
  out.camera.width_px = width_px;
  out.camera.height_px = height_px;
  out.camera.focal_px = {found[0], found[0] * found[1]};
  out.camera.principal_point_px = {found[2], found[3]};
  out.camera.distortion = {found[4], found[5], found[6], found[7], found[8]};
  for (const RigParameters::Pose& pose : fit.parameters.camera_from_board)
    out.camera_from_screen.push_back(isometry_of(pose));
  summarize_screen(observations, fit, out);
  out.parameters = rig_parameter_names(Rig{});
  out.parameters.resize(kIntrinsics);
  out.covariance =
      covariance_of(observations, fit.freedom, fit.noise, fit.parameters, out.parameters)
          .covariance;
  if (!out.covariance.allFinite()) {
    throw Error(ErrorKind::Input,
                "the poses of the screen do not determine the camera; capture more poses that fill "
                "the image and are tilted by 20 to 40 degrees, each another way");
  }
  return out;
}

}  // namespace frangia
