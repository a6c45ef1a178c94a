#include "part_inspector.h"

#include <utility>

#include "frangia/core/angles.h"
#include "frangia/files/read_mesh.h"

#include "inspect_picture.h"

namespace frangia {

PartInspector::PartInspector(const InspectArguments& arguments,
                             const InspectionPlan& plan,
                             const Run& run)
    : arguments_(arguments), plan_(plan) {
  if (!plan.reference.empty()) {
    reference_ = read_inspection_reference(
        plan.reference,
        {.unit_mm = plan.unit_mm, .read = arguments.read, .allow_time_s = arguments.allow_time_s},
        run);
  }
  if (!arguments.scan.empty()) scan_ = read_scan(arguments.scan, run);
}

Inspection PartInspector::inspect(const std::filesystem::path& path, const Run& run) const {
  Mesh mesh = read_surface(path, run, arguments_.read);
  if (!arguments_.picture.empty()) check_shown(arguments_, plan_, path, mesh);
  const InspectOptions options{.features = arguments_.features,
                               .within_mm = arguments_.within_mm,
                               .max_angle_rad = rad_from_deg(arguments_.max_angle_deg),
                               .scan = scan(),
                               .mesh_name = path};
  return inspect_part(std::move(mesh), reference_ ? &*reference_ : nullptr, plan_, options, run);
}

}  // namespace frangia
