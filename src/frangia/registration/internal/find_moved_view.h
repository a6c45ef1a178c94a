#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {

/// Share of a view's comparisons, in both directions, that violate free space: a point of one view
/// lies in front of the surface that the other view measured along the same ray. About 0.002 when
/// nothing moved.
///
/// @missing  0 for a view that shares no surface with another
[[nodiscard]] double free_space_violation(const BundleSums& sums, std::size_t view);

/// The same share over the comparisons of all views.
[[nodiscard]] double free_space_violation(const BundleSums& sums);

/// A view that was taken after the part had moved.
struct MovedView {
  std::size_t view = 0;
  std::optional<std::size_t> alternative;  ///< without this view instead, the others fit as well
};

struct MovedViewOptions {
  double reach_mm = 0.0;  ///< largest distance of corresponding surfaces at the start
  int max_iterations = 30;
  double suspicious_violation = 0.02;  ///< of any one view, to search at all: ten times what edges
                                       ///< and stray points cause
  std::size_t max_candidates = 10;     ///< one optimization each
  double max_remaining = 0.7;          ///< share of the violations that may remain without the
                                       ///< view; of two moved views, one causes about half
  double no_violation = 0.005;         ///< below this share, the remaining views fit
};

/// Finds the view without which the others fit.
///
/// Each of the views with the most violations is left out in turn, and the others are optimized
/// again: a moved view distorts the whole bundle, so that it need not have the most violations
/// itself.
///
/// @missing  none when no view is suspicious, or the others fit no better without any one of them
[[nodiscard]] std::optional<MovedView> find_moved_view(Bundle& bundle,
                                                       const SurfelLists& surfels,
                                                       const MovedViewOptions& options,
                                                       const Run& run = {});

}  // namespace frangia
