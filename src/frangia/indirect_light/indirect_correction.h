#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/indirect_light/indirect_phase.h"
#include "frangia/indirect_light/surface_light.h"
#include "frangia/indirect_light/view_light.h"
#include "frangia/range/range_grid.h"
#include "frangia/views/view.h"

namespace frangia {

/// Applies the prediction of indirect light to the points of views. `rays` are those of the pixels
/// of each view.
class IndirectCorrection {
 public:
  /// `moves_points` is false for points that two directions of fringes determine: they stay where
  /// they are, and the predicted error is part of their sigma. `collected` is light in the poses of
  /// the views; views in other poses take longer.
  IndirectCorrection(std::shared_ptr<const SurfaceLight> collected,
                     double albedo,
                     PhaseSource source,
                     bool moves_points)
      : collected_(std::move(collected)),
        albedo_(albedo),
        source_(source),
        moves_points_(moves_points) {}

  /// Moves points to the depths that their phases have without the predicted errors, and removes
  /// those with a wrong order and those at the rim of the data where indirect light matters.
  void correct(View& view, const Image<Eigen::Vector2f>& rays) const;
  /// Uncertainty of the prediction for each point, along its ray, mm; NaN where there is none.
  [[nodiscard]] Image<float> systematic_mm(const View& view,
                                           const Image<Eigen::Vector2f>& rays) const;
  /// Largest shift of each point's depth that indirect light can cause, where it matters; 0 where
  /// it is small beside the noise, NaN where there is no point.
  [[nodiscard]] Image<float> largest_shifts_mm(const View& view,
                                               const Image<Eigen::Vector2f>& rays) const;
  /// The light at a few pixels of a view.
  [[nodiscard]] ViewLight light_of(const View& view, const Image<Eigen::Vector2f>& rays) const {
    return {collected_->surface(), view, rays, LightUse::FewPixels, collected_.get()};
  }
  /// Uncertainty along its ray that indirect light adds to a point of the view of `light`.
  [[nodiscard]] double sigma_mm(const ViewLight& light, const RangePixel& at) const;

 private:
  [[nodiscard]] double ray_mm_per_rad(const ViewLight& light, const RangePixel& at) const;
  [[nodiscard]] bool is_lit_indirectly(const ViewLight& light, const RangePixel& at) const;
  [[nodiscard]] bool move(const ViewLight& light, RangePixel& at) const;

  [[nodiscard]] const std::vector<Pattern>& patterns() const {
    return collected_->surface().patterns();
  }

  std::shared_ptr<const SurfaceLight> collected_;
  double albedo_;
  PhaseSource source_;
  bool moves_points_;
};

/// What indirect light does to a scan.
struct IndirectLightReport {
  double albedo = 0.0;      ///< reflectance of the surface that explains the frames, 0 to 1
  double affected = 0.0;    ///< share of the points to which it adds more than half of their noise
  double largest_mm = 0.0;  ///< standard uncertainty that it adds, 95th percentile, along the ray
  double noise_mm = 0.0;    ///< median noise of the points
  bool corrected = true;    ///< the points; otherwise sigma counts the whole error

  /// Whether it matters for more than a few points.
  [[nodiscard]] bool is_large() const { return affected > 0.02; }
  /// One sentence without a full stop.
  [[nodiscard]] std::string text() const;
};

/// Warns of indirect light that matters, or notes it.
void announce(const IndirectLightReport& report, const Run& run);

}  // namespace frangia
