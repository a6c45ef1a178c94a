#include "frangia/fusion/internal/distance_field.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/fusion/internal/blocks_near.h"
#include "frangia/rig/camera_model.h"

namespace frangia {
namespace {

/// The parameters of one view's integration, as floats for vector code.
struct Sampler {
  const LocalPlanes& view;
  FastCameraModel model;
  float front;
  float back;
  float falloff;
  float voxel;
  float deepest;
  float extrapolated_weight;
  float deep_weight;

  Sampler(const LocalPlanes& seen, const CameraModel& camera, const TruncationBand& band)
      : view(seen),
        model(camera),
        front(static_cast<float>(band.front_mm)),
        back(static_cast<float>(band.back_mm)),
        falloff(static_cast<float>(band.falloff_mm)),
        voxel(static_cast<float>(band.voxel_mm)),
        deepest(static_cast<float>(band.deepest_mm)),
        extrapolated_weight(static_cast<float>(band.extrapolated_weight)),
        deep_weight(static_cast<float>(band.deep_weight)) {}

  /// Weight of a distance, 0 outside the band. It decreases behind the surface, where a view has no
  /// measurement: the object may be thin, or end beside the ray.
  [[nodiscard]] float weight_of(float weight, float distance) const {
    const float depth = std::min(distance, 0.0F) / falloff;
    const float trust = 1.0F / ((1.0F + depth * depth) * (1.0F + depth * depth));
    const float deep = distance > -deepest ? deep_weight : 0.0F;
    const float behind = distance > -back ? weight * trust : deep;
    return distance < front ? behind : 0.0F;
  }
  /// Distance to store: one voxel below the band, so that a neighbouring crossing is not a step.
  [[nodiscard]] float truncated(float distance) const {
    return distance > -back ? distance : -voxel;
  }
};

/// Eight consecutive voxels along x, in image coordinates.
struct Row {
  template <typename T>
  using Eight = std::array<T, kBlockEdge>;

  alignas(32) Eight<float> u{};
  alignas(32) Eight<float> v{};
  alignas(32) Eight<float> depth{};
  alignas(32) Eight<std::int32_t> pixel{};
  alignas(32) Eight<std::int32_t> quad{};
  alignas(32) Eight<std::int32_t> kind{};  ///< of the quad; 0 outside the image
  alignas(32) Eight<float> weight{};
  alignas(32) Eight<float> weighted{};
};

/// Projects the voxels into the image. Points behind the camera and NaN are outside. `kExtended` is
/// that of the camera.
template <bool kExtended>
[[gnu::always_inline]] inline void project_row(Row& row,
                                               const Sampler& sampler,
                                               const Eigen::Vector3f& start,
                                               const Eigen::Vector3f& step) {
  const FastCameraModel model = sampler.model;
  const std::int32_t width = sampler.view.quads.width();
  const auto right = static_cast<float>(width);
  const auto bottom = static_cast<float>(sampler.view.quads.height());
  const float fx = start.x();
  const float fy = start.y();
  const float fz = start.z();
  const float sx = step.x();
  const float sy = step.y();
  const float sz = step.z();
  for (std::size_t i = 0; i < kBlockEdge; ++i) {
    const auto at = static_cast<float>(static_cast<std::int32_t>(i));
    const float z = fz + at * sz;
    float u = 0.0F;
    float v = 0.0F;
    model.project<kExtended>(fx + at * sx, fy + at * sy, z, u, v);
    row.depth[i] = z;
    row.u[i] = u;
    row.v[i] = v;
  }
  for (std::size_t i = 0; i < kBlockEdge; ++i) {
    float u = row.u[i];
    float v = row.v[i];
    float z = row.depth[i];
    z = u >= 0.0F ? z : -1.0F;
    z = v >= 0.0F ? z : -1.0F;
    z = u < right ? z : -1.0F;
    z = v < bottom ? z : -1.0F;
    u = z > 0.0F ? u : 0.0F;
    v = z > 0.0F ? v : 0.0F;
    const auto x = static_cast<std::int32_t>(u);
    const auto y = static_cast<std::int32_t>(v);
    row.u[i] = u;
    row.v[i] = v;
    row.depth[i] = z;
    row.quad[i] = y * width + x;
    row.pixel[i] = y * width + x + y;  // a row of pixels is one longer
  }
  const LocalPlanes::Quad* quads = sampler.view.quads.pixels().data();
  for (std::size_t i = 0; i < kBlockEdge; ++i) {
    const auto kind = static_cast<std::int32_t>(quads[row.quad[i]].kind);
    row.kind[i] = row.depth[i] > 0.0F ? kind : 0;
  }
}

/// Samples the voxels that project into smooth quads. The first loop gathers from memory, so that
/// the second one vectorizes.
[[gnu::always_inline]] inline void sample_smooth(Row& row, const Sampler& sampler) {
  constexpr auto kSmooth = static_cast<std::int32_t>(LocalPlanes::Kind::Smooth);
  const Sampler how = sampler;
  const std::int32_t width = how.view.inverse_depth.width();
  const float* q = how.view.inverse_depth.pixels().data();
  const LocalPlanes::Quad* quads = how.view.quads.pixels().data();
  alignas(32) Row::Eight<float> upper_left;
  alignas(32) Row::Eight<float> upper_right;
  alignas(32) Row::Eight<float> lower_left;
  alignas(32) Row::Eight<float> lower_right;
  alignas(32) Row::Eight<float> away;
  alignas(32) Row::Eight<float> weight;
  for (std::size_t i = 0; i < kBlockEdge; ++i) {
    const float* here = q + row.pixel[i];
    upper_left[i] = here[0];
    upper_right[i] = here[1];
    lower_left[i] = here[width];
    lower_right[i] = here[width + 1];
    away[i] = quads[row.quad[i]].distance_mm;
    weight[i] = quads[row.quad[i]].weight;
  }
  for (std::size_t i = 0; i < kBlockEdge; ++i) {
    const float right = row.u[i] - static_cast<float>(static_cast<std::int32_t>(row.u[i]));
    const float down = row.v[i] - static_cast<float>(static_cast<std::int32_t>(row.v[i]));
    const float upper = upper_left[i] + right * (upper_right[i] - upper_left[i]);
    const float lower = lower_left[i] + right * (lower_right[i] - lower_left[i]);
    const float inverse = upper + down * (lower - upper);
    const float distance = (1.0F - row.depth[i] * inverse) * away[i];
    const float share = how.weight_of(weight[i], distance);
    const bool smooth = row.kind[i] == kSmooth;
    row.weight[i] = smooth ? share : 0.0F;
    row.weighted[i] = smooth ? share * how.truncated(distance) : 0.0F;
  }
}

/// Samples a voxel that projects into a creased or extrapolated quad.
void sample_creased(Row& row, std::size_t i, const Sampler& sampler, const Eigen::Vector3f& point) {
  const LocalPlanes& view = sampler.view;
  const auto kind = static_cast<LocalPlanes::Kind>(row.kind[i]);
  const bool extrapolated = kind == LocalPlanes::Kind::Extrapolated;
  const float distance = extrapolated
                             ? view.extrapolated_mm(row.u[i], row.v[i], point)
                             : view.nearest_face(row.u[i], row.v[i], point).in_front_mm(point);
  const auto quad = static_cast<std::size_t>(row.quad[i]);
  const float weight =
      extrapolated ? sampler.extrapolated_weight : view.quads.pixels()[quad].weight;
  row.weight[i] = sampler.weight_of(weight, distance);
  row.weighted[i] = row.weight[i] * sampler.truncated(distance);
}

/// Adds a view to a block. `first` is the block's first voxel and the columns of `steps` are the
/// steps between voxels, both in camera coordinates.
FRANGIA_VECTORIZED_WIDE void add_block(DistanceField::Block& block,
                                       const Sampler& sampler,
                                       const Eigen::Vector3f& first,
                                       const Eigen::Matrix3f& steps) {
  constexpr auto kSmooth = static_cast<std::int32_t>(LocalPlanes::Kind::Smooth);
  const Eigen::Vector3f step = steps.col(0);
  Row row;
  for (int r = 0; r < kBlockEdge * kBlockEdge; ++r) {
    const int across = r % kBlockEdge;
    const int up = r / kBlockEdge;
    const Eigen::Vector3f start =
        first + steps.col(1) * static_cast<float>(across) + steps.col(2) * static_cast<float>(up);
    if (sampler.model.lens.extended) {
      project_row<true>(row, sampler, start, step);
    } else {
      project_row<false>(row, sampler, start, step);
    }
    std::int32_t seen = 0;
    std::int32_t creased = 0;
    for (std::size_t i = 0; i < kBlockEdge; ++i) {
      seen |= row.kind[i];
      creased |= row.kind[i] & ~kSmooth;
    }
    if (seen == 0) continue;
    sample_smooth(row, sampler);
    for (std::size_t i = 0; creased != 0 && i < kBlockEdge; ++i) {
      if (row.kind[i] == 0 || row.kind[i] == kSmooth) continue;
      sample_creased(row, i, sampler, start + static_cast<float>(i) * step);
    }
    DistanceField::Voxel* cells = block.data() + std::ptrdiff_t{r} * kBlockEdge;
    for (std::size_t i = 0; i < kBlockEdge; ++i) {
      cells[i].weighted_mm += row.weighted[i];
      cells[i].weight += row.weight[i];
    }
  }
}

Eigen::Vector3i coords_of(std::uint64_t key) {
  constexpr std::uint64_t kMask = (1 << 21) - 1;
  constexpr int kOffset = 1 << 20;
  return {static_cast<int>(key & kMask) - kOffset,
          static_cast<int>((key >> 21) & kMask) - kOffset,
          static_cast<int>(key >> 42) - kOffset};
}

}  // namespace

void integrate_view(DistanceField& field,
                    const LocalPlanes& view,
                    const CameraRays& camera,
                    const TruncationBand& band) {
  const std::vector<std::uint64_t> keys = blocks_near(view, camera, band);
  std::vector<std::uint32_t> touched(keys.size());
  const std::size_t known = field.blocks.size();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    touched[i] = field.index.find(keys[i]);
    if (touched[i] != BlockIndex::kNone) continue;
    touched[i] = static_cast<std::uint32_t>(field.blocks.size());
    field.index.add(keys[i], touched[i]);
    field.block_coords.push_back(coords_of(keys[i]));
    field.blocks.append_uninitialized();
  }
  const Sampler sampler(view, camera.model, band);
  const Eigen::Matrix3f steps = (view.rig_from_object.linear() * band.voxel_mm).cast<float>();
  parallel_chunks(touched.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      DistanceField::Block& block = field.blocks[touched[i]];
      if (touched[i] >= known) block.fill({0.0F, 0.0F});
      const Eigen::Vector3d corner =
          field.block_coords[touched[i]].cast<double>() * (kBlockEdge * band.voxel_mm);
      add_block(block, sampler, (view.rig_from_object * corner).cast<float>(), steps);
    }
  });
}

}  // namespace frangia
