#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/files/dxf.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/dxf_drawing.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/split_spatially.h"

namespace frangia {
namespace {

constexpr std::size_t kMaxInPolyface = 32'767;  // signed 16-bit indices

void write_header(FileWriter& file, const DxfDrawing& drawing) {
  file.text("  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1009\n  9\n$EXTMIN\n");
  write_dxf_point(file, drawing.low);
  file.text("  9\n$EXTMAX\n");
  write_dxf_point(file, drawing.high);
  file.text("  9\n$INSUNITS\n 70\n4\n  9\n$MEASUREMENT\n 70\n1\n  0\nENDSEC\n");
}

void write_tables(FileWriter& file, const DxfDrawing& drawing) {
  file.text(
      "  0\nSECTION\n  2\nTABLES\n"
      "  0\nTABLE\n  2\nLTYPE\n 70\n1\n"
      "  0\nLTYPE\n  2\nCONTINUOUS\n 70\n0\n  3\nSolid line\n 72\n65\n 73\n0\n 40\n0.0\n"
      "  0\nENDTAB\n"
      "  0\nTABLE\n  2\nLAYER\n");
  std::size_t layers = 1;
  for (std::size_t i = 0; i < kDxfLayers.size(); ++i)
    layers += drawing.uses(i) ? 1U : 0U;
  write_dxf_count(file, " 70\n", layers);
  file.text("  0\nLAYER\n  2\n0\n 70\n0\n 62\n7\n  6\nCONTINUOUS\n");
  for (std::size_t i = 0; i < kDxfLayers.size(); ++i) {
    if (!drawing.uses(i)) continue;
    file.text(fmt::format("  0\nLAYER\n  2\n{}\n 70\n0\n 62\n{}\n  6\nCONTINUOUS\n",
                          kDxfLayers.at(i),
                          kDxfColors.at(i)));
  }
  file.text(
      "  0\nENDTAB\n  0\nENDSEC\n"
      "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n"
      "  0\nSECTION\n  2\nENTITIES\n");
}

void write_faces(FileWriter& file, const DxfDrawing& drawing, std::size_t layer) {
  const std::string beginning = fmt::format("  0\n3DFACE\n  8\n{}\n", kDxfLayers.at(layer));
  for (const std::uint32_t triangle : drawing.triangles.at(layer)) {
    file.text(beginning);
    const auto& [a, b, c] = drawing.mesh->triangles[triangle];
    write_dxf_point(file, drawing.vertices[a], 0);
    write_dxf_point(file, drawing.vertices[b], 1);
    write_dxf_point(file, drawing.vertices[c], 2);
    write_dxf_point(
        file, drawing.vertices[c], 3);  // a 3DFACE has four corners; a triangle repeats the last
  }
}

void write_polyfaces(FileWriter& file, const DxfDrawing& drawing, std::size_t layer) {
  const std::string_view name = kDxfLayers.at(layer);
  const std::string vertex = fmt::format("  0\nVERTEX\n  8\n{}\n", name);
  std::vector<std::size_t> number_of(drawing.vertices.size());
  const auto groups = split_spatially(*drawing.mesh, drawing.triangles.at(layer), kMaxInPolyface);
  for (const auto& group : groups) {
    const std::vector<std::uint32_t> vertices = vertices_of(*drawing.mesh, group);
    file.text(fmt::format("  0\nPOLYLINE\n  8\n{}\n 66\n1\n 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n64\n",
                          name));
    write_dxf_count(file, " 71\n", vertices.size());
    write_dxf_count(file, " 72\n", group.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      number_of[vertices[i]] = i + 1;
      file.text(vertex);
      write_dxf_point(file, drawing.vertices[vertices[i]]);
      file.text(" 70\n192\n");
    }
    for (const std::uint32_t triangle : group) {
      file.text(vertex);
      file.text(" 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n128\n");
      const auto& [a, b, c] = drawing.mesh->triangles[triangle];
      write_dxf_count(file, " 71\n", number_of[a]);
      write_dxf_count(file, " 72\n", number_of[b]);
      write_dxf_count(file, " 73\n", number_of[c]);
    }
    file.text(fmt::format("  0\nSEQEND\n  8\n{}\n", name));
  }
}

void write_release_12(FileWriter& file, const DxfDrawing& drawing, DxfVariant variant) {
  write_header(file, drawing);
  write_tables(file, drawing);
  for (std::size_t layer = 0; layer < kDxfLayers.size(); ++layer) {
    if (drawing.triangles.at(layer).empty()) continue;
    if (variant == DxfVariant::Polyface) {
      write_polyfaces(file, drawing, layer);
    } else {
      write_faces(file, drawing, layer);
    }
  }
  file.text("  0\nENDSEC\n  0\nEOF\n");
}

}  // namespace

void write_dxf(const std::filesystem::path& path, const Mesh& mesh, const DxfOptions& options) {
  check_triangles(mesh, path);
  const DxfDrawing drawing = make_dxf_drawing(mesh, path);
  FileWriter file(path);
  if (options.variant == DxfVariant::Mesh) {
    write_dxf_2000(file, drawing);
  } else {
    write_release_12(file, drawing, options.variant);
  }
  file.commit();
}

}  // namespace frangia
