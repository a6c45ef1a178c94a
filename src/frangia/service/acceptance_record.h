#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/acceptance/acceptance_plan.h"
#include "frangia/acceptance/acceptance_result.h"
#include "frangia/geometry/mesh.h"
#include "frangia/service/part_series.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// An arrangement of the artifact that was measured in a project.
struct MeasuredArrangement {
  std::string project;                ///< its name
  ArrangementResult result;           ///< at the temperature of the artifact
  std::vector<std::string> warnings;  ///< of the reconstruction
};

/// An acceptance test in the app: the artifact and its limits, and the arrangements that were
/// measured, each in a project of one series.
struct AcceptanceRecord {
  AcceptancePlan plan;                            ///< with the scans of the arrangements
  std::vector<MeasuredArrangement> arrangements;  ///< in the order of the series
};

/// Keeps the artifact, limits and conditions of a project's test as acceptance.toml; with an empty
/// text the project tests nothing any more, and what it measured is removed.
///
/// @errors   Error(Input) as parse_acceptance_plan, then nothing changes; Error(File)
void write_acceptance(const ProjectFolder& project, const std::string& text);

/// Measures the artifact in the surface of a project, and keeps what was found.
///
/// @errors   Error(Input) as measure_balls; Error(File); Error(Cancelled)
void measure_arrangement(const ProjectFolder& project,
                         const AcceptancePlan& plan,
                         const std::string& name,
                         const Mesh& mesh,
                         const std::vector<std::string>& warnings,
                         const Run& run);

/// Gives the next project of a series the artifact and the limits of the one before.
///
/// @errors   Error(File)
void copy_acceptance(const ProjectFolder& before, const ProjectFolder& next);

/// The test of a project with the arrangements of all projects of its series, or nothing. What is
/// damaged counts as not measured.
[[nodiscard]] std::optional<AcceptanceRecord> read_acceptance(const ProjectLibrary& library,
                                                              const ProjectFolder& project);

/// The results of a record, at 20 degrees Celsius.
[[nodiscard]] std::vector<ArrangementResult> results_at_20(const AcceptanceRecord& record);

/// The record as docs/service-schema.json describes it.
///
/// @missing  what is not known is null
[[nodiscard]] nlohmann::ordered_json json_of(const AcceptanceRecord& record);

}  // namespace frangia
