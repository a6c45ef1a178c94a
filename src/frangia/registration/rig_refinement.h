#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/rig/rig.h"

namespace frangia {

/// One parameter of a rig after the refinement.
struct RefinedParameter {
  std::string name;          ///< as in the covariance of the calibration
  double change = 0.0;       ///< from the given rig
  double prior_sigma = 0.0;  ///< of calibration and drift together
  double sigma = 0.0;        ///< after the refinement
  bool determined = false;   ///< `sigma` is less than a third of `prior_sigma`
};

/// A refined rig and how well the surfaces determine it.
struct RigRefinement {
  Rig rig;  ///< with axis and covariance; the given one, at most scaled, when `kept_rig`
  bool kept_rig = false;                     ///< the given rig fits as well
  std::vector<RefinedParameter> parameters;  ///< all that were free to change
  std::size_t directions = 0;                ///< independent changes of the parameters
  std::size_t held = 0;                      ///< of them, those that the surfaces do not determine
  /// Those that may have changed by more than twice what their standard deviations allow, by which
  /// the surfaces are better explained.
  std::vector<std::string> beyond_prior;
  double rms_before_mm = 0.0;  ///< of the distances between views, axis and angles refined alone
  double rms_after_mm = 0.0;   ///< the same with the refined rig
  std::vector<double> angles_rad;  ///< of each station, refined
  double axis_moved_mm = 0.0;      ///< distance of the refined axis from the given one
  double scale = 1.0;              ///< by which a known length changed all lengths of the rig

  /// The findings in words: clauses separated by semicolons.
  [[nodiscard]] std::string text() const;
};

}  // namespace frangia
