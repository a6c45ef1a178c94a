#include "frangia/files/ply.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/ply_header.h"
#include "frangia/files/internal/polygon_faces.h"
#include "frangia/files/internal/range_grid.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

void write_ply_header(FileWriter& file, const Mesh& mesh, std::span<const VertexProperty> more) {
  file.text("ply\nformat binary_little_endian 1.0\ncomment Frangia; lengths in mm\n");
  file.text(fmt::format("element vertex {}\n", mesh.vertices_mm.size()));
  file.text("property float x\nproperty float y\nproperty float z\n");
  if (!mesh.normals.empty()) {
    file.text("property float nx\nproperty float ny\nproperty float nz\n");
  }
  if (!mesh.sigma_mm.empty()) file.text("property float sigma_mm\n");
  if (!mesh.sigma_noise_mm.empty()) file.text("property float sigma_noise_mm\n");
  if (!mesh.sigma_systematic_mm.empty()) file.text("property float sigma_systematic_mm\n");
  if (!mesh.views.empty()) file.text("property ushort views\n");
  if (!mesh.vertex_marks.empty()) file.text("property uchar mark\n");
  if (!mesh.colors.empty())
    file.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  for (const VertexProperty& property : more)
    file.text(fmt::format("property float {}\n", property.name));
  file.text(fmt::format("element face {}\n", mesh.triangles.size()));
  file.text("property list uchar int vertex_indices\n");
  if (!mesh.triangle_marks.empty()) file.text("property uchar mark\n");
  file.text("end_header\n");
}

}  // namespace

void write_ply(const std::filesystem::path& path,
               const Mesh& mesh,
               std::span<const VertexProperty> more) {
  check_mesh(mesh, path);
  for (const VertexProperty& property : more) {
    require(property.values.size() == mesh.vertices_mm.size(),
            "write_ply: a property needs one value for each vertex");
  }
  FileWriter file(path);
  write_ply_header(file, mesh, more);
  write_vertices(file, mesh, ColorLayout::Bytes, more);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    file.binary(std::uint8_t{3});
    for (const std::uint32_t corner : mesh.triangles[i])
      file.binary(corner);
    if (!mesh.triangle_marks.empty()) {
      file.binary(static_cast<std::uint8_t>(mesh.triangle_marks[i]));
    }
  }
  file.commit();
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh) {
  write_ply(path, mesh, {});
}

namespace {

constexpr std::array<std::string_view, 14> kKeptOfVertices{"x",
                                                           "y",
                                                           "z",
                                                           "nx",
                                                           "ny",
                                                           "nz",
                                                           "sigma_mm",
                                                           "views",
                                                           "mark",
                                                           "sigma_noise_mm",
                                                           "sigma_systematic_mm",
                                                           "red",
                                                           "green",
                                                           "blue"};
constexpr std::size_t kViews = 7;
constexpr std::size_t kMark = 8;
constexpr std::size_t kNoise = 9;
constexpr std::size_t kSystematic = 10;
constexpr std::size_t kRed = 11;

/// The value of a color's channel in a file's type that stands for full light.
float full_light(PlyType type) {
  switch (type) {
    case PlyType::Uint16:
      return 65'535.0F;
    case PlyType::Float32:
    case PlyType::Float64:
      return 1.0F;
    default:
      return 255.0F;
  }
}

/// The name that a property has here: of older programs, colors have "diffuse_" in front; others
/// write r, g, b, and capital letters.
std::string kept_name_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  constexpr std::string_view kDiffuse = "diffuse_";
  if (name.starts_with(kDiffuse)) return name.substr(kDiffuse.size());
  return name == "r" ? "red" : name == "g" ? "green" : name == "b" ? "blue" : name;
}

/// For each property of a vertex its index in kKeptOfVertices; for a skipped property the size of
/// kKeptOfVertices.
std::vector<std::size_t> slots_of(const PlyElement& element) {
  std::vector<std::size_t> slots;
  for (const PlyProperty& property : element.properties) {
    const std::string full_name = kept_name_of(property.name);
    const std::string_view name = full_name;
    const auto* const found = std::find(kKeptOfVertices.begin(), kKeptOfVertices.end(), name);
    const bool kept =
        !property.count_type &&
        (property.name != kKeptOfVertices[kViews] || property.type == PlyType::Uint16) &&
        (property.name != kKeptOfVertices[kMark] || property.type == PlyType::Uint8);
    slots.push_back(kept ? static_cast<std::size_t>(found - kKeptOfVertices.begin())
                         : kKeptOfVertices.size());
  }
  return slots;
}

bool has(const std::vector<std::size_t>& slots, std::size_t first, std::size_t count) {
  for (std::size_t slot = first; slot < first + count; ++slot)
    if (std::find(slots.begin(), slots.end(), slot) == slots.end()) return false;
  return true;
}

template <typename Source>
void skip(Source& source, const PlyProperty& property) {
  const std::uint64_t count = property.count_type ? read_list_length(source, property) : 1;
  for (std::uint64_t i = 0; i < count; ++i)
    static_cast<void>(source.value(property.type));
}

/// Other values come from other programs and count as measured.
Mark mark_from(double value) {
  return value == 1.0 ? Mark::Displaced : value == 2.0 ? Mark::Synthesized : Mark::Measured;
}

template <typename Source>
void read_vertices(Source& source, const PlyElement& element, Mesh& mesh) {
  const std::vector<std::size_t> slots = slots_of(element);
  const bool has_normals = has(slots, 3, 3);
  const bool has_sigma = has(slots, 6, 1);
  const bool has_parts = has_sigma && has(slots, kNoise, 2);
  const bool has_views = has(slots, kViews, 1);
  const bool has_marks = has(slots, kMark, 1);
  const bool has_colors = has(slots, kRed, 3);
  if (!has(slots, 0, 3)) source.fail("its vertices have no x, y or z");
  mesh.vertices_mm.reserve(element.count);
  std::array<float, kKeptOfVertices.size()> kept{};
  std::vector<Eigen::Vector3f> colors;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < slots.size(); ++p) {
      if (slots[p] < kept.size()) {
        const PlyType type = element.properties[p].type;
        kept.at(slots[p]) = static_cast<float>(source.value(type));
        if (slots[p] >= kRed) kept.at(slots[p]) /= full_light(type);
      } else {
        skip(source, element.properties[p]);
      }
    }
    mesh.vertices_mm.emplace_back(kept[0], kept[1], kept[2]);
    if (has_sigma) mesh.sigma_mm.push_back(kept[6]);
    if (has_parts) {
      mesh.sigma_noise_mm.push_back(kept[kNoise]);
      mesh.sigma_systematic_mm.push_back(kept[kSystematic]);
    }
    if (has_views)
      mesh.views.push_back(static_cast<std::uint16_t>(std::clamp(kept[kViews], 0.0F, 65'535.0F)));
    if (has_marks) mesh.vertex_marks.push_back(mark_from(static_cast<double>(kept[kMark])));
    if (has_colors) colors.emplace_back(kept[kRed], kept[kRed + 1], kept[kRed + 2]);
    if (!has_normals) continue;
    const Eigen::Vector3f normal(kept[3], kept[4], kept[5]);
    mesh.normals.push_back(normal.allFinite() ? normal : Eigen::Vector3f::Zero());
  }
  if (has_colors) mesh.colors = colors_of(colors);
}

template <typename Source>
void read_polygon(Source& source,
                  const PlyProperty& list,
                  std::vector<std::uint32_t>& corners,
                  PolygonFaces& polygons,
                  Mesh& mesh) {
  const std::uint64_t count = read_list_length(source, list);
  if (count < 3)
    source.fail(
        fmt::format("a face has {} corner{}; it needs three", count, count == 1 ? "" : "s"));
  corners.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    const double index = source.value(list.type);
    if (!(index >= 0.0 && index <= std::numeric_limits<std::uint32_t>::max()) ||
        index != std::floor(index)) {
      source.fail(fmt::format("a face refers to vertex {}, which is not a valid index", index));
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  polygons.add(mesh, corners);
}

bool is_corner_list(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool is_mark(const PlyProperty& property) {
  return !property.count_type && property.name == kKeptOfVertices[kMark] &&
         property.type == PlyType::Uint8;
}

template <typename Source>
void read_faces(Source& source, const PlyElement& element, PolygonFaces& polygons, Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  mesh.triangles.reserve(element.count);
  if (element.count > 0 &&
      std::none_of(element.properties.begin(), element.properties.end(), is_corner_list))
    source.fail("its faces have no list named vertex_indices or vertex_index; export it again");
  const bool has_marks = std::any_of(element.properties.begin(), element.properties.end(), is_mark);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Mark mark = Mark::Measured;
    for (const PlyProperty& property : element.properties) {
      if (is_corner_list(property)) {
        read_polygon(source, property, corners, polygons, mesh);
      } else if (is_mark(property)) {
        mark = mark_from(source.value(property.type));
      } else {
        skip(source, property);
      }
    }
    if (has_marks) mesh.triangle_marks.resize(mesh.triangles.size(), mark);
  }
}

template <typename Source>
Mesh read_elements(Source source,
                   const PlyHeader& header,
                   PolygonFaces& polygons,
                   const std::filesystem::path& path,
                   const Run& run) {
  Mesh mesh;
  bool has_vertices = false;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // it occupies no bytes
    if (const std::uint64_t max_count = source.max_count(element); element.count > max_count) {
      source.fail(
          fmt::format("the header states {} of '{}', but the file can hold at most {}; "
                      "it is truncated or its header is wrong",
                      element.count,
                      element.name,
                      max_count));
    }
    if (element.name == "vertex") {
      read_vertices(source, element, mesh);
      has_vertices = true;
    } else if (element.name == "face") {
      read_faces(source, element, polygons, mesh);
    } else if (element.name == "tristrips") {
      source.fail("triangle strips are not supported; export it with faces");
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties)
          skip(source, property);
      }
    }
  }
  if (!has_vertices) source.fail("it has no element 'vertex'");
  warn_of_rest(source.rest(), path, run);
  return mesh;
}

/// Whether the elements are text, too, as the second line states.
bool has_text_elements(std::string_view bytes) {
  constexpr std::size_t kBeginning = 4096;
  return is_utf16(bytes) ||
         bytes.substr(0, kBeginning).find("format ascii") != std::string_view::npos;
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path, const Run& run) {
  std::string bytes = read_bytes(path);
  if (has_text_elements(bytes)) bytes = plain_text(std::move(bytes));
  const PlyHeader header = parse_ply_header(path, bytes);
  const std::string_view body = std::string_view(bytes).substr(header.body);
  PolygonFaces polygons;
  Mesh mesh =
      header.format == PlyFormat::Ascii
          ? read_elements(AsciiPlySource(path, bytes, header.body), header, polygons, path, run)
          : read_elements(BinaryPlySource(path, body, header.format), header, polygons, path, run);
  check_mesh(mesh, path);
  polygons.triangulate(mesh, path, run);
  if (mesh.triangles.empty() && has_range_grid(header))
    add_grid_triangles(mesh, header, bytes, path);
  return mesh;
}

}  // namespace frangia
