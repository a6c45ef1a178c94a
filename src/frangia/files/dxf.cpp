#include "frangia/files/dxf.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/check_mesh.h"
#include "frangia/files/file_writer.h"
#include "frangia/files/split_by_place.h"

namespace frangia {
namespace {

// Everything is counted in the steps that are written, so that equal, different and extreme
// coordinates are the same in the file as here.
constexpr int kDecimals = 4;
constexpr int kStepsPerMm = 10'000;
constexpr float kFarthestMm = 1e9F;
constexpr std::size_t kMostInPolyface = 32'767;

using Steps = std::array<std::int64_t, 3>;

struct Drawing {
  const Mesh& mesh;
  std::vector<Steps> vertices;
  std::vector<std::uint32_t> triangles;  ///< those whose corners differ in the file
  Steps low{};
  Steps high{};
};

Steps steps_of(const Eigen::Vector3f& place) {
  const Eigen::Vector3d steps = place.cast<double>() * kStepsPerMm;
  return {std::llround(steps.x()), std::llround(steps.y()), std::llround(steps.z())};
}

Drawing draw(const Mesh& mesh, const std::filesystem::path& path) {
  Drawing drawing{.mesh = mesh, .vertices = {}, .triangles = {}};
  for (const Eigen::Vector3f& place : mesh.vertices_mm) {
    if (place.cwiseAbs().maxCoeff() > kFarthestMm) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a vertex lies more than 1 000 km away; check the mesh's units",
                              path.string()));
    }
    drawing.vertices.push_back(steps_of(place));
  }
  drawing.low.fill(std::numeric_limits<std::int64_t>::max());
  drawing.high.fill(std::numeric_limits<std::int64_t>::min());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Steps& a = drawing.vertices[mesh.triangles[i][0]];
    const Steps& b = drawing.vertices[mesh.triangles[i][1]];
    const Steps& c = drawing.vertices[mesh.triangles[i][2]];
    if (a == b || b == c || c == a) continue;
    drawing.triangles.push_back(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      drawing.low.at(axis) = std::min({drawing.low.at(axis), a.at(axis), b.at(axis), c.at(axis)});
      drawing.high.at(axis) = std::max({drawing.high.at(axis), a.at(axis), b.at(axis), c.at(axis)});
    }
  }
  if (drawing.triangles.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: no triangle is larger than the 0.0001 mm that a DXF is written to; "
                    "check the mesh's units",
                    path.string()));
  }
  return drawing;
}

/// A coordinate with its point and no more zeros than the one that makes it a real number.
void write_steps(FileWriter& file, std::int64_t steps) {
  std::array<char, 32> text{};
  char* end = text.data();
  if (steps < 0) *end++ = '-';
  const std::int64_t size = std::abs(steps);
  end = std::to_chars(end, text.data() + text.size(), size / kStepsPerMm).ptr;
  *end++ = '.';
  std::int64_t rest = size % kStepsPerMm;
  for (int digit = kDecimals - 1; digit >= 0; --digit) {
    end[digit] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  }
  end += kDecimals;
  while (end[-1] == '0' && end[-2] != '.')
    --end;
  *end++ = '\n';
  file.text({text.data(), static_cast<std::size_t>(end - text.data())});
}

/// Group codes 10, 20, 30 for the first corner of an entity, 11, 21, 31 for its second, ...
void write_place(FileWriter& file, const Steps& place, std::size_t corner = 0) {
  static constexpr std::array<std::array<std::string_view, 3>, 4> kCodes{{
      {" 10\n", " 20\n", " 30\n"},
      {" 11\n", " 21\n", " 31\n"},
      {" 12\n", " 22\n", " 32\n"},
      {" 13\n", " 23\n", " 33\n"},
  }};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    file.text(kCodes.at(corner).at(axis));
    write_steps(file, place.at(axis));
  }
}

void write_count(FileWriter& file, std::string_view code, std::size_t count) {
  file.text(code);
  file.number(count);
  file.text("\n");
}

void write_beginning(FileWriter& file, const Drawing& drawing) {
  file.text("  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1009\n  9\n$EXTMIN\n");
  write_place(file, drawing.low);
  file.text("  9\n$EXTMAX\n");
  write_place(file, drawing.high);
  file.text("  9\n$INSUNITS\n 70\n4\n  9\n$MEASUREMENT\n 70\n1\n  0\nENDSEC\n");
  file.text(
      "  0\nSECTION\n  2\nTABLES\n"
      "  0\nTABLE\n  2\nLTYPE\n 70\n1\n"
      "  0\nLTYPE\n  2\nCONTINUOUS\n 70\n0\n  3\nSolid line\n 72\n65\n 73\n0\n 40\n0.0\n"
      "  0\nENDTAB\n"
      "  0\nTABLE\n  2\nLAYER\n 70\n2\n"
      "  0\nLAYER\n  2\n0\n 70\n0\n 62\n7\n  6\nCONTINUOUS\n"
      "  0\nLAYER\n  2\nSCAN\n 70\n0\n 62\n7\n  6\nCONTINUOUS\n"
      "  0\nENDTAB\n  0\nENDSEC\n"
      "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n"
      "  0\nSECTION\n  2\nENTITIES\n");
}

void write_faces(FileWriter& file, const Drawing& drawing) {
  for (const std::uint32_t triangle : drawing.triangles) {
    file.text("  0\n3DFACE\n  8\nSCAN\n");
    const auto& [a, b, c] = drawing.mesh.triangles[triangle];
    write_place(file, drawing.vertices[a], 0);
    write_place(file, drawing.vertices[b], 1);
    write_place(file, drawing.vertices[c], 2);
    write_place(file, drawing.vertices[c], 3);  // a triangle is a face whose last corners coincide
  }
}

void write_polyfaces(FileWriter& file, const Drawing& drawing) {
  std::vector<std::size_t> number_of(drawing.vertices.size());
  for (const auto& group : split_by_place(drawing.mesh, drawing.triangles, kMostInPolyface)) {
    const std::vector<std::uint32_t> vertices = vertices_of(drawing.mesh, group);
    file.text("  0\nPOLYLINE\n  8\nSCAN\n 66\n1\n 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n64\n");
    write_count(file, " 71\n", vertices.size());
    write_count(file, " 72\n", group.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      number_of[vertices[i]] = i + 1;
      file.text("  0\nVERTEX\n  8\nSCAN\n");
      write_place(file, drawing.vertices[vertices[i]]);
      file.text(" 70\n192\n");
    }
    for (const std::uint32_t triangle : group) {
      file.text("  0\nVERTEX\n  8\nSCAN\n 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n128\n");
      const auto& [a, b, c] = drawing.mesh.triangles[triangle];
      write_count(file, " 71\n", number_of[a]);
      write_count(file, " 72\n", number_of[b]);
      write_count(file, " 73\n", number_of[c]);
    }
    file.text("  0\nSEQEND\n  8\nSCAN\n");
  }
}

}  // namespace

void write_dxf(const std::filesystem::path& path, const Mesh& mesh, const DxfOptions& options) {
  check_triangles(mesh, path);
  const Drawing drawing = draw(mesh, path);
  FileWriter file(path);
  write_beginning(file, drawing);
  switch (options.variant) {
    case DxfVariant::Faces:
      write_faces(file, drawing);
      break;
    case DxfVariant::Polyface:
      write_polyfaces(file, drawing);
      break;
  }
  file.text("  0\nENDSEC\n  0\nEOF\n");
  file.commit();
}

}  // namespace frangia
