#include "frangia/fusion/internal/voxel_budget.h"

#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/fusion/internal/distance_field.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/hermite_samples.h"

namespace frangia {
namespace {

/// Measured on a sphere: of the blocks this share is crossed, 64 times each, and a crossing makes
/// two triangles and a vertex, which are copied once.
constexpr double kBytesPerBlock =
    sizeof(DistanceField::Block) +
    0.63 * (sizeof(EdgeCrossings::Block) +
            64.0 * (sizeof(HermiteAccumulator) + sizeof(HermiteAccumulator::PlaneSum) +
                    sizeof(HermiteSample) + 170.0));

/// Blocks for each that the surface of one view would fill: they reach into the neighbours.
constexpr double kBlocksPerFlatOne = 1.8;

}  // namespace

void VoxelBudget::check(double blocks) const {
  if (blocks <= static_cast<double>(max_blocks)) return;
  // Blocks finer than the points are apart leave gaps that coarser ones fill: the size named must
  // fit.
  constexpr double kSpare = 2.4;
  const double needed_gb = blocks * kBytesPerBlock * 1e-9;
  throw Error(
      ErrorKind::Input,
      fmt::format("voxels of {:.3g} mm need {:.2g} GB of memory, more than the {:.2g} GB allowed; "
                  "voxels of {:.2g} mm fit",
                  voxel_mm,
                  needed_gb,
                  static_cast<double>(max_blocks) * kBytesPerBlock * 1e-9,
                  kSpare * voxel_mm * std::sqrt(blocks / static_cast<double>(max_blocks))));
}

void VoxelBudget::check(const Sampling& sampling, std::size_t views) const {
  const double points = static_cast<double>(sampling.points) / static_cast<double>(views);
  const double block_mm = DistanceField::kEdge * voxel_mm;
  check(kBlocksPerFlatOne * points * std::pow(sampling.spacing_mm / block_mm, 2));
}

VoxelBudget voxel_budget(double voxel_mm, std::size_t max_memory_mb) {
  double bytes = 1e6 * static_cast<double>(max_memory_mb);
  if (max_memory_mb == 0) {
    bytes = 0.5 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
            static_cast<double>(::sysconf(_SC_PAGESIZE));
  }
  return {voxel_mm, static_cast<std::size_t>(bytes / kBytesPerBlock)};
}

}  // namespace frangia
