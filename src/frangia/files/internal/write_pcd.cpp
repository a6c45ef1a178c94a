#include <string>

#include <fmt/format.h>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/pcd.h"

namespace frangia {
namespace {

/// The lines of the header that have one word per field.
struct Fields {
  std::string names = "FIELDS x y z";
  std::string sizes = "SIZE 4 4 4";
  std::string types = "TYPE F F F";
  std::string counts = "COUNT 1 1 1";

  void add(const std::string& name, int bytes, char type) {
    names += " " + name;
    sizes += fmt::format(" {}", bytes);
    types += fmt::format(" {}", type);
    counts += " 1";
  }
};

void write_header(FileWriter& file, const Mesh& mesh) {
  Fields fields;
  if (!mesh.normals.empty()) {
    for (const char* name : {"normal_x", "normal_y", "normal_z"})
      fields.add(name, 4, 'F');
  }
  if (!mesh.sigma_mm.empty()) fields.add("sigma_mm", 4, 'F');
  if (!mesh.sigma_noise_mm.empty()) fields.add("sigma_noise_mm", 4, 'F');
  if (!mesh.sigma_systematic_mm.empty()) fields.add("sigma_systematic_mm", 4, 'F');
  if (!mesh.views.empty()) fields.add("views", 2, 'U');
  if (!mesh.vertex_marks.empty()) fields.add("mark", 1, 'U');
  if (!mesh.colors.empty()) fields.add("rgb", 4, 'U');
  const std::size_t count = mesh.vertices_mm.size();
  file.text("# .PCD v0.7 - Point Cloud Data file format; Frangia, lengths in mm\nVERSION 0.7\n");
  file.text(
      fmt::format("{}\n{}\n{}\n{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\n"
                  "DATA binary\n",
                  fields.names,
                  fields.sizes,
                  fields.types,
                  fields.counts,
                  count,
                  count));
}

}  // namespace

void write_pcd(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  write_header(file, mesh);
  write_vertices(file, mesh, ColorLayout::Packed);
  file.commit();
}

}  // namespace frangia
