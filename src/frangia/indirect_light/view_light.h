#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/indirect_light/lit_surface.h"
#include "frangia/views/view.h"

namespace frangia {

/// Indirect light of one pixel relative to its direct light, if the surface reflects all light.
struct IndirectShare {
  double mean = 0.0;     ///< of the mean light
  double unknown = 0.0;  ///< what may come from where the surface was not measured
  /// Of the fringes of each pattern: share and phase relative to the direct fringes. A share f
  /// shifts the phase by arg(1 + f).
  std::vector<std::complex<double>> fringes;
};

/// The indirect light that one view sees, predicted at the nodes of a grid of pixels and
/// interpolated where neighbouring nodes have similar light; elsewhere each pixel is traced. The
/// absolute phase of indirect fringes varies slowly, so the nodes may be farther apart than a
/// fringe.
class ViewLight {
 public:
  /// @shape    `view.range` and `rays` w x h
  ViewLight(const LitSurface& surface,
            const View& view,
            const Image<Eigen::Vector2f>& rays,
            int step_px = 6);

  /// The indirect light of the point of a pixel at this depth.
  ///
  /// @missing  zero for a point that the surface's own shadow covers
  [[nodiscard]] IndirectShare at(int x, int y, double depth_mm) const;

 private:
  struct Node {
    double depth_mm = 0.0;  ///< 0: no surface, or not needed
    PointLight light;
  };
  [[nodiscard]] Node trace(int x, int y) const;
  [[nodiscard]] Node interpolate(int x, int y, double depth_mm) const;
  [[nodiscard]] bool varies_little(const PointLight& sum,
                                   double weights,
                                   int column,
                                   int row) const;

  const LitSurface& surface_;
  Eigen::Isometry3d rig_from_object_;
  Eigen::Isometry3d object_from_rig_;
  const Image<Eigen::Vector2f>& rays_;
  int step_px_;
  double slope_per_px_;      ///< depth over distance of one pixel at 75 degrees of incidence
  int columns_;              ///< of nodes
  std::vector<Node> nodes_;  ///< row by row
};

}  // namespace frangia
