#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/pattern/pattern.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

/// Light that reaches the camera from a pixel's point although the projector sent it elsewhere. It
/// stands for a small cell of the lit surface.
struct GatheredLight {
  Eigen::Vector2f at;  ///< projector coordinate of the cell's centre, as in `LightSample`
  /// Extents of the cell along its two sides, in projector coordinates.
  std::array<Eigen::Vector2f, 2> side;
  float diffuse = 0.0F;  ///< the cell's share of the pixel's light when the projector is fully lit
  float line = 0.0F;     ///< share of the laser sheet's peak in the cell
};

/// Collects the indirect light of one camera ray.
///
/// One bounce: the light that other surface points receive, reflected by them as by a Lambertian
/// surface of `SimulateOptions::albedo`, over cosine-weighted directions. Subsurface scattering:
/// the light that enters around the point, with the normalized diffusion profile; it then holds all
/// of the diffuse light of the pixel, and the direct light of `sample_light` does not count.
///
/// Cells are stratified and turned by `turn`, 0 to 1; the same arguments give the same cells.
/// @units    light as in `LightSample`
/// @missing  empty where the ray hits nothing, and without bounce and scattering
/// @source   Christensen and Burley 2015 for the profile
[[nodiscard]] std::vector<GatheredLight> gather_light(const SimulatedScene& scene,
                                                      const Eigen::Isometry3d& rig_from_object,
                                                      const Eigen::Vector2d& ray,
                                                      double turn);

/// Sum of the diffuse light of all cells.
[[nodiscard]] double total_light(const std::vector<GatheredLight>& cells);

/// Sums the indirect light of pixels in all frames of one pattern.
///
/// Light adds, so a fringe pattern needs one complex sum for each harmonic of what the display
/// shows, from which all frames follow. Each cell contributes the mean of the fringe over its
/// extent. Frames without fringes take the light at the cells' centres.
class GatheredLightSum {
 public:
  /// All arguments must outlive it.
  GatheredLightSum(const Pattern& pattern,
                   const std::vector<Shot>& shots,
                   const SimulatedScene& scene);

  /// Adds the light of one pixel's cells to each frame, as a share of white.
  void add_to(std::vector<double>& light, std::span<const GatheredLight> cells) const;

 private:
  static constexpr std::size_t kHarmonics = 4;  ///< with the mean
  void add_fringes(std::vector<double>& light, std::span<const GatheredLight> cells) const;

  const Pattern& pattern_;
  const std::vector<Shot>& shots_;
  const SimulatedScene& scene_;
  bool is_fringe_;
  std::array<double, kHarmonics> amplitudes_{};  ///< of the fringe's cosines; the mean first
};

}  // namespace frangia
