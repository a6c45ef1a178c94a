#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/memory_budget.h"
#include "frangia/core/run.h"
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

/// What hides a layer.
struct DxfLayerState {
  bool off = false;
  bool frozen = false;
};

/// A block that a drawing shows, once or in rows and columns.
struct DxfInsert {
  std::string block;  ///< name in lower case
  Eigen::Affine3d mm_from_block = Eigen::Affine3d::Identity();
  std::int64_t columns = 1;
  std::int64_t rows = 1;
  Eigen::Vector3d column_step_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d row_step_mm = Eigen::Vector3d::Zero();
  DxfLayerState layer;
  bool on_layer_0 = false;  ///< in a block: the layer is that of the INSERT that shows the block
};

/// What a block, or the drawing itself, consists of.
struct DxfBlock {
  Mesh mesh;        ///< of the layers that are shown, mm
  Mesh on_layer_0;  ///< of a block: its layer is that of the INSERT, mm
  std::size_t entities_on_layer_0 = 0;
  std::string external;  ///< path of the drawing that it refers to; empty: none
  Eigen::Vector3d base_mm = Eigen::Vector3d::Zero();
  std::vector<DxfInsert> inserts;
};

/// The blocks of a drawing by their names in lower case; "" is the drawing itself.
using DxfBlocks = std::map<std::string, DxfBlock>;

/// The mesh of a drawing with its blocks where they are inserted, and what could not be.
struct DxfExpanded {
  Mesh mesh;
  std::size_t missing = 0;  ///< INSERT of blocks that the drawing does not have
  std::size_t hidden = 0;   ///< meshes of layers that are off or frozen
  std::map<std::string, std::size_t> externals;  ///< INSERT of other drawings, by their paths
};

/// Expands the blocks of a drawing. What a block has on layer 0 is on the layer of its INSERT; an
/// INSERT on a frozen layer hides the whole block, one on a layer that is off that content alone.
///
/// @errors   Error(Input) that names the file: a block that contains itself, a drawing that would
///           take more memory than the budget; Error(Cancelled)
/// @source   Autodesk, AutoCAD User's Guide, "About Controlling the Color and Linetype Properties
/// in
///           Blocks" and "About Freezing and Turning Off Layers"
[[nodiscard]] DxfExpanded expand_blocks(const DxfBlocks& blocks,
                                        const std::filesystem::path& path,
                                        const MemoryBudget& budget,
                                        const Run& run);

/// The coordinates of an entity with an extrusion direction in those of the drawing.
///
/// @source   Autodesk, DXF Reference, Arbitrary Axis Algorithm
[[nodiscard]] Eigen::Matrix3d axes_of_extrusion(const Eigen::Vector3d& direction);

}  // namespace frangia
