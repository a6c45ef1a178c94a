#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/memory_budget.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A block that a drawing shows, once or in rows and columns.
struct DxfInsert {
  std::string block;  ///< name in lower case
  Eigen::Affine3d mm_from_block = Eigen::Affine3d::Identity();
  std::int64_t columns = 1;
  std::int64_t rows = 1;
  Eigen::Vector3d column_step_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d row_step_mm = Eigen::Vector3d::Zero();
};

/// What a block, or the drawing itself, consists of.
struct DxfBlock {
  Mesh mesh;  ///< mm
  Eigen::Vector3d base_mm = Eigen::Vector3d::Zero();
  std::vector<DxfInsert> inserts;
};

/// The blocks of a drawing by their names in lower case; "" is the drawing itself.
using DxfBlocks = std::map<std::string, DxfBlock>;

/// The mesh of a drawing with its blocks where they are inserted. Inserts of blocks that the
/// drawing does not have are counted in `missing`.
///
/// @errors   Error(Input) that names the file: a block that contains itself, a drawing that would
///           take more memory than the budget; Error(Cancelled)
[[nodiscard]] Mesh expand_blocks(const DxfBlocks& blocks,
                                 const std::filesystem::path& path,
                                 const MemoryBudget& budget,
                                 const Run& run,
                                 std::size_t& missing);

/// The coordinates of an entity with an extrusion direction in those of the drawing.
///
/// @source   Autodesk, DXF Reference, Arbitrary Axis Algorithm
[[nodiscard]] Eigen::Matrix3d axes_of_extrusion(const Eigen::Vector3d& direction);

}  // namespace frangia
