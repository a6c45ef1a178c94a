#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/simulate/internal/gather_light.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/internal/speckle.h"

namespace frangia {

/// The light of one row of pixels.
struct LitRow {
  std::vector<LightSample> samples;                  ///< those of a pixel together
  std::vector<std::vector<GatheredLight>> gathered;  ///< of each pixel; empty: no indirect light
};

/// The seed of a frame's noise. It depends on the frame's identity only, so that a repeated frame
/// is equal.
[[nodiscard]] std::uint64_t noise_stream(std::uint64_t seed,
                                         std::size_t view,
                                         const std::string& pattern,
                                         std::size_t frame);

/// Traces the light of one pose row by row and fills frames. The scene must outlive it.
class ViewRenderer {
 public:
  /// `view` chooses the speckle.
  ViewRenderer(const SimulatedScene& scene,
               const Eigen::Isometry3d& rig_from_object,
               std::size_t view);

  /// The light of row y.
  [[nodiscard]] LitRow sample_row(int y) const;

  /// Fills row y of all frames of one pattern; T is their pixel type.
  template <typename T>
  void fill_row(int y, const LitRow& row, const std::vector<Shot>& shots, FrameStack& stack) const;

 private:
  [[nodiscard]] const Speckle& speckle_at(int x, int y) const {
    return speckle_.empty() ? no_speckle_ : speckle_(x, y);
  }
  void mean_light(const Pattern& pattern,
                  std::span<const LightSample> samples,
                  const std::vector<Shot>& shots,
                  const Speckle& speckle,
                  std::vector<double>& light) const;

  const SimulatedScene& scene_;
  const SimulateOptions& options_;
  Eigen::Isometry3d pose_;
  int samples_across_;
  std::size_t samples_per_px_;
  Image<Speckle> speckle_;
  Speckle no_speckle_;
};

}  // namespace frangia
