#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/inspection/inspect_part.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// A part of a series: parts of one kind, each in a project of its own, inspected by the same plan.
struct SeriesPart {
  std::string project;                       ///< its name
  std::string serial;                        ///< of the part; may be empty
  std::string verdict;                       ///< in, out or undecided; empty: it was not inspected
  std::vector<MeasuredCharacteristic> rows;  ///< that were measured; see `write_series_results`
};

/// At most, the newest, are shown of a series.
inline constexpr std::size_t kMostSeriesParts = 50;

/// Keeps what the inspection of a project found, for the table of its series: name, unit, nominal,
/// limits, value, U95 and decision of each characteristic.
///
/// @errors   Error(File) when the file cannot be written
void write_series_results(const ProjectFolder& project,
                          const Inspection& found,
                          const InspectionPlan& plan);

/// Prepares a project for the next part: it gets rig, settings of the capture, reference, plan,
/// acceptance test and the series of the one before, whose part is added. The serial number is left
/// out of the plan. `next` is new and empty.
///
/// @errors   Error(File) when something cannot be copied
void prepare_next_part(const ProjectFolder& before,
                       const std::optional<InspectionPlan>& plan,
                       const ProjectFolder& next);

/// The parts before the one of a project, the oldest first; those whose project is gone are left
/// out.
[[nodiscard]] std::vector<SeriesPart> read_series(const ProjectLibrary& library,
                                                  const ProjectFolder& project);

/// @missing  what is not known is null
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<SeriesPart>& series);

}  // namespace frangia
