#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "frangia/files/internal/file_writer.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The layer for the triangles of each mark, indexed by Mark.
inline constexpr std::array<std::string_view, 3> kDxfLayers{
    "SCAN", "SCAN_DISPLACED", "SCAN_SYNTHESIZED"};
/// Their color numbers: white, yellow and blue, the hues of `kMarkColors`. 150 is a blue that is
/// readable on the black background of CAD programs; 5 is not.
inline constexpr std::array<int, 3> kDxfColors{7, 2, 150};

/// A mesh with the coordinates that the DXF will hold. Coordinates are integers in units of the
/// written resolution, so equality and extents are exactly those of the file.
struct DxfDrawing {
  using QuantizedPoint = std::array<std::int64_t, 3>;  ///< in units of 0.0001 mm

  const Mesh* mesh = nullptr;
  std::vector<QuantizedPoint> vertices;
  std::array<std::vector<std::uint32_t>, 3>
      triangles;  ///< indices by mark, without degenerate triangles
  QuantizedPoint low{};
  QuantizedPoint high{};

  [[nodiscard]] bool uses(std::size_t layer) const {
    return layer == 0 || !triangles.at(layer).empty();
  }
};

/// @errors   Error(Input) as write_dxf
[[nodiscard]] DxfDrawing make_dxf_drawing(const Mesh& mesh, const std::filesystem::path& path);

/// Writes a point with group codes 10, 20, 30 for corner 0 of an entity, 11, 21, 31 for corner 1,
/// ...
void write_dxf_point(FileWriter& file,
                     const DxfDrawing::QuantizedPoint& place,
                     std::size_t corner = 0);

void write_dxf_count(FileWriter& file, std::string_view code, std::size_t count);

/// Writes a DXF of release 2000 (AC1015) with one MESH entity per layer in use.
void write_dxf_2000(FileWriter& file, const DxfDrawing& drawing);

}  // namespace frangia
