#include "inspect_plan.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parse_length.h"

namespace frangia {
namespace {

constexpr std::string_view kAxes = "xyz";

bool is_section(const std::string& text) {
  return text.size() > 2 && kAxes.find(text[0]) != std::string_view::npos && text[1] == '=';
}

/// The section of "z=60": the plane normal to an axis.
PlannedSection section_named(const std::string& text, bool blade) {
  PlannedSection section;
  section.name = text;
  section.blade = blade;
  const auto axis = static_cast<Eigen::Index>(kAxes.find(text[0]));
  section.normal = Eigen::Vector3d::Unit(axis);
  section.point_mm = parse_length_mm(text.substr(2)) * section.normal;
  return section;
}

}  // namespace

InspectionPlan plan_of(const InspectArguments& arguments) {
  InspectionPlan plan;
  if (!arguments.plan.empty()) plan = read_inspection_plan(arguments.plan);
  for (const std::string& text : arguments.sections)
    plan.sections.push_back(section_named(text, arguments.blade));
  if (!arguments.reference.empty()) {
    plan.reference = arguments.reference;
    plan.unit_mm = arguments.unit_mm;
  } else if (!plan.unit_mm) {
    plan.unit_mm = arguments.unit_mm;
  }
  if (plan.reference.empty()) plan.align.clear();
  if (!arguments.align.empty()) plan.align = arguments.align;
  if (!arguments.points.empty()) plan.points.clear();
  for (std::size_t i = 0; i + 6 <= arguments.points.size(); i += 6) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 2>> pair(&arguments.points[i]);
    plan.points.push_back({pair.col(0), pair.col(1)});
  }
  if (plan.align != "best-fit" && plan.align != "datum") plan.start = 0;
  if (arguments.start > 0) plan.start = arguments.start;
  const std::vector<double>& tolerance = arguments.tolerance_mm;
  if (tolerance.size() == 1) plan.tolerance_mm = {-tolerance[0], tolerance[0]};
  if (tolerance.size() == 2) plan.tolerance_mm = {tolerance[0], tolerance[1]};
  plan.tolerance().check();
  if (arguments.expansion_ppm_per_k != 0.0)
    plan.expansion_ppm_per_k = arguments.expansion_ppm_per_k;
  if (arguments.temperature_u_k != 0.0) plan.temperature_u_k = arguments.temperature_u_k;
  plan.thickness = plan.thickness || arguments.thickness;
  return plan;
}

CLI::Validator a_section() {
  return {[](std::string& input) -> std::string {
            try {
              if (is_section(input)) {
                static_cast<void>(parse_length_mm(input.substr(2)));
                return {};
              }
            } catch (const Error&) {  // the message below says what is wrong
            }
            return fmt::format("{} is no section; it must be x=, y= or z= and a length: z=60",
                               input);
          },
          "AXIS=LENGTH"};
}

}  // namespace frangia
