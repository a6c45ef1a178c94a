#include "inspect_outputs.h"

#include <cstdint>
#include <vector>

#include "frangia/core/text.h"
#include "frangia/files/deviation_csv.h"
#include "frangia/files/ply.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/map_picture.h"
#include "frangia/inspect/deviation.h"
#include "frangia/report/labelled_picture.h"

#include "check_can_write.h"

namespace frangia {
namespace {

std::vector<VertexProperty> measured_properties(const Inspection& part) {
  std::vector<VertexProperty> more;
  const auto add = [&](const char* name, const std::vector<float>& values) {
    if (!values.empty()) more.push_back({name, values});
  };
  if (part.surface) {
    add("deviation_mm", part.surface->deviations.deviation_mm);
    add("u_mm", part.surface->deviations.u_mm);
  }
  if (part.walls) {
    add("thickness_mm", part.walls->thickness.thickness_mm);
    add("thickness_u_mm", part.walls->thickness.u_mm);
  }
  return more;
}

}  // namespace

void check_deviation_output(const std::filesystem::path& path) {
  if (lowercase_extension(path) != ".csv") check_mesh_extension(path);
  check_can_write(path);
}

void write_deviations(const std::filesystem::path& path,
                      const Inspection& part,
                      double scale_mm,
                      const Run& run) {
  const Mesh& mesh = part.mesh;
  const std::string extension = lowercase_extension(path);
  if (extension == ".ply") {
    write_ply(path, mesh, measured_properties(part));
    return;
  }
  const SurfaceInspection& surface = part.surface.value();
  const Deviations& found = surface.deviations;
  if (extension == ".csv") {
    const auto decided = conformities(found, surface.verdict.rule.limits);
    std::vector<DeviationRow> rows;
    for (std::size_t i = 0; i < decided.size(); ++i) {
      if (found.status[i] != DeviationStatus::Compared) continue;
      rows.push_back({static_cast<std::uint32_t>(i),
                      mesh.vertices_mm[i],
                      found.deviation_mm[i],
                      found.u_mm.empty() ? kMissing : found.u_mm[i],
                      name_of(decided[i])});
    }
    write_deviation_csv(path, rows);
    return;
  }
  Mesh colored = mesh;
  colored.colors.clear();
  const double scale = deviation_scale_mm(scale_mm, surface.verdict.rule.limits);
  for (const float deviation : found.deviation_mm) {
    const float share = 0.5F + 0.5F * deviation / static_cast<float>(scale);
    colored.colors.push_back(pixel_of(ColorMap::Diverging, share));
  }
  write_mesh(path, colored, {}, run);
}

}  // namespace frangia
