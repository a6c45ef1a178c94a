#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/registration_report.h"
#include "frangia/views/view_store.h"

namespace frangia {

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

  [[nodiscard]] std::string name_of(std::size_t view) const {
    return stations[view].name.empty() ? std::to_string(view) : stations[view].name;
  }
  void optimize_again();  ///< from the given state on
  void leave_out(std::size_t view);
};

/// Whether the table places all views where none contradicts the others or fits none.
[[nodiscard]] bool fits_by_table(const Registration& work);

/// Leaves out views that fit no other one.
void leave_out_outliers(RegistrationReport& report, Registration& work);

/// The single view without which the registration would be trusted: the others agree.
[[nodiscard]] std::optional<std::size_t> view_at_fault(const RegistrationReport& report,
                                                       const Registration& work);

}  // namespace frangia
