#pragma once

#include <string>
#include <vector>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Limits of a check.
struct CheckRigOptions {
  CalibrateArtifactsOptions measure;  ///< search for plates and balls
  /// Deviation that is allowed, mm. 0: three standard deviations of the measurement and of the
  /// calibration's covariance, and `floor_share` of the distance.
  double tolerance_mm = 0.0;
  /// Share of the distance that a sound rig may deviate by on top of its covariance: an excellent
  /// calibration, 0.025 mm at half a metre.
  double floor_share = 5e-5;
  /// Distance up to which points of two views are taken as the same place, as a share of their
  /// distance from the camera. A rig that is further off has too few of them.
  double match_share = 0.02;
  int part_sites = 200;  ///< along the longer side of the image, on a part
};

/// One figure of a check.
struct RigCheckItem {
  std::string name;           ///< "spacing", "flatness", ...
  double deviation_mm = 0.0;  ///< from what is known: 0 is perfect
  double sigma_mm = 0.0;      ///< standard uncertainty of the deviation
  double limit_mm = 0.0;      ///< largest magnitude of the deviation that passes
  std::string measured;       ///< the measurement in words, with its unit

  [[nodiscard]] bool passed() const;  ///< false also for a NaN
};

/// Whether a rig still measures what it did.
struct RigCheck {
  std::string kind;                   ///< of the artifact, or "part"
  std::size_t views = 0;              ///< that were used
  std::vector<std::string> left_out;  ///< folders of views without the artifact
  double distance_mm = 0.0;           ///< mean distance of the points
  double calibration_sigma_mm = 0.0;  ///< of a point by the covariance; 0 where it is not known
  std::vector<RigCheckItem> items;    ///< at least one

  [[nodiscard]] bool passed() const;  ///< all items passed
};

/// Compares what a rig measures with what is known: spacing and diameters of a ball bar and where
/// the balls stand in each view, the flatness of a plate, and how far the views of a turned part
/// disagree. Each camera of the rig is checked, and further ones are compared with the reference
/// camera; their figures end with ", camera NAME".
///
/// @errors   Error(Input) when the projector is a label, or the artifact is not found or is a
/// screen, or no view of
///           a part to compare with, or the rig has no turntable and there are several views;
///           Error(Numeric) when the views of a part share too few points
[[nodiscard]] RigCheck calibrate_check(const Scan& scan,
                                       const Rig& rig,
                                       const CheckRigOptions& options = {},
                                       const Run& run = {});

}  // namespace frangia
