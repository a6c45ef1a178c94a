#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/inspect/deviation.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// Deviations of a mesh and the decisions about its tolerance. Shares are of the area of the
/// compared vertices, a third of their triangles'.
struct DeviationSummary {
  std::array<std::size_t, kDeviationStatuses> count{};  ///< of vertices, by `DeviationStatus`
  double area_mm2 = 0.0;                                ///< of the compared vertices
  double mean_mm = kMissing;                            ///< signed, weighted by area
  double rms_mm = kMissing;                             ///< weighted by area
  double min_mm = kMissing;                             ///< smallest signed deviation
  double max_mm = kMissing;                             ///< largest signed deviation
  double median_u_mm = kMissing;  ///< standard uncertainty; NaN when none is known
  double in_share = 0.0;          ///< proven to be within the limits
  double out_share = 0.0;         ///< proven to be beyond a limit
  double undecided_share = 0.0;   ///< neither
  /// Of the part: out when a deviation is beyond the limits by the guard band of that many values,
  /// in when every compared vertex is in, otherwise undecided; undecided where no area is compared.
  Conformity verdict = Conformity::Undecided;
  ToleranceLimits limits;  ///< that it was decided by
};

/// Decides about each vertex by ISO 14253-1.
///
/// @shape    one for each vertex
/// @missing  undecided for vertices that were not compared; without any sigma, the deviations
///           alone decide
[[nodiscard]] std::vector<Conformity> conformities(const Deviations& deviations,
                                                   const ToleranceLimits& limits);

/// Sums up the deviations of a mesh.
///
/// @units    mm
/// @errors   Error(Input) as ToleranceLimits::check
[[nodiscard]] DeviationSummary summarize(const Mesh& mesh,
                                         const Deviations& deviations,
                                         const ToleranceLimits& limits);

/// Share of the compared area in each of `bins` equal intervals from `low` to `high`; values beyond
/// an end count in the last interval on that side.
///
/// @errors   Error(Input) without bins or when `low` is not below `high`
[[nodiscard]] std::vector<float> deviation_histogram(const Mesh& mesh,
                                                     const std::vector<float>& deviation_mm,
                                                     double low,
                                                     double high,
                                                     std::size_t bins);

}  // namespace frangia
