#include "frangia/files/internal/three_mf.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/xml_parser.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/three_mf_model.h"
#include "frangia/files/internal/zip_file.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// The name of the package's model according to its relationships.
std::string model_name(const ZipReader& zip) {
  std::string name = "3D/3dmodel.model";
  XmlParser elements(
      [&](std::string_view element, const XmlAttributes& attributes) {
        const bool is_model =
            element.ends_with("|Relationship") && attributes.value("Type").ends_with("/3dmodel");
        if (!is_model) return;
        name = attributes.value("Target");
        if (name.starts_with('/')) name.erase(0, 1);
      },
      [](std::string_view) {});
  if (zip.read("_rels/.rels", [&](std::string_view piece, double) { elements.feed(piece); })) {
    elements.finish();
  }
  return name;
}

/// Reads the model in a file of the package into `model`.
void read_part(const ZipReader& zip,
               const std::string& name,
               const MemoryBudget& budget,
               ThreeMfModel& model) {
  model.begin_part(name);
  XmlParser elements([&](std::string_view element,
                         const XmlAttributes& attributes) { model.begin(element, attributes); },
                     [](std::string_view) {});
  elements.on_namespace(
      [&](std::string_view prefix, std::string_view uri) { model.declare_namespace(prefix, uri); });
  const double before = model.collected_bytes();
  const auto feed = [&](std::string_view piece, double done) {
    elements.feed(piece);
    const double collected = model.collected_bytes();
    budget.check(collected, before + (collected - before) / done);
  };
  if (!zip.read(name, feed) && !zip.read(without_percent(name), feed)) {
    throw Error(ErrorKind::Input,
                fmt::format("not a 3MF package: it has no model {}", in_quotes(name)));
  }
  elements.finish();
}

Mesh read_package(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  const ZipReader zip(path);
  const MemoryBudget budget(path, std::filesystem::file_size(path), options.allow_memory_bytes);
  const std::string root = model_name(zip);
  ThreeMfModel model;
  std::set<std::string> known{root};
  std::vector<std::string> open{root};
  while (!open.empty()) {
    run.check();
    const std::string part = std::move(open.back());
    open.pop_back();
    read_part(zip, part, budget, model);
    constexpr std::size_t kMostParts = 10'000;
    if (model.parts().size() > kMostParts) {
      throw Error(
          ErrorKind::Input,
          fmt::format("its objects are in more than {} files; export it again", kMostParts));
    }
    for (const std::string& name : model.parts())
      if (known.insert(name).second) open.push_back(name);
  }
  ThreeMfModel::Built built = model.build(path, budget);
  if (built.left_out > 0) {
    run.warn(
        fmt::format("{}: left out {} object{} that {} no part: supports, or modifiers of a slicer",
                    path.string(),
                    built.left_out,
                    built.left_out == 1 ? "" : "s",
                    built.left_out == 1 ? "is" : "are"));
  }
  if (built.shapes > 0) {
    run.warn(fmt::format(
        "{}: left out {} beam{} or shape{} of extensions, which are no triangles; export it as "
        "triangles",
        path.string(),
        built.shapes,
        built.shapes == 1 ? "" : "s",
        built.shapes == 1 ? "" : "s"));
  }
  return std::move(built.mesh);
}

}  // namespace

Mesh read_3mf(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  Mesh mesh;
  try {
    mesh = read_package(path, options, run);
  } catch (const Error& error) {
    const std::string why = error.what();
    if (error.kind() != ErrorKind::Input || why.starts_with(path.string())) throw;
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
  }
  check_mesh(mesh, path);
  if (mesh.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its build items have no triangles", path.string()));
  }
  return mesh;
}

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
