#pragma once

#include <cstddef>
#include <optional>
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

/// The one view that is in all contradictions above `limit`: without it the others have none, and
/// without any other view some remain. Nothing where no view or several are such.
[[nodiscard]] std::optional<std::size_t> contradicting_view(const BundleSums& sums,
                                                            const SurfelLists& surfels,
                                                            double limit);

/// The one view whose regions are off from those of the others by more than noise, while the
/// others agree. Nothing where no view or several are such.
[[nodiscard]] std::optional<std::size_t> disagreeing_view(const BundleSums& sums);

}  // namespace frangia
