#pragma once

#include <cstddef>
#include <vector>

#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {

/// Share of all surfels below which matches are chance.
inline constexpr double kMinOverlap = 0.05;

/// Root mean square. 0 of no distances.
[[nodiscard]] double rms_of(const std::vector<float>& distances);

/// Share of the surfels that lie on a surface of another view.
[[nodiscard]] double overlap_of(const BundleSums& sums, const SurfelLists& surfels);

/// Views whose surfels match other views less often than `outlier_overlap` times those of the
/// median view.
[[nodiscard]] std::vector<std::size_t> find_outliers(const BundleSums& sums,
                                                     double outlier_overlap);

/// Share of all comparisons that violate free space: a point of one view lies in front of the
/// surface that the other view measured along the same ray. About 0.002 when nothing moved.
[[nodiscard]] double free_space_violation(const BundleSums& sums);

/// Largest share of a view's comparisons, in both directions, that violate free space. A view with
/// few comparisons does not count.
[[nodiscard]] double contradiction_of(const BundleSums& sums, const SurfelLists& surfels);

}  // namespace frangia
