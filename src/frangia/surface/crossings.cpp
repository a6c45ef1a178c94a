#include "frangia/surface/crossings.h"

#include <bit>
#include <cmath>
#include <memory>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/surface/cell_loops.h"

namespace frangia {
namespace {

constexpr int kEdge = DistanceField::kEdge;
constexpr float kLargestJump = 2.5F;  // voxels, between the ends of an edge one voxel long

/// Distances at the corners of a block's cells: 9^3, NaN where unseen.
struct Corners {
  static constexpr int kSide = kEdge + 1;
  std::array<float, kSide * kSide * kSide> distance{};

  static constexpr std::size_t at(int x, int y, int z) {
    return static_cast<std::size_t>(x + kSide * (y + kSide * z));
  }
};

constexpr std::size_t voxel_at(int x, int y, int z) {
  return static_cast<std::size_t>((x & 7) | (y & 7) << 3 | (z & 7) << 6);
}

Corners corners_of(const DistanceField& field, const Eigen::Vector3i& place) {
  std::array<const DistanceField::Block*, 8> around{};
  for (int i = 0; i < 8; ++i) {
    const auto found = field.index.find(
        block_key(place.x() + (i & 1), place.y() + (i >> 1 & 1), place.z() + (i >> 2)));
    if (found != field.index.end())
      around[static_cast<std::size_t>(i)] = &field.blocks[found->second];
  }
  Corners corners;
  for (int z = 0; z <= kEdge; ++z) {
    for (int y = 0; y <= kEdge; ++y) {
      for (int x = 0; x <= kEdge; ++x) {
        const auto* block =
            around[static_cast<std::size_t>((x >> 3) | (y >> 3) << 1 | (z >> 3) << 2)];
        const auto voxel = block != nullptr ? (*block)[voxel_at(x, y, z)] : DistanceField::Voxel{};
        corners.distance[Corners::at(x, y, z)] =
            voxel.weight > 0.0F ? voxel.weighted_mm / voxel.weight : kMissing;
      }
    }
  }
  return corners;
}

/// What one block holds, before the blocks are numbered through.
struct Found {
  std::unique_ptr<Crossings::Block> block = std::make_unique<Crossings::Block>();
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<std::int8_t> outward;
  std::uint32_t vertices = 0;
};

std::uint8_t pattern_at(const Corners& corners, int x, int y, int z, float largest_jump) {
  std::array<float, 8> d{};
  unsigned inside = 0;
  for (int c = 0; c < 8; ++c) {
    const float value = corners.distance[Corners::at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
    if (std::isnan(value)) return 0;
    d[static_cast<std::size_t>(c)] = value;
    if (value < 0.0F) inside |= 1U << static_cast<unsigned>(c);
  }
  if (inside == 0 || inside == 255) return 0;
  for (int edge = 0; edge < 12; ++edge) {
    const auto [low, high] = edge_corners(edge);
    const float a = d[static_cast<std::size_t>(low)];
    const float b = d[static_cast<std::size_t>(high)];
    if ((a < 0.0F) != (b < 0.0F) && std::abs(a - b) > largest_jump) return 0;
  }
  return static_cast<std::uint8_t>(inside);
}

void add_crossings(Found& found,
                   const Corners& corners,
                   const Eigen::Vector3i& voxel,
                   float edge_mm) {
  const int x = voxel.x() & 7;
  const int y = voxel.y() & 7;
  const int z = voxel.z() & 7;
  const float here = corners.distance[Corners::at(x, y, z)];
  const std::size_t i = voxel_at(x, y, z);
  found.block->first_crossing[i] = static_cast<std::uint32_t>(found.points_mm.size());
  for (int axis = 0; axis < 3; ++axis) {
    const float there =
        corners.distance[Corners::at(x + (axis == 0), y + (axis == 1), z + (axis == 2))];
    if (!((here < 0.0F) != (there < 0.0F) && std::abs(here - there) <= kLargestJump * edge_mm))
      continue;
    Eigen::Vector3f point = voxel.cast<float>();
    point[axis] += here / (here - there);
    found.block->axes[i] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(axis));
    found.points_mm.emplace_back(point * edge_mm);
    found.outward.push_back(static_cast<std::int8_t>(there < 0.0F ? -axis - 1 : axis + 1));
  }
}

std::unique_ptr<Found> search(const DistanceField& field, const Eigen::Vector3i& place) {
  const Corners corners = corners_of(field, place);
  bool any_inside = false;
  bool any_outside = false;
  for (const float d : corners.distance) {
    any_inside = any_inside || d < 0.0F;
    any_outside = any_outside || d >= 0.0F;
  }
  if (!any_inside || !any_outside) return nullptr;
  const auto edge_mm = static_cast<float>(field.voxel_mm);
  auto found = std::make_unique<Found>();
  for (int z = 0; z < kEdge; ++z) {
    for (int y = 0; y < kEdge; ++y) {
      for (int x = 0; x < kEdge; ++x) {
        const std::size_t i = voxel_at(x, y, z);
        found->block->inside[i] = pattern_at(corners, x, y, z, kLargestJump * edge_mm);
        found->block->first_vertex[i] = found->vertices;
        found->vertices += cell_loops()[found->block->inside[i]].count;
        add_crossings(*found, corners, place * kEdge + Eigen::Vector3i(x, y, z), edge_mm);
      }
    }
  }
  const bool empty = found->points_mm.empty() && found->vertices == 0;
  return empty ? nullptr : std::move(found);
}

}  // namespace

Crossings::Address Crossings::at(const Eigen::Vector3i& voxel) const {
  const auto found = index.find(block_key(voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3));
  if (found == index.end()) return {};
  return {blocks[found->second].get(), voxel_at(voxel.x(), voxel.y(), voxel.z())};
}

std::uint32_t Crossings::crossing(const Eigen::Vector3i& voxel, int axis) const {
  const Address address = at(voxel);
  const unsigned lower =
      address.block->axes[address.voxel] & ((1U << static_cast<unsigned>(axis)) - 1U);
  return address.block->first_crossing[address.voxel] +
         static_cast<std::uint32_t>(std::popcount(lower));
}

Crossings find_crossings(const DistanceField& field) {
  std::vector<std::unique_ptr<Found>> parts(field.places.size());
  parallel_chunks(parts.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      parts[i] = search(field, field.places[i]);
  });
  Crossings all;
  all.voxel_mm = field.voxel_mm;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i]) continue;
    Found& part = *parts[i];
    const auto crossings = static_cast<std::uint32_t>(all.points_mm.size());
    for (std::uint32_t& first : part.block->first_crossing)
      first += crossings;
    for (std::uint32_t& first : part.block->first_vertex)
      first += static_cast<std::uint32_t>(all.vertices);
    all.index.emplace(block_key(field.places[i]), static_cast<std::uint32_t>(all.blocks.size()));
    all.places.push_back(field.places[i]);
    all.blocks.push_back(std::move(part.block));
    all.points_mm.insert(all.points_mm.end(), part.points_mm.begin(), part.points_mm.end());
    all.outward.insert(all.outward.end(), part.outward.begin(), part.outward.end());
    all.vertices += part.vertices;
    parts[i].reset();
  }
  return all;
}

}  // namespace frangia
