#pragma once

#include <array>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/simulate/internal/gather_light.h"
#include "frangia/simulate/internal/shot.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

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
