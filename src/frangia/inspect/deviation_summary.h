#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/inspect/deviation.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// Deviations of the vertices of a mesh, unfiltered. `judge_surface` decides about them.
struct DeviationSummary {
  std::array<std::size_t, kDeviationStatuses> count{};  ///< of vertices, by `DeviationStatus`
  double area_mm2 = 0.0;                                ///< of the compared vertices
  double mean_mm = kMissing;                            ///< signed, weighted by area
  double rms_mm = kMissing;                             ///< weighted by area
  double min_mm = kMissing;                             ///< smallest signed deviation
  double max_mm = kMissing;                             ///< largest signed deviation
  Eigen::Vector3d min_at_mm = Eigen::Vector3d::Zero();  ///< where `min_mm` is
  Eigen::Vector3d max_at_mm = Eigen::Vector3d::Zero();  ///< where `max_mm` is
  double median_u_mm = kMissing;  ///< standard uncertainty; NaN when none is known
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
[[nodiscard]] DeviationSummary summarize(const Mesh& mesh, const Deviations& deviations);

/// How many vertices were not compared, and why: "3 sharp edge, 2 unused", or "none".
[[nodiscard]] std::string left_out_text(const DeviationSummary& summary);

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
