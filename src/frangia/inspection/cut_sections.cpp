#include "frangia/inspection/cut_sections.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

std::optional<BladeSection> blade_of(const std::vector<SectionCurve>& curves,
                                     const std::string& name,
                                     const Run& run) {
  if (curves.empty()) return std::nullopt;
  try {
    return measure_blade_section(curves.front());
  } catch (const Error& error) {
    run.warn(fmt::format("{}: {}", name, error.what()));
    return std::nullopt;
  }
}

}  // namespace

std::vector<SectionResult> cut_sections(const std::vector<PlannedSection>& planned,
                                        const Mesh& mesh,
                                        const Mesh* reference,
                                        const std::vector<float>& deviation_mm,
                                        const Run& run) {
  std::vector<SectionResult> sections;
  for (const PlannedSection& one : planned) {
    run.check();
    SectionResult section;
    section.name = one.name;
    section.plane = section_plane(one.point_mm, one.normal);
    section.measured = section_curves(mesh, section.plane, deviation_mm);
    if (reference != nullptr) section.reference = section_curves(*reference, section.plane);
    if (one.blade) {
      section.blade = blade_of(section.measured, one.name, run);
      section.nominal_blade = blade_of(section.reference, one.name + ", nominal", run);
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace frangia
