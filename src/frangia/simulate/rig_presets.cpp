#include "frangia/simulate/rig_presets.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// The turntable's axis for a camera that looks down on the part by 28 degrees; `forward` is the
/// horizontal viewing direction.
Eigen::Vector3d tilted_axis(const Eigen::Vector3d& forward) {
  constexpr double kDown_rad = rad_from_deg(28.0);
  const Eigen::Vector3d up = -std::cos(kDown_rad) * Eigen::Vector3d::UnitY();
  return (up - std::sin(kDown_rad) * forward.normalized()).normalized();
}

Rig digital() {
  Rig rig;
  rig.reference().model = {.width_px = 960,
                           .height_px = 768,
                           .focal_px = {1800.0, 1800.0},
                           .principal_point_px = {490.45, 377.35},
                           .distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.0}};
  rig.projector.model = PinholeModel{.width_px = 1280,
                                     .height_px = 800,
                                     .focal_px = {1900.0, 1900.0},
                                     .principal_point_px = {639.5, 399.5}};
  rig.projector.position_mm = {-180.0, -20.0, 30.0};
  rig.projector.rotation << 0.931242779706, 0.0, -0.364399348581,  //
      -0.0147420196862, 0.999181334288, -0.0376740503092,          //
      0.364101027328, 0.0404556697031, 0.930480403172;
  rig.turntable = Turntable{{3.5, 50.0, 516.0}, tilted_axis({0.02, 0.0, 1.0})};
  return rig;
}

/// The digital rig with a second camera on the other side of the projector.
Rig binocular() {
  Rig rig = digital();
  // Both cameras look at the axis of the turntable, at the height of a part.
  const Eigen::Vector3d target = rig.turntable->point_mm + 30.0 * rig.turntable->axis;
  PosedCamera posed;
  posed.camera.name = "left";
  posed.camera.model = {.width_px = 960,
                        .height_px = 768,
                        .focal_px = {1810.0, 1810.0},
                        .principal_point_px = {475.2, 388.6},
                        .distortion = {-0.08, 0.04, -3e-4, 2e-4, 0.0}};
  posed.position_mm = {-330.0, -10.0, 95.0};
  const Eigen::Vector3d z = (target - posed.position_mm).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(z).normalized();
  posed.rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  rig.cameras.push_back(posed);
  return rig;
}

/// A laser sheet through the projector that leaves it at an angle from the camera's axis.
LaserSheet laser_sheet_through(const Projector& projector, double angle_rad) {
  const Eigen::Vector3d normal(std::cos(angle_rad), 0.0, std::sin(angle_rad));
  return {normal, normal.dot(projector.position_mm)};
}

/// The paper's set-up: the axes of camera and projector cross under theta0 at O, x0 before the
/// camera.
Rig paper_rig(double focal_px) {
  constexpr double kX0_mm = 490.0;
  constexpr double kProjectorDistance_mm = 1000.0;
  const double theta0 = rad_from_deg(20.0);
  Rig rig;
  rig.reference().model = {.width_px = 512,
                           .height_px = 512,
                           .focal_px = {focal_px, focal_px},
                           .principal_point_px = {255.5, 255.5}};
  rig.projector.model = AngularModel{rad_from_deg(-12.0), rad_from_deg(12.0)};
  rig.projector.position_mm = {kProjectorDistance_mm * std::sin(theta0),
                               0.0,
                               kX0_mm - kProjectorDistance_mm * std::cos(theta0)};
  rig.projector.rotation << std::cos(theta0), 0.0, std::sin(theta0),  //
      0.0, 1.0, 0.0,                                                  //
      -std::sin(theta0), 0.0, std::cos(theta0);
  rig.laser_sheet = laser_sheet_through(rig.projector, theta0);
  rig.turntable = Turntable{{0.0, 55.0, kX0_mm}, {0.0, -1.0, 0.0}};
  return rig;
}

/// 12.5 mm focal length, pixels of 8 um: a field of 160 mm.
Rig carducci() {
  return paper_rig(12.5 / 0.008);
}

Rig angular() {
  Rig rig = paper_rig(1000.0);
  rig.laser_sheet = laser_sheet_through(rig.projector, rad_from_deg(20.5));
  // The axis lies in the laser sheet, so that the line crosses the part at every height.
  const Eigen::Vector3d& normal = rig.laser_sheet->normal;
  const double z_mm = 516.0;
  rig.turntable =
      Turntable{{(rig.laser_sheet->offset_mm - normal.z() * z_mm) / normal.x(), 50.0, z_mm},
                tilted_axis(normal.cross(Eigen::Vector3d::UnitY()))};
  return rig;
}

using RigMaker = Rig (*)();

constexpr std::array<std::pair<std::string_view, RigMaker>, 4> kRigs{
    {{"digital", digital}, {"binocular", binocular}, {"angular", angular}, {"carducci", carducci}}};

}  // namespace

std::vector<std::string> rig_preset_names() {
  std::vector<std::string> names;
  names.reserve(kRigs.size());
  for (const auto& rig : kRigs)
    names.emplace_back(rig.first);
  return names;
}

Rig rig_preset(std::string_view name) {
  for (const auto& rig : kRigs) {
    if (rig.first == name) return rig.second();
  }
  throw Error(ErrorKind::Input,
              fmt::format("there is no built-in rig \"{}\"; choose one of {}, or name a rig.toml",
                          name,
                          fmt::join(rig_preset_names(), ", ")));
}

}  // namespace frangia
