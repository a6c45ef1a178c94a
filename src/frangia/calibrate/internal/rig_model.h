#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/rig/camera_model.h"

namespace frangia {

constexpr int kIntrinsics = 9;
constexpr int kPose = 6;
constexpr int kShape = 14;

/// Parameters of the bundle adjustment as its solver has them: flat blocks of numbers.
struct RigParameters {
  using Intrinsics = std::array<double, 9>;  ///< fx fy/fx cx cy k1 k2 p1 p2 k3
  using Pose = std::array<double, 6>;        ///< rotation vector, rad; translation, mm
  using Shape = std::array<double, 14>;      ///< aspect, shear, 12 heights in mm

  struct PosedIntrinsics {
    Intrinsics intrinsics{};
    Pose from_reference{};  ///< the identity for the reference camera, and not estimated
  };

  /// The reference camera first.
  std::vector<PosedIntrinsics> cameras = std::vector<PosedIntrinsics>(1);
  Intrinsics projector{};
  Pose projector_from_camera{};
  std::vector<Pose> camera_from_board;  ///< of the reference camera
  Shape board{};
};

/// The rigid transform of a pose.
[[nodiscard]] inline Eigen::Isometry3d isometry_of(const RigParameters::Pose& pose) {
  const Eigen::Vector3d rotation(pose[0], pose[1], pose[2]);
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0.0)
    isometry.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).matrix();
  isometry.translation() = Eigen::Vector3d(pose[3], pose[4], pose[5]);
  return isometry;
}

/// The order of the parameters of all devices and of the board: reference camera, projector, its
/// pose, then intrinsics and pose of each further camera, then the board. The poses of the board
/// follow.
struct RigLayout {
  bool has_projector = true;  ///< false where the projector only labels points
  std::size_t cameras = 1;    ///< with the reference camera

  // NOLINTNEXTLINE(readability-convert-member-functions-to-static) of a layout, like the others
  [[nodiscard]] std::size_t projector() const { return kIntrinsics; }
  // NOLINTNEXTLINE(readability-convert-member-functions-to-static)
  [[nodiscard]] std::size_t projector_pose() const { return 2UL * kIntrinsics; }
  [[nodiscard]] std::size_t camera(std::size_t i) const {
    constexpr std::size_t kPosed = kIntrinsics + kPose;
    return i == 0 ? 0 : kIntrinsics + (i - (has_projector ? 0UL : 1UL)) * kPosed;
  }
  [[nodiscard]] std::size_t board() const { return camera(cameras); }
  [[nodiscard]] std::size_t count() const { return board() + kShape; }
};

/// The blocks of the parameters in the order of their layout, without the poses of the board.
[[nodiscard]] inline std::vector<std::pair<double*, int>> blocks_of(const RigLayout& layout,
                                                                    RigParameters& parameters) {
  std::vector<std::pair<double*, int>> blocks{
      {parameters.cameras.front().intrinsics.data(), kIntrinsics}};
  if (layout.has_projector) {
    blocks.emplace_back(parameters.projector.data(), kIntrinsics);
    blocks.emplace_back(parameters.projector_from_camera.data(), kPose);
  }
  for (std::size_t i = 1; i < parameters.cameras.size(); ++i) {
    blocks.emplace_back(parameters.cameras[i].intrinsics.data(), kIntrinsics);
    blocks.emplace_back(parameters.cameras[i].from_reference.data(), kPose);
  }
  blocks.emplace_back(parameters.board.data(), kShape);
  return blocks;
}

/// Which parameters are estimated. Those that are not keep their values. At first: one focal
/// length, principal point, k1 and pose of each device.
struct RigFreedom {
  explicit RigFreedom(const RigLayout& with) : layout(with), free(with.count(), false) {
    free_device(0);
    if (layout.has_projector) {
      free_device(layout.projector());
      free_pose(layout.projector_pose());
    }
    for (std::size_t i = 1; i < layout.cameras; ++i) {
      free_device(layout.camera(i));
      free_pose(layout.camera(i) + kIntrinsics);
    }
  }

  RigLayout layout;
  std::vector<bool> free;  ///< in the order of the layout

  /// Number of free parameters, poses of the board left out.
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::count(free.begin(), free.end(), true));
  }

 private:
  void free_device(std::size_t first) {
    for (const std::size_t i : {0UL, 2UL, 3UL, 4UL})
      free.at(first + i) = true;
  }
  void free_pose(std::size_t first) {
    for (std::size_t i = 0; i < kPose; ++i)
      free.at(first + i) = true;
  }
};

/// Standard deviations by which those of the observations are multiplied: of the pixels of each
/// camera, and of the projector pixels that it reads.
struct RigNoise {
  explicit RigNoise(std::size_t cameras = 1) : camera(cameras, 1.0), projector(cameras, 1.0) {}

  std::vector<double> camera;
  std::vector<double> projector;
};

/// Values of the height terms at a point of the board: Legendre products of degree 2, 3 and 4 in
/// coordinates that run from -1 to 1 over the board.
template <typename T>
[[nodiscard]] std::array<T, 12> board_height_terms(const T& u, const T& v) {
  const T u2 = 0.5 * (3.0 * u * u - 1.0);
  const T v2 = 0.5 * (3.0 * v * v - 1.0);
  const T u3 = 0.5 * u * (5.0 * u * u - 3.0);
  const T v3 = 0.5 * v * (5.0 * v * v - 3.0);
  const T u4 = 0.125 * (35.0 * u * u * u * u - 30.0 * u * u + 3.0);
  const T v4 = 0.125 * (35.0 * v * v * v * v - 30.0 * v * v + 3.0);
  return {u2, u * v, v2, u3, u2 * v, u * v2, v3, u4, u3 * v, u2 * v2, u * v3, v4};
}

/// A point of the board as it is estimated to be.
struct BoardSite {
  Eigen::Vector2d nominal_mm;  ///< relative to the board's center
  std::array<double, 12> height_terms;

  template <typename T>
  [[nodiscard]] Eigen::Matrix<T, 3, 1> position(const T* shape) const {
    T height(0.0);
    for (std::size_t i = 0; i < height_terms.size(); ++i)
      height += shape[i + 2] * height_terms[i];
    const T y = nominal_mm.y() * (1.0 + shape[0]);
    return {nominal_mm.x() + shape[1] * y, y, height};
  }
};

/// Pixel of a point given in the camera's own frame: pinhole with Brown-Conrady distortion.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 2, 1> project_point(const T* intrinsics,
                                                   const Eigen::Matrix<T, 3, 1>& point) {
  const T x = point.x() / point.z();
  const T y = point.y() / point.z();
  const T r2 = x * x + y * y;
  const T radial = 1.0 + r2 * (intrinsics[4] + r2 * (intrinsics[5] + r2 * intrinsics[8]));
  const T bent_x = x * radial + 2.0 * intrinsics[6] * x * y + intrinsics[7] * (r2 + 2.0 * x * x);
  const T bent_y = y * radial + intrinsics[6] * (r2 + 2.0 * y * y) + 2.0 * intrinsics[7] * x * y;
  return {intrinsics[0] * bent_x + intrinsics[2],
          intrinsics[0] * intrinsics[1] * bent_y + intrinsics[3]};
}

/// The intrinsics of a model as an adjustment has them: fx fy/fx cx cy k1 k2 p1 p2 k3.
[[nodiscard]] std::array<double, 9> intrinsics_block(const CameraModel& model);

/// The model with these intrinsics; its further coefficients of distortion stay.
[[nodiscard]] CameraModel with_intrinsics(CameraModel model, const std::array<double, 9>& values);

}  // namespace frangia
