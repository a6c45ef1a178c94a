#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/reconstruct/setup_join.h"
#include "frangia/registration/register_views.h"

namespace frangia {

/// The views of one clamping of the part, registered among themselves.
struct MeasuredSetup {
  int number = 0;  ///< in scan.toml
  MeasuredViews measured;
  std::optional<RegistrationReport> registration;
  std::vector<SetupJoin> joins;  ///< of all setups, when several were joined to this one
};

/// Splits the views of a scan by their setups, ordered by number. Properties of the whole scan are
/// copied to each setup.
[[nodiscard]] std::vector<MeasuredSetup> split_setups(MeasuredViews all);

/// Adds the names of the views that the registration of a setup emptied.
void add_outliers(std::set<std::string>& names, const MeasuredSetup& setup);

/// Marks as left out the outliers and the views that are not part of the joined setups.
void mark_left_out(std::vector<ViewSummary>& summaries,
                   const MeasuredSetup& joined,
                   const std::set<std::string>& outliers);

}  // namespace frangia
