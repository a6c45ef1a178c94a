#pragma once

#include <filesystem>
#include <optional>

#include "frangia/dataset/scan_folder.h"
#include "frangia/inspection/inspect_part.h"

#include "inspect_arguments.h"

namespace frangia {

/// Inspects meshes as the arguments and their plan say, with a reference that is read once.
class PartInspector {
 public:
  /// Reads the reference, where one is named. Arguments and plan must outlive it.
  PartInspector(const InspectArguments& arguments, const InspectionPlan& plan, const Run& run);

  /// Reads a mesh and inspects it.
  [[nodiscard]] Inspection inspect(const std::filesystem::path& mesh, const Run& run) const;

  /// The scan of the meshes; null where none is named.
  [[nodiscard]] const Scan* scan() const { return scan_ ? &*scan_ : nullptr; }

 private:
  const InspectArguments& arguments_;
  const InspectionPlan& plan_;
  std::optional<InspectionReference> reference_;
  std::optional<Scan> scan_;
};

}  // namespace frangia
