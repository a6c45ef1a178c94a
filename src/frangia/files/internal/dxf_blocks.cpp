#include "frangia/files/internal/dxf_blocks.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/append_transformed.h"
#include "frangia/files/internal/mesh_memory.h"

namespace frangia {
namespace {

class BlockExpander {
 public:
  BlockExpander(const DxfBlocks& blocks,
                const std::filesystem::path& path,
                const MemoryBudget& budget,
                const Run& run)
      : blocks_(blocks), path_(path), budget_(budget), run_(run) {}

  Mesh expand(std::size_t& missing) {
    budget_.check(memory_of(""));
    Mesh all;
    add("", Eigen::Affine3d::Identity(), all);
    missing = missing_;
    return all;
  }

 private:
  /// Memory of a block with all that it contains, without expanding it.
  double memory_of(const std::string& name) {
    const auto block = blocks_.find(name);
    if (block == blocks_.end()) return 0.0;
    if (const auto known = memory_.find(name); known != memory_.end()) return known->second;
    constexpr std::size_t kMostNested = 64;
    if (!open_.insert(name).second || open_.size() > kMostNested) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{}: a block contains itself, or blocks are nested more than {} deep; "
                      "export it again",
                      path_.string(),
                      kMostNested));
    }
    constexpr double kPerInsert = 100.0;
    const Mesh& mesh = block->second.mesh;
    double bytes = mesh_memory_bytes(static_cast<double>(mesh.vertices_mm.size()),
                                     static_cast<double>(mesh.triangles.size()));
    for (const DxfInsert& insert : block->second.inserts) {
      bytes += static_cast<double>(insert.columns) * static_cast<double>(insert.rows) *
               (kPerInsert + memory_of(insert.block));
    }
    open_.erase(name);
    memory_[name] = bytes;
    return bytes;
  }

  void add(const std::string& name, const Eigen::Affine3d& mm_from_block, Mesh& all) {
    run_.check();
    const auto block = blocks_.find(name);
    if (block == blocks_.end()) {
      ++missing_;
      return;
    }
    if (!block->second.mesh.empty())
      append_transformed(all, block->second.mesh, mm_from_block, path_);
    for (const DxfInsert& insert : block->second.inserts) {
      const auto inner = blocks_.find(insert.block);
      const Eigen::Vector3d base_mm =
          inner == blocks_.end() ? Eigen::Vector3d::Zero() : inner->second.base_mm;
      for (std::int64_t row = 0; row < insert.rows; ++row) {
        for (std::int64_t column = 0; column < insert.columns; ++column) {
          const Eigen::Vector3d step = static_cast<double>(column) * insert.column_step_mm +
                                       static_cast<double>(row) * insert.row_step_mm;
          add(insert.block,
              mm_from_block * Eigen::Translation3d(step) * insert.mm_from_block *
                  Eigen::Translation3d(-base_mm),
              all);
        }
      }
    }
  }

  const DxfBlocks& blocks_;
  const std::filesystem::path& path_;
  const MemoryBudget& budget_;
  const Run& run_;
  std::map<std::string, double> memory_;
  std::set<std::string> open_;
  std::size_t missing_ = 0;
};

}  // namespace

Mesh expand_blocks(const DxfBlocks& blocks,
                   const std::filesystem::path& path,
                   const MemoryBudget& budget,
                   const Run& run,
                   std::size_t& missing) {
  return BlockExpander(blocks, path, budget, run).expand(missing);
}

Eigen::Matrix3d axes_of_extrusion(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = direction.stableNormalized();
  if (!z.allFinite() || z.isZero()) return Eigen::Matrix3d::Identity();
  constexpr double kNear = 1.0 / 64.0;
  const bool near_z = std::abs(z.x()) < kNear && std::abs(z.y()) < kNear;
  const Eigen::Vector3d world = near_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes.col(0) = world.cross(z).normalized();
  axes.col(1) = z.cross(axes.col(0));
  axes.col(2) = z;
  return axes;
}

}  // namespace frangia
