#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/internal/speckle.h"

namespace frangia {

/// Parameters of one frame: the projected light, the camera settings and the noise stream.
struct Shot {
  double cos_shift = 1.0;
  double sin_shift = 0.0;
  std::uint64_t stream = 0;
  double light = 1.0;         ///< factor on the scene's exposure
  double projector = 1.0;     ///< share of the projector's light that is on
  double gain = 1.0;          ///< factor on the scene's counts per electron
  double black_counts = 0.0;  ///< added to all pixels
  /// Picture of a digital projector that replaces the pattern, linear, 0 to 1.
  const Image<float>* picture = nullptr;
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

  /// All samples of one row, those of a pixel together.
  [[nodiscard]] std::vector<LightSample> sample_row(int y) const;

  /// Fills row y of all frames of one pattern; T is their pixel type.
  template <typename T>
  void fill_row(int y,
                std::span<const LightSample> samples,
                const std::vector<Shot>& shots,
                FrameStack& stack) const;

 private:
  [[nodiscard]] const Speckle& speckle_at(int x, int y) const {
    return speckle_.empty() ? no_speckle_ : speckle_(x, y);
  }
  void mean_light(const Pattern& pattern,
                  std::span<const LightSample> samples,
                  const std::vector<Shot>& shots,
                  const Speckle& speckle,
                  std::vector<double>& light) const;
  [[nodiscard]] double projected(const Pattern& pattern,
                                 std::size_t frame,
                                 const LightSample& sample,
                                 const Shot& shot) const;

  const SimulatedScene& scene_;
  const SimulateOptions& options_;
  Eigen::Isometry3d pose_;
  int samples_across_;
  std::size_t samples_per_px_;
  Image<Speckle> speckle_;
  Speckle no_speckle_;
};

}  // namespace frangia
