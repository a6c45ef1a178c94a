#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/files/internal/check_mesh.h"
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

std::uint32_t packed(const VertexColor& color) {
  return std::uint32_t{color[0]} << 16U | std::uint32_t{color[1]} << 8U | std::uint32_t{color[2]};
}

/// The different colors of a mesh, ascending.
std::vector<std::uint32_t> palette_of(const Mesh& mesh) {
  std::vector<std::uint32_t> palette;
  palette.reserve(mesh.colors.size());
  for (const VertexColor& color : mesh.colors)
    palette.push_back(packed(color));
  std::sort(palette.begin(), palette.end());
  palette.erase(std::unique(palette.begin(), palette.end()), palette.end());
  return palette;
}

/// Refers to the colors of a triangle's corners in the color group.
void write_corner_colors(ZipWriter& file,
                         const Mesh& mesh,
                         const Mesh::Triangle& triangle,
                         const std::vector<std::uint32_t>& palette) {
  constexpr std::array kNames{" p1=\"", " p2=\"", " p3=\""};
  file.text("\" pid=\"3\"");
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    const auto at =
        std::lower_bound(palette.begin(), palette.end(), packed(mesh.colors[triangle.at(i)]));
    file.text(kNames.at(i));
    write_number(file, static_cast<std::size_t>(at - palette.begin()));
    file.text("\"");
  }
  file.text("/>\n");
}

void write_color_group(ZipWriter& file, const std::vector<std::uint32_t>& palette) {
  if (palette.empty()) return;
  file.text("  <m:colorgroup id=\"3\">\n");
  for (const std::uint32_t color : palette)
    file.text(fmt::format("   <m:color color=\"#{:06X}FF\"/>\n", color));
  file.text("  </m:colorgroup>\n");
}

void write_triangles(ZipWriter& file, const Mesh& mesh, const std::vector<std::uint32_t>& palette) {
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
    if (mark == Mark::Measured && !palette.empty()) {
      write_corner_colors(file, mesh, mesh.triangles[i], palette);
      continue;
    }
    file.text(mark == Mark::Measured    ? "\"/>\n"
              : mark == Mark::Displaced ? "\" pid=\"1\" p1=\"1\"/>\n"
                                        : "\" pid=\"1\" p1=\"2\"/>\n");
  }
  file.text("    </triangles>\n");
}

void write_model(ZipWriter& file, const Mesh& mesh) {
  const std::vector<std::uint32_t> palette = palette_of(mesh);
  file.text(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
      "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n"
      " <metadata name=\"Application\">Frangia</metadata>\n"
      " <resources>\n"
      "  <basematerials id=\"1\">\n");
  for (const auto& [mark, name] : names_of(Mark{})) {
    file.text(fmt::format("   <base name=\"{}\" displaycolor=\"#{:02X}\"/>\n",
                          name,
                          fmt::join(mark_screen_color(mark), "")));
  }
  file.text("  </basematerials>\n");
  write_color_group(file, palette);
  file.text(
      "  <object id=\"2\" type=\"model\" name=\"scan\" pid=\"1\" pindex=\"0\">\n"
      "   <mesh>\n");
  write_vertices(file, mesh);
  write_triangles(file, mesh, palette);
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
  constexpr std::uint64_t kMaxLine = 160;  // bytes of a vertex or triangle, and of a color
  file.begin("3D/3dmodel.model",
             kMaxLine * (mesh.vertices_mm.size() + mesh.colors.size() + mesh.triangles.size()));
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
