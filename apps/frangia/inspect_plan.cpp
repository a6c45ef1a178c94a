#include "inspect_plan.h"

#include <fmt/format.h>

#include "frangia/core/parse_length.h"

#include "option_values.h"

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
  return plan;
}

void apply_plan(const InspectionPlan& plan, InspectArguments& arguments) {
  AlignmentArguments& alignment = arguments.alignment;
  if (arguments.reference.empty()) {
    arguments.reference = plan.reference;
    if (!plan.units.empty()) {
      std::string unit = plan.units;
      const std::string wrong = unit_length()(unit);
      if (!wrong.empty()) {
        throw Error(ErrorKind::Input, fmt::format("{}: units {}", arguments.plan.string(), wrong));
      }
      arguments.alignment.unit_mm = std::stod(unit);
    }
  }
  if (alignment.align.empty() && !arguments.reference.empty()) alignment.align = plan.align;
  if (alignment.start == 0 && (alignment.align == "best-fit" || alignment.align == "datum"))
    alignment.start = plan.start;
  if (alignment.tolerance_mm.empty() && plan.tolerance_mm)
    alignment.tolerance_mm = {plan.tolerance_mm->lower, plan.tolerance_mm->upper};
  if (arguments.expansion_ppm_per_k == 0.0)
    arguments.expansion_ppm_per_k = plan.expansion_ppm_per_k;
  arguments.surface = plan.surface;
  arguments.thickness = arguments.thickness || plan.thickness;
  if (arguments.temperature_u_k == 0.0) arguments.temperature_u_k = plan.temperature_u_k;
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
