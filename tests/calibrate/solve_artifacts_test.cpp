// The truth is geometry: rays that meet a plate and balls which turn about an axis, and the angle
// psi under which the projector sees the points.
#include "frangia/calibrate/artifact/solve_artifacts.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"

namespace frangia {
namespace {

constexpr double kPitch = 0.97;
constexpr double kNoise_rad = 3e-6;  // of a window of some hundred pixels

Rig true_rig() {
  Rig rig = rig_preset("angular");
  std::get<AngularModel>(rig.projector.model).pitch_scale = kPitch;
  return rig;
}

/// The rig with all that is estimated off by some degrees and percent.
Rig rough_rig() {
  Rig rig = true_rig();
  const double turn = rad_from_deg(3.0);
  rig.projector.rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d(1.0, -2.0, 0.7).normalized()) *
                           rig.projector.rotation;
  rig.projector.position_mm *= 1.05;
  std::get<AngularModel>(rig.projector.model).pitch_scale *= 1.05;
  rig.turntable->axis =
      Eigen::AngleAxisd(turn, Eigen::Vector3d(1.0, 0.2, -0.7).normalized()) * rig.turntable->axis;
  rig.turntable->point_mm *= 0.95;
  rig.laser_sheet.reset();
  return rig;
}

Eigen::Isometry3d turned(const Rig& rig, double angle_rad) {
  return Eigen::Translation3d(rig.turntable->point_mm) *
         Eigen::AngleAxisd(angle_rad, rig.turntable->axis) *
         Eigen::Translation3d(-rig.turntable->point_mm);
}

/// Deviations of a wavefront at the edge of the field, rad: by psi squared, and by the cube of the
/// elevation.
struct Bend {
  double uu = 0.0;
  double vvv = 0.0;
};

/// Nominal psi of a point.
double psi_of(const Eigen::Vector3d& point, const Bend& bend) {
  const Rig rig = true_rig();
  const Eigen::Vector3d p = rig.projector.rotation * (point - rig.projector.position_mm);
  const double psi = std::atan2(p.x(), p.z());
  const double half = rad_from_deg(12.0);
  const double u = psi / half;
  const double v = p.y() / std::hypot(p.x(), p.z()) / half;
  return (psi + bend.uu * u * u + bend.vvv * v * v * v) / kPitch;
}

class Noise {
 public:
  explicit Noise(unsigned seed, const Bend& bend) : random_(seed), bend_(bend) {}
  LightSite site(const Eigen::Vector2d& pixel, const Eigen::Vector3d& point) {
    LightSite out;
    out.camera_px = pixel;
    out.light.x() = psi_of(point, bend_) + kNoise_rad * normal_(random_);
    out.sigma.x() = 0.5 * kNoise_rad;  // not the true noise
    return out;
  }

 private:
  std::mt19937 random_;
  Bend bend_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

/// A plate that leans by 14 degrees beside the axis, at `views` angles over `span`; `errors` of the
/// table.
ArtifactCapture plate_capture(int views,
                              double span_rad,
                              double error_rad = 0.0,
                              const Bend& bend = {}) {
  const Rig rig = true_rig();
  const Eigen::Vector3d axis = rig.turntable->axis;
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitZ() + 0.17 * Eigen::Vector3d::UnitX();
  normal = (normal - axis * axis.dot(normal)).normalized();
  normal = Eigen::AngleAxisd(0.25, axis.cross(normal).normalized()) * normal;
  const double offset = normal.dot(rig.turntable->point_mm) + 5.0;
  ArtifactCapture capture{Plate{}, {}, {}};
  Noise noise(5, bend);
  for (int i = 0; i < views; ++i) {
    const double angle = span_rad * (static_cast<double>(i) / (views - 1) - 0.5);
    // The first view defines the place of the plate.
    const double error = i == 0 ? 0.0 : error_rad * std::sin(3.0 * i);
    const Eigen::Isometry3d pose = turned(rig, angle + error);
    const Eigen::Vector3d now = pose.linear() * normal;
    const double there = offset + now.dot(pose.translation());
    ArtifactView view{"view " + std::to_string(i), angle, {}, {}, {}};
    for (int y = 60; y < 512; y += 30) {
      for (int x = 60; x < 460; x += 30) {
        const Eigen::Vector2d pixel(x, y);
        const Eigen::Vector3d ray = rig.reference().model.ray(pixel).homogeneous();
        const Eigen::Vector3d point = ray * (there / now.dot(ray));
        const Eigen::Vector3d from_axis = point - rig.turntable->point_mm;
        if ((from_axis - axis * axis.dot(from_axis)).norm() > 45.0) continue;
        view.sites.push_back(noise.site(pixel, point));
        view.surface.push_back(0);
      }
    }
    capture.views.push_back(view);
  }
  capture.surfaces = {
      Eigen::Vector4d(normal.x() + 0.03, normal.y(), normal.z() - 0.02, 0.95 * offset)};
  capture.surfaces[0].head<3>().normalize();
  return capture;
}

ArtifactCapture ball_capture(int views, const Bend& bend = {}) {
  const Rig rig = true_rig();
  const Balls balls{40.0, 70.0};
  const Eigen::Vector3d up = rig.turntable->axis;
  const Eigen::Vector3d middle = rig.turntable->point_mm + 55.0 * up;
  const Eigen::Vector3d along = up.cross(Eigen::Vector3d::UnitZ()).normalized();
  ArtifactCapture capture{balls, {}, {}};
  Noise noise(6, bend);
  const std::vector<Eigen::Vector3d> centers = {middle - 35.0 * along, middle + 35.0 * along};
  for (int i = 0; i < views; ++i) {
    const double angle = 0.25 * (i - 0.5 * (views - 1));
    ArtifactView view{"balls " + std::to_string(i), angle, {}, {}, {}};
    for (int b = 0; b < 2; ++b) {
      const Eigen::Vector3d center = turned(rig, angle) * centers[static_cast<std::size_t>(b)];
      for (int y = 0; y < 512; y += 6) {
        for (int x = 0; x < 512; x += 6) {
          const Eigen::Vector2d pixel(x, y);
          const Eigen::Vector3d ray = rig.reference().model.ray(pixel).homogeneous().normalized();
          const double near = ray.dot(center);
          const double inside = near * near - center.squaredNorm() + 400.0;
          if (inside < 80.0) continue;
          view.sites.push_back(noise.site(pixel, ray * (near - std::sqrt(inside))));
          view.surface.push_back(b);
        }
      }
    }
    capture.views.push_back(view);
  }
  for (const Eigen::Vector3d& center : centers)
    capture.surfaces.emplace_back(center.x() + 0.3, center.y(), center.z() - 0.4, 0.0);
  return capture;
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return deg_from_rad(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Distance of two lines' points across the second line.
double across_mm(const Turntable& found, const Turntable& truth) {
  const Eigen::Vector3d between = found.point_mm - truth.point_mm;
  return (between - truth.axis * truth.axis.dot(between)).norm();
}

void expect_angular_rig(const ArtifactSolution& found) {
  const Rig truth = true_rig();
  const double pitch = std::get<AngularModel>(found.rig.projector.model).pitch_scale;
  EXPECT_NEAR(pitch, kPitch, 5e-4 * kPitch);
  for (const int row : {1, 2}) {
    EXPECT_LT(
        degrees_between(found.rig.projector.rotation.row(row), truth.projector.rotation.row(row)),
        0.02)
        << row;
  }
  EXPECT_LT(degrees_between(found.rig.turntable->axis, truth.turntable->axis), 0.02);
  EXPECT_LT(across_mm(*found.rig.turntable, *truth.turntable), 0.05);
}

TEST(SolveArtifacts, FindsAnAngularRigFromAPlateAndABallBar) {
  const std::vector<ArtifactCapture> captures = {plate_capture(13, 2.1), ball_capture(5)};
  // The balls are found by a rig that a plate alone gave.
  Rig start = solve_artifacts(std::span(captures).first(1), rough_rig()).rig;
  const double scale = true_rig().projector.position_mm.norm() / start.projector.position_mm.norm();
  start.projector.position_mm *= scale;
  start.turntable->point_mm *= scale;
  const ArtifactSolution found = solve_artifacts(captures, start);
  expect_angular_rig(found);
  const Eigen::Vector3d shift = found.rig.projector.position_mm - true_rig().projector.position_mm;
  const Eigen::Vector3d along = true_rig().projector.rotation.row(1);
  EXPECT_LT((shift - along * along.dot(shift)).norm(), 0.3);
  EXPECT_NEAR(found.light_noise, 2.0, 0.2);  // the stated sigma is half of the true one
  EXPECT_NEAR(found.diameters_mm[1][0], 40.0, 0.02);
  EXPECT_EQ(std::count(found.held.begin(), found.held.end(), "scale"), 0);
  EXPECT_EQ(found.held.front(), "shift of the projector along its fringes");
}

TEST(SolveArtifacts, FindsTheWavefrontThatTheDataHolds) {
  const Bend bend{rad_from_deg(0.02), rad_from_deg(-0.01)};
  const std::vector<ArtifactCapture> captures = {plate_capture(13, 2.1, 0.0, bend),
                                                 ball_capture(5, bend)};
  const ArtifactSolution found = solve_artifacts(captures, true_rig());
  expect_angular_rig(found);
  EXPECT_NEAR(found.light_noise, 2.0, 0.2);  // nothing of the bend is left in the residuals
  const Wavefront& wavefront = std::get<AngularModel>(found.rig.projector.model).wavefront;
  const std::array<double, Wavefront::kTerms> truth = {bend.uu, 0.0, 0.0, 0.0, 0.0, bend.vvv};
  ASSERT_EQ(found.parameters.size(), 16U + Wavefront::kTerms);
  for (std::size_t i = 0; i < Wavefront::kTerms; ++i) {
    const auto row = static_cast<Eigen::Index>(16 + i);
    const double sigma = std::sqrt(found.covariance(row, row));
    EXPECT_LT(std::abs(wavefront.coefficients_rad.at(i) - truth.at(i)), 4.0 * sigma)
        << found.parameters[16 + i];
    EXPECT_LT(sigma, rad_from_deg(0.004)) << found.parameters[16 + i];
  }
}

TEST(SolveArtifacts, FindsNoWavefrontInNoise) {
  const ArtifactSolution found = solve_artifacts(
      std::vector<ArtifactCapture>{plate_capture(13, 2.1), ball_capture(5)}, true_rig());
  EXPECT_TRUE(std::get<AngularModel>(found.rig.projector.model).wavefront.is_plane());
  EXPECT_EQ(found.parameters.size(), 16U);
}

TEST(SolveArtifacts, TakesTheScaleFromALengthOrNamesItAsHeld) {
  const std::vector<ArtifactCapture> captures = {plate_capture(13, 2.1)};
  const ArtifactSolution open = solve_artifacts(captures, rough_rig());
  EXPECT_EQ(std::count(open.held.begin(), open.held.end(), "scale"), 1);
  ArtifactSolveOptions options;
  // The projector's shift along its fringes is not determined and keeps its start, so the length
  // that is given is that of a rig with this shift.
  const Rig truth = true_rig();
  const Rig rough = rough_rig();
  const double along = rough.projector.rotation.row(1).dot(rough.projector.position_mm);
  const Eigen::Vector3d axis = truth.projector.rotation.row(1);
  options.baseline_mm = std::hypot(
      (truth.projector.position_mm - axis * axis.dot(truth.projector.position_mm)).norm(), along);
  const ArtifactSolution found = solve_artifacts(captures, rough, options);
  EXPECT_EQ(std::count(found.held.begin(), found.held.end(), "scale"), 0);
  const double pitch = std::get<AngularModel>(found.rig.projector.model).pitch_scale;
  const double sigma = std::sqrt(found.covariance(15, 15));
  ASSERT_EQ(found.parameters[15], "projector.pitch_scale");
  EXPECT_LT(sigma, 2e-3);
  EXPECT_LT(std::abs(pitch - kPitch), 4.0 * sigma);
  EXPECT_LT(degrees_between(found.rig.turntable->axis, truth.turntable->axis), 0.2);
  EXPECT_LT(across_mm(*found.rig.turntable, *truth.turntable),
            std::max(0.05, 5.0 * found.point_sigma_mm));
}

TEST(SolveArtifacts, EstimatesTheAnglesOfATableThatErrs) {
  const double error = rad_from_deg(0.05);
  const ArtifactSolution found = solve_artifacts(
      std::vector<ArtifactCapture>{plate_capture(13, 2.1, error), ball_capture(5)}, true_rig());
  EXPECT_NEAR(deg_from_rad(found.angle_sigma_rad), 0.05 / std::sqrt(2.0), 0.02);
  EXPECT_NEAR(found.angle_errors_rad[0][4], error * std::sin(12.0), 0.3 * error);
  EXPECT_LT(degrees_between(found.rig.turntable->axis, true_rig().turntable->axis), 0.02);
}

TEST(SolveArtifacts, RefusesTooFewViewsAndAngles) {
  const auto fault = [](const ArtifactCapture& capture, const Rig& rig) {
    return testing::error_of(
        [&] { static_cast<void>(solve_artifacts(std::vector<ArtifactCapture>{capture}, rig)); });
  };
  EXPECT_NE(fault(plate_capture(2, 2.1), true_rig()).find("in 2 of at least 3 views"),
            std::string::npos);
  EXPECT_NE(fault(plate_capture(5, 0.2), true_rig()).find("span 11.5 degrees"), std::string::npos);
  Rig without = true_rig();
  without.turntable.reset();
  EXPECT_NE(fault(plate_capture(5, 1.0), without).find("has no [turntable]"), std::string::npos);
}

}  // namespace
}  // namespace frangia
