#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "frangia/files/internal/file_writer.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Where triangles of each mark lie in a DXF: by number of the Mark.
inline constexpr std::array<std::string_view, 3> kDxfLayers{
    "SCAN", "SCAN_DISPLACED", "SCAN_SYNTHESIZED"};
/// Their colours: white, yellow, red.
inline constexpr std::array<int, 3> kDxfColors{7, 2, 1};

/// A mesh as it will stand in a DXF. Everything is counted in the steps that are written, so that
/// equal, different and extreme coordinates are the same in the file as here.
struct DxfDrawing {
  using QuantizedPoint = std::array<std::int64_t, 3>;  ///< ten thousandths of a mm

  const Mesh* mesh = nullptr;
  std::vector<QuantizedPoint> vertices;
  std::array<std::vector<std::uint32_t>, 3> triangles;  ///< by mark; those whose corners differ
  QuantizedPoint low{};
  QuantizedPoint high{};

  [[nodiscard]] bool uses(std::size_t layer) const {
    return layer == 0 || !triangles.at(layer).empty();
  }
};

/// errors   Error(Input) as write_dxf
[[nodiscard]] DxfDrawing make_dxf_drawing(const Mesh& mesh, const std::filesystem::path& path);

/// Group codes 10, 20, 30 for the first corner of an entity, 11, 21, 31 for its second, ...
void write_dxf_point(FileWriter& file,
                     const DxfDrawing::QuantizedPoint& place,
                     std::size_t corner = 0);

void write_dxf_count(FileWriter& file, std::string_view code, std::size_t count);

/// A DXF of release 2000 (AC1015), which has the entity MESH: one for each layer in use.
void write_dxf_2000(FileWriter& file, const DxfDrawing& drawing);

}  // namespace frangia
