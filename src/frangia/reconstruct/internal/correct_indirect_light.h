#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/indirect_correction.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// What was found out about the indirect light of a scan before its registration.
struct EarlyIndirectLight {
  bool found = true;       ///< false: it was looked for and not found
  bool corrected = false;  ///< the views are corrected by it
  /// False: the correction made the views rougher, and they stay as they were measured.
  bool corrects = true;
  std::optional<IndirectPart> part{};      ///< what was found
  std::vector<Eigen::Isometry3d> poses{};  ///< of the views, in which `part` was found
};

/// Corrects views that are not registered yet by the indirect light that coarse surfaces of every
/// few pixels predict. Otherwise views of a concave part contradict the others. A correction that
/// makes the views rougher is taken back.
///
/// @errors   as indirect_part
[[nodiscard]] EarlyIndirectLight correct_before_registration(MeasuredViews& measured,
                                                             const LitScan& lit,
                                                             const FusionOptions& fusion,
                                                             const Run& run);

/// Corrects registered views likewise. What was found in views that stay as they were measured, and
/// that the registration left in their poses, holds and is not looked for again. A correction that
/// makes the views rougher is taken back, up to that before the registration, and all of the
/// predicted error is counted. `fusion` gets the systematic part of the prediction; it refers to
/// the rays of `lit`. Warns where indirect light matters; returns nothing where there is none.
///
/// @errors   as indirect_part
[[nodiscard]] std::optional<IndirectLightReport> correct_indirect_light(
    MeasuredViews& measured,
    const LitScan& lit,
    const EarlyIndirectLight& before,
    FusionOptions& fusion,
    const Run& run);

/// Counts the indirect light that a coarse surface of the views of several cameras predicts in the
/// sigma of the points of every camera. Points stay where they are, because the phases of several
/// cameras determine them: the whole predicted error enters sigma. `fusion` gets this systematic
/// part. Warns where indirect light matters; returns nothing where there is none.
///
/// @errors   as indirect_part
[[nodiscard]] std::optional<IndirectLightReport> count_indirect_light(const MeasuredViews& measured,
                                                                      const LitScan& lit,
                                                                      FusionOptions& fusion,
                                                                      const Run& run);

}  // namespace frangia
