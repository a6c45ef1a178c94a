#include "frangia/fusion/internal/blocks_near.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Voxels around a measured point within which the field is needed: the corners of its cell are up
/// to one voxel away, and the next point visited is up to kStep voxels away, of which half, plus a
/// margin for the diagonal, is covered from either side.
constexpr float kMargin = 1.75F;
constexpr double kStep = 1.05;

/// A set of block keys. A small cache drops most repeated keys before they are stored.
class KeySet {
 public:
  void add(std::uint64_t key) {
    std::uint64_t& seen = recent_[key * 0x9e3779b97f4a7c15ULL >> 56];
    if (seen == key) return;
    seen = key;
    keys_.push_back(key);
    if (keys_.size() > limit_) {
      sort_unique();
      limit_ = std::max(limit_, 2 * keys_.size());
    }
  }
  std::vector<std::uint64_t> release() {
    sort_unique();
    return std::move(keys_);
  }

 private:
  void sort_unique() {
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }

  std::array<std::uint64_t, 256> recent_{};  ///< by hash
  std::size_t limit_ = 4096;
  std::vector<std::uint64_t> keys_;
};

/// The block that holds a voxel coordinate. Faster than `std::floor`, which is a function call.
int block_of(float voxel) {
  const float block = voxel * 0.125F;
  const int toward_zero = static_cast<int>(block);
  return toward_zero - (block < static_cast<float>(toward_zero) ? 1 : 0);
}
Eigen::Array3i block_of(const Eigen::Array3f& voxel) {
  return {block_of(voxel.x()), block_of(voxel.y()), block_of(voxel.z())};
}

/// Adds all blocks of a box.
void add_box(KeySet& keys, const Eigen::Array3i& first, const Eigen::Array3i& last) {
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x)
        keys.add(block_key(x, y, z));
    }
  }
}

/// Adds all blocks that hold the corners of cells around a segment.
void add_segment(KeySet& keys, const Eigen::Array3f& from, const Eigen::Array3f& to) {
  const Eigen::Array3i first = block_of(from.min(to) - kMargin);
  const Eigen::Array3i last = block_of(from.max(to) + kMargin);
  if ((last - first).sum() <= 1) return add_box(keys, first, last);
  const Eigen::Array3f length = to - from;
  const int steps = static_cast<int>(length.abs().maxCoeff() / (2.0F * kMargin)) + 1;
  const Eigen::Array3f step = length / static_cast<float>(steps);
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Array3f point = from + step * static_cast<float>(i);
    add_box(keys, block_of(point - kMargin), block_of(point + kMargin));
  }
}

/// Pixel step at which the margins of neighbouring points still cover every cell between them.
int pixel_stride(const LocalPlanes& view, const CameraRays& camera, const TruncationBand& band) {
  const PixelBox box = view.box.within(view.inverse_depth.width(), view.inverse_depth.height());
  float nearest = 0.0F;
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x)
      nearest = std::max(nearest, view.inverse_depth(x, y));  // ignores NaN
  }
  const double voxel_px =
      band.voxel_mm * static_cast<double>(nearest) * camera.model.focal_px.minCoeff();
  return std::clamp(static_cast<int>(std::lround(kStep * voxel_px)), 1, 8);
}

}  // namespace

std::vector<std::uint64_t> blocks_near(const LocalPlanes& view,
                                       const CameraRays& camera,
                                       const TruncationBand& band) {
  const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
  const Eigen::Matrix3f rotation = (object_from_rig.linear() / band.voxel_mm).cast<float>();
  const Eigen::Vector3f origin = (object_from_rig.translation() / band.voxel_mm).cast<float>();
  constexpr float kLongest = 2.0F;  // limits the band along the ray at grazing incidence
  const auto near = static_cast<float>(band.allocation_mm / band.voxel_mm);
  const int stride = pixel_stride(view, camera, band);

  constexpr std::size_t kRows = 16;
  const PixelBox box = view.box.within(view.quads.width(), view.quads.height());
  const int left = (box.left + stride - 1) / stride * stride;
  const int top = (box.top + stride - 1) / stride * stride;
  const auto rows = static_cast<std::size_t>(std::max(0, (box.bottom - top + stride - 1) / stride));
  std::vector<std::vector<std::uint64_t>> parts((rows + kRows - 1) / kRows);
  // Beyond, single-precision coordinates are coarser than a voxel and keys of blocks repeat.
  constexpr float kMostVoxels = 4e6F;
  std::atomic<bool> too_far = false;
  parallel_chunks(rows, kRows, [&](std::size_t begin, std::size_t end) {
    KeySet keys;
    for (std::size_t row = begin; row < end; ++row) {
      const int y = top + static_cast<int>(row) * stride;
      for (int x = left; x < box.right; x += stride) {
        const LocalPlanes::Quad& quad = view.quads(x, y);
        if (quad.kind <= LocalPlanes::Kind::Extrapolated) continue;
        const float depth = 1.0F / view.inverse_depth(x, y);
        const Eigen::Vector3f ray(camera.rays(x, y).x(), camera.rays(x, y).y(), 1.0F);
        const Eigen::Vector3f point = origin + rotation * (depth * ray);
        if (!(point.cwiseAbs().maxCoeff() < kMostVoxels)) {
          too_far = true;
          return;
        }
        const Eigen::Vector3f along = (rotation * ray).normalized();  // one voxel
        const float cosine = std::max(1.0F / kLongest, quad.distance_mm / (depth * ray.norm()));
        const float reach = near / cosine;
        add_segment(keys, (point - along * reach).array(), (point + along * reach).array());
      }
    }
    parts[begin / kRows] = keys.release();
  });
  if (too_far) {
    throw Error(ErrorKind::Input,
                fmt::format("a view has points more than {:.3g} mm from the origin, too far for "
                            "voxels of {:.3g} mm; correct the poses or enlarge the voxels",
                            static_cast<double>(kMostVoxels) * band.voxel_mm,
                            band.voxel_mm));
  }
  KeySet all;
  for (const auto& part : parts) {
    for (const std::uint64_t key : part)
      all.add(key);
  }
  return all.release();
}

}  // namespace frangia
