#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/range/camera_phases.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {

/// How another camera sees a point on the ray of a pixel.
struct OtherSight {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();      ///< in the frame of the other camera
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();      ///< of the other camera
  Eigen::Vector2d px_per_mm = Eigen::Vector2d::Zero();  ///< change of `pixel` with depth
  bool visible = false;                                 ///< all directions of fringes are measured
  std::array<PhaseSample, 2> phases{};                  ///< one for each direction
};

/// The least-squares depth of a pixel.
struct CommonDepth {
  double depth_mm = 0.0;       ///< NaN: not determined
  double sigma_mm = 0.0;       ///< noise along the optical axis
  double systematic_mm = 0.0;  ///< along the optical axis
};

/// The difference between a pixel's depth and that of another camera, and its uncertainty.
struct DepthDifference {
  double mm = 0.0;             ///< NaN: nothing to compare
  double sigma_mm = 0.0;       ///< noise
  double systematic_mm = 0.0;  ///< of the shared systematic part of the phases
};

/// Computes points of one camera from its own phases and those of other cameras.
class CommonPoint {
 public:
  /// The arguments must outlive this object. `own` is the index of the camera whose pixels are
  /// computed.
  CommonPoint(std::span<const CameraPhases> cameras,
              std::span<const std::vector<PhaseSampler>> samplers,
              std::size_t own);

  /// The pixel of camera `other` that images the point at a depth on a ray; NaN behind it.
  [[nodiscard]] Eigen::Vector2d pixel_of(std::size_t other,
                                         const Eigen::Vector3d& ray,
                                         double depth_mm) const;

  /// How camera `other` sees the point at a depth on the ray of a pixel.
  [[nodiscard]] OtherSight sight(std::size_t other,
                                 const Eigen::Vector3d& ray,
                                 double depth_mm) const;

  /// Compares the depth of pixel (x, y) that follows from its own phases, or, with a label, the two
  /// rays.
  ///
  /// @missing  NaN where the other camera does not see the point, and for a label with one
  /// direction
  [[nodiscard]] DepthDifference compare(int x,
                                        int y,
                                        double depth_mm,
                                        const OtherSight& seen) const;

  /// The least-squares depth of pixel (x, y) from its own phases and those of `others`.
  [[nodiscard]] CommonDepth solve(int x,
                                  int y,
                                  double start_mm,
                                  std::span<const std::size_t> others,
                                  std::span<const double> px_per_px) const;

 private:
  /// One measured phase: its difference from the projector's phase at the point, and the change of
  /// this difference with depth.
  struct Observation {
    double rad = 0.0;
    double rad_per_mm = 0.0;
    double sigma_rad = 0.0;
    double systematic_rad = 0.0;
    double uncancelled = 0.0;  ///< share of the systematic part that interpolation does not share
  };
  /// The projector's phase of a direction at a depth and its change with depth; 0 for a label.
  struct Shown {
    double rad = 0.0;
    double rad_per_mm = 0.0;
  };
  [[nodiscard]] Shown shown(std::size_t direction,
                            const Eigen::Vector3d& ray,
                            double depth_mm) const;
  [[nodiscard]] Observation own_phase(int x,
                                      int y,
                                      std::size_t direction,
                                      const Shown& shown) const;
  [[nodiscard]] Observation other_phase(const OtherSight& seen,
                                        std::size_t direction,
                                        const Shown& shown) const;
  [[nodiscard]] DepthDifference compare_rays(int x, int y, const OtherSight& seen) const;

  std::span<const CameraPhases> cameras_;
  std::span<const std::vector<PhaseSampler>> samplers_;
  std::size_t own_;
  bool is_label_;
  std::vector<Eigen::Isometry3d> other_from_own_;
};

}  // namespace frangia
