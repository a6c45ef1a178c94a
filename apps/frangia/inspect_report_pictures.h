#pragma once

#include <vector>

#include "inspect_report.h"

namespace frangia {

/// The pictures of a report, the one with the worst place first. What is out or undecided, the
/// extremes and the characteristics are labelled.
[[nodiscard]] std::vector<ReportPicture> report_pictures(const InspectArguments& arguments,
                                                         const InspectedPart& part,
                                                         const Run& run);

}  // namespace frangia
