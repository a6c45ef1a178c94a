#include "inspect_reference.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/cad/read_cad.h"

#include "read_surface.h"

namespace frangia {

std::optional<Reference> read_reference(const InspectArguments& arguments, const Run& run) {
  if (arguments.reference.empty()) return std::nullopt;
  if (is_cad_file(arguments.reference)) {
    const CadOptions options{.units = arguments.alignment.unit_mm,
                             .allow_memory = arguments.read.allow_memory_bytes,
                             .allow_time_s = arguments.allow_time_s};
    auto cad = read_cad(arguments.reference, options, run);
    RayScene scene(cad->mesh(), run);
    return Reference{std::move(cad), std::move(scene)};
  }
  Mesh mesh = read_surface(arguments.reference, run, arguments.read);
  if (arguments.alignment.unit_mm) {
    for (auto& vertex : mesh.vertices_mm)
      vertex *= static_cast<float>(*arguments.alignment.unit_mm);
  }
  return Reference{nullptr, RayScene(std::move(mesh), run)};
}

void add_reference(InspectAnswer& answer, const Reference& reference) {
  if (!reference.cad) return;
  const std::size_t faces = reference.cad->faces().size();
  answer.json["reference"] = {{"faces", faces}, {"unit", reference.cad->unit()}};
  answer.text += fmt::format(
      "reference: {} CAD face{}, unit {}\n", faces, faces == 1 ? "" : "s", reference.cad->unit());
}

std::vector<std::optional<NominalFace>> nominal_faces(
    const Reference& reference, const std::vector<MeasuredFeature>& features) {
  std::vector<std::optional<NominalFace>> out;
  if (!reference.cad) return out;
  for (const MeasuredFeature& feature : features)
    out.push_back(nominal_face(*reference.cad, reference.scene, feature));
  return out;
}

}  // namespace frangia
