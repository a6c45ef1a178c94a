#include <array>
#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/mark_names.h"
#include "frangia/files/internal/three_mf.h"
#include "frangia/files/internal/zip_file.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mark_colors.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

template <typename Number>
void write_number(ZipWriter& file, Number number) {
  std::array<char, 32> digits{};
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  file.text({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

/// Writes decimals without an exponent, which some readers do not accept.
void write_real(ZipWriter& file, float number) {
  std::array<char, 64> digits{};
  const char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed)
          .ptr;
  file.text({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

/// Half-edges without exactly one opposite half-edge: 0 for a closed, manifold, oriented mesh.
std::size_t count_open_edges(const Mesh& mesh) {
  const HalfEdges edges(mesh);
  std::size_t count = 0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    count += edges.has_twin(edge) ? 0U : 1U;
  return count;
}

void write_vertices(ZipWriter& file, const Mesh& mesh) {
  file.text("    <vertices>\n");
  for (const Eigen::Vector3f& place : mesh.vertices_mm) {
    file.text("     <vertex x=\"");
    write_real(file, place.x());
    file.text("\" y=\"");
    write_real(file, place.y());
    file.text("\" z=\"");
    write_real(file, place.z());
    file.text("\"/>\n");
  }
  file.text("    </vertices>\n");
}

void write_triangles(ZipWriter& file, const Mesh& mesh) {
  file.text("    <triangles>\n");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (a == b || b == c || c == a) continue;
    file.text("     <triangle v1=\"");
    write_number(file, a);
    file.text("\" v2=\"");
    write_number(file, b);
    file.text("\" v3=\"");
    write_number(file, c);
    const Mark mark = mark_of(mesh, i);
    file.text(mark == Mark::Measured    ? "\"/>\n"
              : mark == Mark::Displaced ? "\" pid=\"1\" p1=\"1\"/>\n"
                                        : "\" pid=\"1\" p1=\"2\"/>\n");
  }
  file.text("    </triangles>\n");
}

void write_model(ZipWriter& file, const Mesh& mesh) {
  file.text(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      " <metadata name=\"Application\">Frangia</metadata>\n"
      " <resources>\n"
      "  <basematerials id=\"1\">\n");
  for (const Mark mark : {Mark::Measured, Mark::Displaced, Mark::Synthesized}) {
    file.text(fmt::format("   <base name=\"{}\" displaycolor=\"#{:02X}\"/>\n",
                          kMarkNames.at(static_cast<std::size_t>(mark)),
                          fmt::join(mark_screen_color(mark), "")));
  }
  file.text(
      "  </basematerials>\n"
      "  <object id=\"2\" type=\"model\" name=\"scan\" pid=\"1\" pindex=\"0\">\n"
      "   <mesh>\n");
  write_vertices(file, mesh);
  write_triangles(file, mesh);
  file.text(
      "   </mesh>\n"
      "  </object>\n"
      " </resources>\n"
      " <build>\n"
      "  <item objectid=\"2\"/>\n"
      " </build>\n"
      "</model>\n");
}

}  // namespace

void write_3mf(const std::filesystem::path& path, const Mesh& mesh, const Run& run) {
  check_triangles(mesh, path);
  ZipWriter file(path);
  file.begin("[Content_Types].xml");
  file.text(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
      " <Default Extension=\"rels\" "
      "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
      " <Default Extension=\"model\" "
      "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
      "</Types>\n");
  file.begin("_rels/.rels");
  file.text(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
      " <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
      "</Relationships>\n");
  constexpr std::uint64_t kMaxLine = 128;  // bytes of a vertex or triangle
  file.begin("3D/3dmodel.model", kMaxLine * (mesh.vertices_mm.size() + mesh.triangles.size()));
  write_model(file, mesh);
  file.commit();
  if (const std::size_t open = count_open_edges(mesh); open > 0) {
    run.warn(fmt::format(
        "{}: the mesh has {} open or non-manifold edge{}, but 3MF is meant for closed parts; set "
        "`watertight` or `fill_holes` to close it before printing",
        path.string(),
        open,
        open == 1 ? "" : "s"));
  }
}

}  // namespace frangia
