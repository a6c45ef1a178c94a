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

namespace {

/// Issues the unique handles that every object of a release 2000 drawing needs.
class Handles {
 public:
  std::string next() { return fmt::format("{:X}", ++last_); }

 private:
  unsigned last_ = 0x20;  // lower handles are assigned by name below
};

constexpr std::string_view kModelSpace = "1F";
constexpr std::string_view kPaperSpace = "1E";

void begin_table(FileWriter& file, std::string_view name, std::string_view handle, int count) {
  file.text(fmt::format("  0\nTABLE\n  2\n{}\n  5\n{}\n330\n0\n100\nAcDbSymbolTable\n 70\n{}\n",
                        name,
                        handle,
                        count));
}

void begin_record(FileWriter& file, std::string_view kind, std::string_view of, Handles& handles) {
  file.text(fmt::format(
      "  0\n{}\n  5\n{}\n330\n{}\n100\nAcDbSymbolTableRecord\n", kind, handles.next(), of));
}

void write_line_types(FileWriter& file, Handles& handles) {
  begin_table(file, "LTYPE", "5", 3);
  for (const std::string_view name : {"ByBlock", "ByLayer", "Continuous"}) {
    begin_record(file, "LTYPE", "5", handles);
    file.text(fmt::format(
        "100\nAcDbLinetypeTableRecord\n  2\n{}\n 70\n0\n  3\n\n 72\n65\n 73\n0\n 40\n0.0\n", name));
  }
  file.text("  0\nENDTAB\n");
}

void write_layers(FileWriter& file, const DxfDrawing& drawing, Handles& handles) {
  int count = 1;
  for (std::size_t i = 0; i < kDxfLayers.size(); ++i)
    count += drawing.uses(i) ? 1 : 0;
  begin_table(file, "LAYER", "2", count);
  const auto write = [&](std::string_view name, int color) {
    begin_record(file, "LAYER", "2", handles);
    file.text(fmt::format(
        "100\nAcDbLayerTableRecord\n  2\n{}\n 70\n0\n 62\n{}\n  6\nContinuous\n", name, color));
  };
  write("0", 7);
  for (std::size_t i = 0; i < kDxfLayers.size(); ++i)
    if (drawing.uses(i)) write(kDxfLayers.at(i), kDxfColors.at(i));
  file.text("  0\nENDTAB\n");
}

void write_block_records(FileWriter& file) {
  begin_table(file, "BLOCK_RECORD", "1", 2);
  for (const auto& [handle, name] :
       {std::pair(kModelSpace, "*Model_Space"), std::pair(kPaperSpace, "*Paper_Space")}) {
    file.text(
        fmt::format("  0\nBLOCK_RECORD\n  5\n{}\n330\n1\n100\nAcDbSymbolTableRecord\n"
                    "100\nAcDbBlockTableRecord\n  2\n{}\n",
                    handle,
                    name));
  }
  file.text("  0\nENDTAB\n");
}

void write_tables(FileWriter& file, const DxfDrawing& drawing, Handles& handles) {
  file.text("  0\nSECTION\n  2\nTABLES\n");
  begin_table(file, "VPORT", "8", 0);
  file.text("  0\nENDTAB\n");
  write_line_types(file, handles);
  write_layers(file, drawing, handles);
  begin_table(file, "STYLE", "3", 1);
  begin_record(file, "STYLE", "3", handles);
  file.text(
      "100\nAcDbTextStyleTableRecord\n  2\nStandard\n 70\n0\n 40\n0.0\n 41\n1.0\n 50\n0.0\n"
      " 71\n0\n 42\n2.5\n  3\ntxt\n  4\n\n  0\nENDTAB\n");
  begin_table(file, "VIEW", "6", 0);
  file.text("  0\nENDTAB\n");
  begin_table(file, "UCS", "7", 0);
  file.text("  0\nENDTAB\n");
  begin_table(file, "APPID", "9", 1);
  begin_record(file, "APPID", "9", handles);
  file.text("100\nAcDbRegAppTableRecord\n  2\nACAD\n 70\n0\n  0\nENDTAB\n");
  begin_table(file, "DIMSTYLE", "A", 1);
  file.text("100\nAcDbDimStyleTable\n 71\n0\n");
  file.text(fmt::format(
      "  0\nDIMSTYLE\n105\n{}\n330\nA\n100\nAcDbSymbolTableRecord\n100\nAcDbDimStyleTableRecord\n"
      "  2\nStandard\n 70\n0\n  0\nENDTAB\n",
      handles.next()));
  write_block_records(file);
  file.text("  0\nENDSEC\n");
}

void write_blocks(FileWriter& file, Handles& handles) {
  file.text("  0\nSECTION\n  2\nBLOCKS\n");
  for (const auto& [owner, name] :
       {std::pair(kModelSpace, "*Model_Space"), std::pair(kPaperSpace, "*Paper_Space")}) {
    file.text(fmt::format(
        "  0\nBLOCK\n  5\n{0}\n330\n{1}\n100\nAcDbEntity\n  8\n0\n100\nAcDbBlockBegin\n  2\n{2}\n"
        " 70\n0\n 10\n0.0\n 20\n0.0\n 30\n0.0\n  3\n{2}\n  1\n\n",
        handles.next(),
        owner,
        name));
    file.text(
        fmt::format("  0\nENDBLK\n  5\n{}\n330\n{}\n100\nAcDbEntity\n  8\n0\n100\nAcDbBlockEnd\n",
                    handles.next(),
                    owner));
  }
  file.text("  0\nENDSEC\n");
}

void write_mesh_entity(FileWriter& file,
                       const DxfDrawing& drawing,
                       std::size_t layer,
                       Handles& handles) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  const auto& triangles = drawing.triangles.at(layer);
  std::vector<std::uint32_t> number(drawing.vertices.size(), kUnused);
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t v : drawing.mesh->triangles[t]) {
      if (number[v] != kUnused) continue;
      number[v] = static_cast<std::uint32_t>(used.size());
      used.push_back(v);
    }
  }
  file.text(fmt::format(
      "  0\nMESH\n  5\n{}\n330\n{}\n100\nAcDbEntity\n  8\n{}\n100\nAcDbSubDMesh\n 71\n2\n 72\n0\n"
      " 91\n0\n",
      handles.next(),
      kModelSpace,
      kDxfLayers.at(layer)));
  write_dxf_count(file, " 92\n", used.size());
  for (const std::uint32_t v : used)
    write_dxf_point(file, drawing.vertices[v]);
  write_dxf_count(file, " 93\n", 4 * triangles.size());
  for (const std::uint32_t t : triangles) {
    file.text(" 90\n3\n");
    for (const std::uint32_t v : drawing.mesh->triangles[t])
      write_dxf_count(file, " 90\n", number[v]);
  }
  file.text(" 94\n0\n 95\n0\n 90\n0\n");
}

}  // namespace

void write_dxf_2000(FileWriter& file, const DxfDrawing& drawing) {
  file.text("  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  9\n$HANDSEED\n  5\nFFFF\n");
  file.text("  9\n$EXTMIN\n");
  write_dxf_point(file, drawing.low);
  file.text("  9\n$EXTMAX\n");
  write_dxf_point(file, drawing.high);
  file.text("  9\n$INSUNITS\n 70\n4\n  9\n$MEASUREMENT\n 70\n1\n  0\nENDSEC\n");
  file.text("  0\nSECTION\n  2\nCLASSES\n  0\nENDSEC\n");
  Handles handles;
  write_tables(file, drawing, handles);
  write_blocks(file, handles);
  file.text("  0\nSECTION\n  2\nENTITIES\n");
  for (std::size_t layer = 0; layer < kDxfLayers.size(); ++layer)
    if (!drawing.triangles.at(layer).empty()) write_mesh_entity(file, drawing, layer, handles);
  file.text(
      "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS\n"
      "  0\nDICTIONARY\n  5\nC\n330\n0\n100\nAcDbDictionary\n281\n1\n  3\nACAD_GROUP\n350\nD\n"
      "  0\nDICTIONARY\n  5\nD\n330\nC\n100\nAcDbDictionary\n281\n1\n"
      "  0\nENDSEC\n  0\nEOF\n");
}

}  // namespace frangia
