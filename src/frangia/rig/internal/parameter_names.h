#pragma once

#include <array>
#include <string>
#include <string_view>

namespace frangia {

/// Names of the parameters of a rig in a covariance, without their device.
constexpr std::array kIntrinsicNames = {
    "focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array kPoseNames = {
    "rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_mm", "y_mm", "z_mm"};
constexpr std::string_view kCameraPrefix = "camera.";
constexpr std::string_view kProjectorPrefix = "projector.";
constexpr std::string_view kPitchScaleName = "projector.pitch_scale";

/// The device of the parameters of a camera beside the reference camera.
[[nodiscard]] inline std::string camera_prefix(const std::string& camera) {
  return "camera-" + camera + ".";
}

}  // namespace frangia
