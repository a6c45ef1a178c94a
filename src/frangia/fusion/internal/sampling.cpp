#include "frangia/fusion/internal/sampling.h"

#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/distance_field.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/views/view_store.h"

namespace frangia {
Sampling measure_sampling(const ViewStore& views, const CameraRays& camera, const Run& run) {
  constexpr int kRows = 16;
  std::vector<float> gaps;
  std::vector<float> sigmas;
  Sampling sampling;
  load_each_view(views, [&](std::size_t /*index*/, const View& view) {
    run.check();
    const RangeGrid& range = view.range;
    require(same_size(range.depth_mm, camera.rays),
            "the size of a view differs from that of the rig's camera");
    const auto point = [&](int x, int y) -> Eigen::Vector3f {
      return range.depth_mm(x, y) * camera.rays(x, y).homogeneous();
    };
    for (int y = kRows / 2; y < range.depth_mm.height(); y += kRows) {
      for (int x = 0; x + 1 < range.depth_mm.width(); ++x) {
        if (!(range.depth_mm(x, y) > 0.0F)) continue;
        ++sampling.points;
        sigmas.push_back(range.sigma_mm(x, y));
        if (range.depth_mm(x + 1, y) > 0.0F) gaps.push_back((point(x + 1, y) - point(x, y)).norm());
      }
    }
  });
  sampling.points *= kRows;
  sampling.spacing_mm = median_in_place(std::span(gaps));
  sampling.sigma_mm = median_in_place(std::span(sigmas));
  return sampling;
}

namespace {

/// Share of the blocks that the surface of a sphere crosses, and the crossings of such a block.
/// VoxelBudget.AssumesTheCrossingsOfASphere measures both; the budget is linear in either.
constexpr double kCrossedShare = 0.63;
constexpr double kCrossingsPerBlock = 64.0;

/// A crossing makes two triangles and one vertex. Their list exists twice while `clean_mesh` runs.
constexpr double kMeshBytesPerCrossing = 170.0;

constexpr double kBytesPerBlock =
    sizeof(DistanceField::Block) +
    kCrossedShare *
        (sizeof(EdgeCrossings::Block) +
         kCrossingsPerBlock * (sizeof(HermiteAccumulator) + sizeof(HermiteAccumulator::PlaneSum) +
                               sizeof(HermiteSample) + kMeshBytesPerCrossing));

/// Allocated blocks over the blocks that the area of a view would fill if it were flat and along
/// the grid: the band reaches into neighbouring blocks. It is a lower bound, so that no voxel size
/// is refused that fits.
constexpr double kBlocksPerFlatOne = 1.8;

}  // namespace

void VoxelBudget::check(double blocks) const {
  if (blocks <= static_cast<double>(max_blocks)) return;
  // Voxels finer than the point spacing leave gaps that coarser voxels close, so the number of
  // blocks falls more slowly than the area in blocks. FuseViews.RefusesVoxelsThatDoNotFit... fuses
  // with the size that the message names.
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
  const double block_mm = kBlockEdge * voxel_mm;
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
