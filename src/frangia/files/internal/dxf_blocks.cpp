#include "frangia/files/internal/dxf_blocks.h"

#include <cmath>
#include <set>
#include <utility>

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

  DxfExpanded expand() {
    budget_.check(memory_of(""));
    add("", Eigen::Affine3d::Identity(), {});
    return std::move(found_);
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
    double bytes = 0.0;
    for (const Mesh* mesh : {&block->second.mesh, &block->second.on_layer_0})
      bytes += mesh_memory_bytes(static_cast<double>(mesh->vertices_mm.size()),
                                 static_cast<double>(mesh->triangles.size()));
    for (const DxfInsert& insert : block->second.inserts) {
      bytes += static_cast<double>(insert.columns) * static_cast<double>(insert.rows) *
               (kPerInsert + memory_of(insert.block));
    }
    open_.erase(name);
    memory_[name] = bytes;
    return bytes;
  }

  void add(const std::string& name,
           const Eigen::Affine3d& mm_from_block,
           const DxfLayerState& layer) {
    run_.check();
    const auto found = blocks_.find(name);
    if (found == blocks_.end()) {
      ++found_.missing;
      return;
    }
    const DxfBlock& block = found->second;
    if (!block.external.empty()) {
      ++found_.externals[block.external];
      return;
    }
    if (!block.mesh.empty()) append_transformed(found_.mesh, block.mesh, mm_from_block, path_);
    if (layer.off || layer.frozen) {
      found_.hidden += block.entities_on_layer_0;
    } else if (!block.on_layer_0.empty()) {
      append_transformed(found_.mesh, block.on_layer_0, mm_from_block, path_);
    }
    for (const DxfInsert& insert : block.inserts)
      add_insert(insert, mm_from_block, insert.on_layer_0 ? layer : insert.layer);
  }

  void add_insert(const DxfInsert& insert,
                  const Eigen::Affine3d& mm_from_block,
                  const DxfLayerState& layer) {
    if (layer.frozen) {
      ++found_.hidden;
      return;
    }
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
            layer);
      }
    }
  }

  const DxfBlocks& blocks_;
  const std::filesystem::path& path_;
  const MemoryBudget& budget_;
  const Run& run_;
  std::map<std::string, double> memory_;
  std::set<std::string> open_;
  DxfExpanded found_;
};

}  // namespace

DxfExpanded expand_blocks(const DxfBlocks& blocks,
                          const std::filesystem::path& path,
                          const MemoryBudget& budget,
                          const Run& run) {
  return BlockExpander(blocks, path, budget, run).expand();
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
