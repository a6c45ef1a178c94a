#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/indirect_light/lit_surface.h"
#include "frangia/indirect_light/surface_light.h"
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

/// What the prediction for the pixels of a view is for. Interpolated light differs from the nodes
/// around it by at most the stated share of the direct light, or of itself.
enum class LightUse {
  FewPixels,  ///< each is traced
  /// Of all pixels: 0.5 % (0.005 rad, as the noise of fine fringes), or a tenth of itself.
  Correction,
  Uncertainty,  ///< of all pixels: 3 %, or a quarter of itself
};

/// The indirect light that one view sees, predicted at the nodes of grids of pixels and
/// interpolated between them. Where neighbouring nodes differ, as at a crease, a finer grid
/// follows; where the finest differs too, each pixel is traced. The absolute phase of indirect
/// fringes varies slowly, so the nodes may be farther apart than a fringe.
class ViewLight {
 public:
  /// `surface`, `rays` and `collected` must outlive it. With `collected`, light is interpolated in
  /// the poses that it knows.
  ///
  /// @shape    `view.range` and `rays` w x h
  ViewLight(const LitSurface& surface,
            const View& view,
            const Image<Eigen::Vector2f>& rays,
            LightUse use,
            const SurfaceLight* collected = nullptr);

  /// The indirect light of the point of a pixel at this depth.
  ///
  /// @missing  zero for a point that the surface's own shadow covers
  [[nodiscard]] IndirectShare at(int x, int y, double depth_mm) const;
  /// The same; a point in the shadow or in a gap of the surface has the light of the nearest pixels
  /// around it whose points are lit.
  ///
  /// @missing  zero for a point with none of them within 8 pixels
  [[nodiscard]] IndirectShare near(int x, int y, double depth_mm) const;

  [[nodiscard]] const Image<Eigen::Vector2f>& rays() const { return rays_; }  ///< as given

 private:
  struct Node {
    double depth_mm = 0.0;  ///< 0: no surface, or not needed
    PointLight light;

    [[nodiscard]] bool is_lit() const { return depth_mm > 0.0 && light.direct > 0.0; }
  };
  struct Grid {
    int step_px = 1;
    int columns = 0;  ///< of nodes
    int rows = 0;
    std::vector<Node> nodes;  ///< row by row
    /// Whether the nodes around a cell differ; a cell has the index of its upper left node.
    std::vector<char> varies;

    [[nodiscard]] std::size_t cell_of(int x, int y) const;
    [[nodiscard]] const Node& corner(std::size_t cell, int number) const;
    [[nodiscard]] bool touches_varying(int x, int y) const;
  };
  [[nodiscard]] Node trace(int x, int y) const;
  [[nodiscard]] Node interpolate(int x, int y, double depth_mm) const;
  [[nodiscard]] Node nearest_lit(int x, int y, double depth_mm) const;
  [[nodiscard]] IndirectShare share_of(const PointLight& light,
                                       int x,
                                       int y,
                                       double depth_mm) const;
  [[nodiscard]] Grid grid(int step_px, const View& view) const;
  [[nodiscard]] bool differ(const Grid& grid, std::size_t cell) const;

  const LitSurface& surface_;
  const SurfaceLight* collected_;
  std::optional<std::size_t> pose_;  ///< of the view in `collected_`; none: each node is traced
  Eigen::Isometry3d rig_from_object_;
  Eigen::Isometry3d object_from_rig_;
  const Image<Eigen::Vector2f>& rays_;
  double slope_per_px_;      ///< depth over distance of one pixel at 75 degrees of incidence
  double most_difference_;   ///< of neighbouring nodes that is allowed, of the direct light
  double relative_;          ///< difference of neighbouring nodes that is allowed, of their light
  std::vector<Grid> grids_;  ///< coarse to fine
};

}  // namespace frangia
