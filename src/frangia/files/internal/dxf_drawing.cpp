#include "frangia/files/internal/dxf_drawing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr int kDecimals = 4;
constexpr int kStepsPerMm = 10'000;
constexpr float kMaxCoordinateMm = 1e9F;

using QuantizedPoint = DxfDrawing::QuantizedPoint;

QuantizedPoint quantize(const Eigen::Vector3f& place) {
  const Eigen::Vector3d steps = place.cast<double>() * kStepsPerMm;
  return {std::llround(steps.x()), std::llround(steps.y()), std::llround(steps.z())};
}

/// Writes a coordinate with a decimal point and without trailing zeros, but at least one decimal.
void write_quantized(FileWriter& file, std::int64_t steps) {
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

void extend(DxfDrawing& drawing, const QuantizedPoint& place) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drawing.low.at(axis) = std::min(drawing.low.at(axis), place.at(axis));
    drawing.high.at(axis) = std::max(drawing.high.at(axis), place.at(axis));
  }
}

}  // namespace

DxfDrawing make_dxf_drawing(const Mesh& mesh, const std::filesystem::path& path) {
  DxfDrawing drawing{.mesh = &mesh, .vertices = {}, .triangles = {}};
  drawing.vertices.reserve(mesh.vertices_mm.size());
  for (const Eigen::Vector3f& place : mesh.vertices_mm) {
    if (place.cwiseAbs().maxCoeff() > kMaxCoordinateMm) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a vertex lies more than 1 000 km away; check the mesh's units",
                              path.string()));
    }
    drawing.vertices.push_back(quantize(place));
  }
  drawing.low.fill(std::numeric_limits<std::int64_t>::max());
  drawing.high.fill(std::numeric_limits<std::int64_t>::min());
  bool any = false;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const QuantizedPoint& a = drawing.vertices[mesh.triangles[i][0]];
    const QuantizedPoint& b = drawing.vertices[mesh.triangles[i][1]];
    const QuantizedPoint& c = drawing.vertices[mesh.triangles[i][2]];
    if (a == b || b == c || c == a) continue;
    any = true;
    drawing.triangles.at(static_cast<std::size_t>(mark_of(mesh, i))).push_back(i);
    for (const QuantizedPoint& corner : {a, b, c})
      extend(drawing, corner);
  }
  if (!any) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no triangle is larger than 0.0001 mm, the resolution of the DXF; "
                            "check the mesh's units",
                            path.string()));
  }
  return drawing;
}

void write_dxf_point(FileWriter& file,
                     const DxfDrawing::QuantizedPoint& place,
                     std::size_t corner) {
  static constexpr std::array<std::array<std::string_view, 3>, 4> kCodes{{
      {" 10\n", " 20\n", " 30\n"},
      {" 11\n", " 21\n", " 31\n"},
      {" 12\n", " 22\n", " 32\n"},
      {" 13\n", " 23\n", " 33\n"},
  }};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    file.text(kCodes.at(corner).at(axis));
    write_quantized(file, place.at(axis));
  }
}

void write_dxf_count(FileWriter& file, std::string_view code, std::size_t count) {
  file.text(code);
  file.number(count);
  file.text("\n");
}

}  // namespace frangia
