#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/off.h"
#include "frangia/geometry/mark_colors.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

void write_off(const std::filesystem::path& path, const Mesh& mesh) {
  check_triangles(mesh, path);
  FileWriter file(path);
  file.text("OFF\n# Frangia; lengths in mm\n");
  file.number(mesh.vertices_mm.size());
  file.text(" ");
  file.number(mesh.triangles.size());
  file.text(" 0\n");
  for (const Eigen::Vector3f& place : mesh.vertices_mm) {
    file.number(place.x());
    file.text(" ");
    file.number(place.y());
    file.text(" ");
    file.number(place.z());
    file.text("\n");
  }
  const auto line_end = [](Mark mark) {
    return fmt::format(" {}\n", fmt::join(mark_screen_color(mark), " "));
  };
  const std::array<std::string, 3> line_ends{
      "\n", line_end(Mark::Displaced), line_end(Mark::Synthesized)};  // indexed by Mark
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    file.text("3");
    for (const std::uint32_t corner : mesh.triangles[i]) {
      file.text(" ");
      file.number(std::size_t{corner});
    }
    file.text(line_ends.at(static_cast<std::size_t>(mark_of(mesh, i))));
  }
  file.commit();
}

}  // namespace frangia
