#pragma once

#include <optional>
#include <span>
#include <string>

#include "frangia/core/missing.h"
#include "frangia/diagnose/explanation.h"
#include "frangia/pattern/pattern.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What measured the points of a rig twice.
enum class MeasuredTwiceBy {
  Directions,  ///< vertical and horizontal fringes
  Cameras      ///< two cameras
};

/// How well points agree that were measured twice, over all views, and what explains it if they do
/// not.
struct RigAgreement {
  MeasuredTwiceBy by = MeasuredTwiceBy::Directions;  ///< what measured the points twice
  /// Median over the views of the median distance along the rays, or, between cameras with a label,
  /// between the rays.
  double median_mm = kMissing;
  double over_noise = kMissing;   ///< the same over what phase noise explains
  double chi_squared = kMissing;  ///< for each degree of freedom; see `DepthAgreement`
  double beyond = 0.0;        ///< share of the pixels that contradict; see `DepthAgreement::beyond`
  Explanation explanation{};  ///< as described, the rig, or unexplained

  /// Whether noise, systematic parts and calibration explain the differences.
  [[nodiscard]] bool is_consistent() const { return chi_squared < kConsistent; }
  /// Whether the result must not be trusted.
  [[nodiscard]] bool contradicts() const;
  /// One clause without a full stop: what disagrees, by how much, its cause and the remedy.
  [[nodiscard]] std::string text() const;
};

/// Pools what the views say about two directions of fringes, and explains it: as described, by a
/// projector or a camera that is not what the rig states, or not at all.
///
/// The second hypothesis has the pose of the projector, both focal lengths and both principal
/// points as parameters, with broad priors, and is fitted to the differences by triangulating the
/// samples with each trial rig.
///
/// @shape    one for each view that has both; `first` and `second`: the patterns of their phases
/// @missing  empty without pixels
[[nodiscard]] std::optional<RigAgreement> agreement_of_directions(
    std::span<const DepthAgreement> views,
    const Rig& rig,
    const Pattern& first,
    const Pattern& second);

/// The same for two cameras. Which of the devices is at fault is not decided.
[[nodiscard]] std::optional<RigAgreement> agreement_of_cameras(
    std::span<const DepthAgreement> views);

}  // namespace frangia
