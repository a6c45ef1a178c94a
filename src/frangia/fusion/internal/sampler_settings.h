#pragma once

#include <cmath>

#include "frangia/fusion/internal/accumulate_view.h"

namespace frangia {

/// `HermiteOptions` as floats, with cosines in place of angles.
struct SamplerSettings {
  explicit SamplerSettings(const HermiteOptions& options)
      : near_mm(static_cast<float>(options.near_mm)),
        free_space_mm(static_cast<float>(options.free_space_mm)),
        same_face(cosine(options.parameters.same_face_rad)),
        back_face(cosine(options.parameters.back_face_rad)),
        hidden_mm(static_cast<float>(options.parameters.hidden_bands * options.near_mm)),
        clear_sight_px(static_cast<float>(options.parameters.clear_sight_px)),
        clear_sight_mm(
            static_cast<float>(options.parameters.clear_sight_share * options.free_space_mm)),
        free_space_factor(static_cast<float>(options.parameters.free_space_factor)),
        boundary_share(static_cast<float>(options.parameters.boundary_share)),
        boundary_incidence(cosine(options.parameters.boundary_incidence_rad)),
        small_window_incidence(cosine(options.parameters.small_window_incidence_rad)),
        interpolated_variance(static_cast<float>(options.parameters.interpolated_variance)),
        lateral_px(static_cast<float>(options.parameters.lateral_px)),
        boundary_lateral_px(static_cast<float>(options.parameters.boundary_lateral_px)),
        step_lateral_px(static_cast<float>(options.parameters.step_lateral_px)) {}

  static float cosine(double angle_rad) { return static_cast<float>(std::cos(angle_rad)); }

  float near_mm;
  float free_space_mm;
  float same_face;
  float back_face;
  float hidden_mm;
  float clear_sight_px;
  float clear_sight_mm;
  float free_space_factor;
  float boundary_share;
  float boundary_incidence;
  float small_window_incidence;
  float interpolated_variance;
  float lateral_px;
  float boundary_lateral_px;
  float step_lateral_px;
};

}  // namespace frangia
