#include "frangia/inspection/inspection_reference.h"

#include <utility>

#include "frangia/core/error.h"
#include "frangia/files/read_mesh.h"

namespace frangia {

InspectionReference read_inspection_reference(const std::filesystem::path& path,
                                              const ReferenceOptions& options,
                                              const Run& run) {
  if (is_cad_file(path)) {
    const CadOptions cad_options{.units = options.unit_mm,
                                 .allow_memory = options.read.allow_memory_bytes,
                                 .allow_time_s = options.allow_time_s};
    auto cad = read_cad(path, cad_options, run);
    RayScene scene(cad->mesh(), run);
    return {path, std::move(cad), std::move(scene)};
  }
  Mesh mesh = read_surface(path, run, options.read);
  if (options.unit_mm) {
    for (auto& vertex : mesh.vertices_mm)
      vertex *= static_cast<float>(*options.unit_mm);
  }
  return {path, nullptr, RayScene(std::move(mesh), run)};
}

InspectionReference reference_of_mesh(Mesh mesh, const Run& run) {
  require(!mesh.triangles.empty(),
          "the reference has points and no triangles; give a mesh with a surface");
  return {{}, nullptr, RayScene(std::move(mesh), run)};
}

}  // namespace frangia
