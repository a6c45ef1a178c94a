#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/registration_report.h"
#include "frangia/views/view_store.h"

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

/// What the pairs of views tell of the places of the views.
enum class Overlap : std::uint8_t {
  Determines,  ///< the state of the bundle, as well as the equations of the pairs state
  SaysNothing  ///< too few points overlap, or they let the views slide: the rig's places are kept
};

/// Returns the error that the pairs of two views have in common, as the mean distances of the
/// regions of the views show it; `systematic_mm` of the bundle where too few regions are compared.
[[nodiscard]] double shared_error_mm(const Bundle& bundle, const BundleSums& sums);

/// Sets how uncertain the places of the views are: `rests_on_rig`, `sigma`, `motions`, and how far
/// the views disagree where they overlap although the rig's places are kept.
///
/// @shape    `sums` in the state of the bundle; `offset`: from a state that is kept although
///           another fits as well to that one, in the unknowns
void assess_places(RegistrationReport& report,
                   const Bundle& bundle,
                   const BundleSums& sums,
                   const RegisterOptions& options,
                   Overlap overlap,
                   const Eigen::VectorXd& offset);

/// Surfels of a view that registration compares while it looks for the state of the table.
[[nodiscard]] inline std::size_t surfels_to_explain(std::size_t views) {
  return surfels_per_view(2500, views);
}

/// A registration in progress.
struct Registration {
  Bundle bundle;
  SurfelLists surfels;
  double reach_mm;
  ViewStore& views;
  std::span<const Station> stations;
  const RegisterOptions& options;
  const Run& run;
  double angle_factor = 1.0;  ///< of the commanded angles, in `bundle.given`
  /// The one view that is in all contradictions of the views.
  std::optional<std::size_t> contradicting{};

  [[nodiscard]] std::string name_of(std::size_t view) const { return stations[view].label(view); }
  void optimize_again();  ///< from the given state on
  void leave_out(std::size_t view);
};

/// Whether no view contradicts the others or fits none, by the pairs of some places.
[[nodiscard]] bool fits(const BundleSums& sums, const Registration& work);

/// Whether the table places all views so.
[[nodiscard]] bool fits_by_table(const Registration& work);

/// Leaves out views that fit no other one.
void leave_out_outliers(RegistrationReport& report, Registration& work);

/// The single view without which the registration would be trusted: the others agree.
[[nodiscard]] std::optional<std::size_t> view_at_fault(const RegistrationReport& report,
                                                       const Registration& work);

}  // namespace frangia
