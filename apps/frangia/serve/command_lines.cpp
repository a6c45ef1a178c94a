#include "command_lines.h"

#include <string>
#include <vector>

namespace frangia {

CommandLines command_lines(const ProjectProgress& project) {
  CommandLines lines;
  const ProjectFolder& folder = project.folder;
  if (project.can_scan && project.stations > 0) {
    lines["scan"] = {"frangia",
                     "scan",
                     folder.rig().string(),
                     "-o",
                     folder.scan.string(),
                     "--views",
                     std::to_string(project.stations)};
  }
  if (project.scan_complete) {
    lines["reconstruct"] = {
        "frangia", "reconstruct", folder.scan.string(), "-o", folder.surface().string()};
  }
  if (project.has_surface) {
    std::vector<std::string> edit = {"frangia", "edit", folder.surface().string()};
    for (const EditStep& step : project.steps) {
      edit.push_back("--" + step.operation);
      if (!step.value.empty()) edit.push_back(step.value);
    }
    edit.insert(edit.end(), {"-o", (folder.exports() / (folder.name + ".dxf")).string()});
    lines["edit"] = edit;
  }
  return lines;
}

}  // namespace frangia
