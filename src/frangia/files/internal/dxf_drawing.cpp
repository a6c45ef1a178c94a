#include "frangia/files/internal/dxf_drawing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/append_transformed.h"
#include "frangia/files/internal/check_mesh.h"
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
