#pragma once

#include <set>
#include <string>
#include <vector>

#include "frangia/decode/view_summary.h"
#include "frangia/reconstruct/internal/register_setups.h"

namespace frangia {

/// Adds the names of the views that the registration of a setup emptied.
void add_outliers(std::set<std::string>& names, const MeasuredSetup& setup);

/// Marks as left out the outliers and the views that are not part of the joined setups.
void mark_left_out(std::vector<ViewSummary>& summaries,
                   const MeasuredSetup& joined,
                   const std::set<std::string>& outliers);

}  // namespace frangia
