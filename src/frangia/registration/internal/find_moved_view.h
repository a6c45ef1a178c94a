#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {

/// Share of the pairs of a view that cannot be: points of one before what the other saw, where it
/// would have seen them. About 0.002 where nothing moved.
///
/// missing  0 for a view that looks where no other does
[[nodiscard]] double free_space_violation(const BundleSums& sums, std::size_t view);

/// The same of all pairs.
[[nodiscard]] double free_space_violation(const BundleSums& sums);

/// A view from a part that was moved.
struct MovedView {
  std::size_t view = 0;
  std::optional<std::size_t> alternative;  ///< the others fit as well without this one instead
};

struct MovedViewOptions {
  double reach_mm = 3.0;  ///< how far surfaces that are one may lie apart at the start
  int max_iterations = 30;
};

/// The view without which the others agree. Views that others contradict are left out in turn, and
/// the rest settled anew: a moved view bends the whole bundle, so that it need not look the worst.
///
/// missing  none when nothing is contradicted, or the rest agrees no better without any one view
[[nodiscard]] std::optional<MovedView> find_moved_view(Bundle& bundle,
                                                       const SurfelLists& surfels,
                                                       const MovedViewOptions& options,
                                                       const Run& run = {});

}  // namespace frangia
