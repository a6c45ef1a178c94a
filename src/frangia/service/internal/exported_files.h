#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// What an exported file was made from.
struct ExportOrigin {
  int version = 0;   ///< number of the SurfaceVersion
  int revision = 0;  ///< of the SurfaceVersions
};

/// A file in a project's exports.
struct ExportEntry {
  std::string name;
  std::size_t bytes = 0;
  std::optional<ExportOrigin> origin{};  ///< none: not a surface, or not known
};

/// Files in a project's exports, by name.
[[nodiscard]] std::vector<ExportEntry> exports_of(const ProjectFolder& project);

/// What an export left.
struct WrittenExport {
  std::vector<ExportEntry> exports;  ///< of the project from then on
  bool unconfirmed = false;          ///< the disk did not confirm the last step
};

/// Writes an export: `write` makes the file at the path that it is given. It appears under its name
/// when it and its origin are on the disk; until then, and after a failure, the one before stays.
///
/// @errors   as `write`; Error(File); Error(Cancelled)
[[nodiscard]] WrittenExport write_export(
    const ProjectFolder& project,
    const std::string& name,
    std::optional<ExportOrigin> origin,
    const std::function<void(const std::filesystem::path&)>& write,
    const Run& run);

}  // namespace frangia
