#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/service/internal/surface_model.h"
#include "frangia/service/job_queue.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"
#include "frangia/service/service.h"

namespace frangia {

/// A file in a project's exports.
struct ExportEntry {
  std::string name;
  std::size_t bytes = 0;
};

/// The open project as the service knows it.
struct OpenProject {
  ProjectFolder folder;
  bool can_scan = false;       ///< its rig names devices
  bool scan_complete = false;  ///< scan.toml exists
  std::vector<ProjectStation> stations;
  std::string summary;  ///< JSON of the reconstruction; empty without one
  SurfacePtr surface;   ///< null without one, or until it is read
  std::vector<ExportEntry> exports;
};

/// All that the state of a service shows.
struct ServiceView {
  std::string version;
  std::vector<ProjectEntry> projects;
  std::optional<OpenProject> project;
  CommandLines commands;  ///< of the project
  std::vector<Job> jobs;
};

/// The state as docs/service-api.md describes it.
[[nodiscard]] std::string state_json(const ServiceView& view);

}  // namespace frangia
