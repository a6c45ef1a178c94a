#include "frangia/surface/distance_field.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/core/vectorised.h"
#include "frangia/surface/blocks_near.h"
#include "frangia/views/fast_lens.h"

namespace frangia {
namespace {

constexpr int kEdge = DistanceField::kEdge;

/// Of a guess beside what was seen, in 1/mm^2: it counts where nobody knows better.
constexpr float kBesideWeight = 1e-6F;

/// And of one deeper than the band: that the object is there needs no saying but at a rim, where a
/// cell would lack a corner.
constexpr float kDeepWeight = 1e-9F;
constexpr float kDeepest = 10.0F;  // times the band's depth

/// Distance of voxels from what a view saw, a row of a block at a time.
struct Sampler {
  const LocalPlanes& view;
  FastLens lens;
  float front;
  float back;
  float guess;
  float voxel;

  Sampler(const LocalPlanes& seen, const Lens& camera, const Band& band)
      : view(seen),
        lens(camera),
        front(static_cast<float>(band.front_mm)),
        back(static_cast<float>(band.back_mm)),
        guess(static_cast<float>(band.guess_mm)),
        voxel(static_cast<float>(band.voxel_mm)) {}

  /// What a view's word on a voxel counts, 0 outside the band. Behind its surface a view can only
  /// guess: the object may be thin, or end beside the ray.
  [[nodiscard]] float weighed(float weight, float distance) const {
    const float depth = std::min(distance, 0.0F) / guess;
    const float trust = 1.0F / ((1.0F + depth * depth) * (1.0F + depth * depth));
    const float deep = distance > -kDeepest * back ? kDeepWeight : 0.0F;
    const float behind = distance > -back ? weight * trust : deep;
    return distance < front ? behind : 0.0F;
  }
  /// The distance that it gives: below the band a voxel, so that a crossing beside it is no jump.
  [[nodiscard]] float told(float distance) const { return distance > -back ? distance : -voxel; }
};

/// Eight voxels in a row, seen from the view.
struct Row {
  template <typename T>
  using Eight = std::array<T, kEdge>;

  alignas(32) Eight<float> u{};
  alignas(32) Eight<float> v{};
  alignas(32) Eight<float> depth{};
  alignas(32) Eight<std::int32_t> pixel{};
  alignas(32) Eight<std::int32_t> quad{};
  alignas(32) Eight<std::int32_t> kind{};  ///< of the quad; 0 outside the image
  alignas(32) Eight<float> weight{};
  alignas(32) Eight<float> weighted{};
};

/// Where the voxels lie in the image. Points behind the camera and NaN lie outside.
[[gnu::always_inline]] inline void look_up(Row& row,
                                           const Sampler& sampler,
                                           const Eigen::Vector3f& start,
                                           const Eigen::Vector3f& step) {
  const FastLens lens = sampler.lens;
  const std::int32_t width = sampler.view.quads.width();
  const auto right = static_cast<float>(width);
  const auto bottom = static_cast<float>(sampler.view.quads.height());
  const float fx = start.x();
  const float fy = start.y();
  const float fz = start.z();
  const float sx = step.x();
  const float sy = step.y();
  const float sz = step.z();
  for (std::size_t i = 0; i < kEdge; ++i) {
    const auto at = static_cast<float>(static_cast<std::int32_t>(i));
    const float z = fz + at * sz;
    float u = 0.0F;
    float v = 0.0F;
    lens.project(fx + at * sx, fy + at * sy, z, u, v);
    row.depth[i] = z;
    row.u[i] = u;
    row.v[i] = v;
  }
  for (std::size_t i = 0; i < kEdge; ++i) {
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
  for (std::size_t i = 0; i < kEdge; ++i) {
    const auto kind = static_cast<std::int32_t>(quads[row.quad[i]].kind);
    row.kind[i] = row.depth[i] > 0.0F ? kind : 0;
  }
}

/// The voxels over smooth quads. What is strewn over memory is fetched first: the rest is vector
/// code.
[[gnu::always_inline]] inline void weigh_smooth(Row& row, const Sampler& sampler) {
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
  for (std::size_t i = 0; i < kEdge; ++i) {
    const float* here = q + row.pixel[i];
    upper_left[i] = here[0];
    upper_right[i] = here[1];
    lower_left[i] = here[width];
    lower_right[i] = here[width + 1];
    away[i] = quads[row.quad[i]].distance_mm;
    weight[i] = quads[row.quad[i]].weight;
  }
  for (std::size_t i = 0; i < kEdge; ++i) {
    const float right = row.u[i] - static_cast<float>(static_cast<std::int32_t>(row.u[i]));
    const float down = row.v[i] - static_cast<float>(static_cast<std::int32_t>(row.v[i]));
    const float upper = upper_left[i] + right * (upper_right[i] - upper_left[i]);
    const float lower = lower_left[i] + right * (lower_right[i] - lower_left[i]);
    const float inverse = upper + down * (lower - upper);
    const float distance = (1.0F - row.depth[i] * inverse) * away[i];
    const float share = how.weighed(weight[i], distance);
    const bool smooth = row.kind[i] == kSmooth;
    row.weight[i] = smooth ? share : 0.0F;
    row.weighted[i] = smooth ? share * how.told(distance) : 0.0F;
  }
}

/// A voxel where faces meet, or beside what was seen.
void weigh_rough(Row& row, std::size_t i, const Sampler& sampler, const Eigen::Vector3f& point) {
  const LocalPlanes& view = sampler.view;
  const auto kind = static_cast<LocalPlanes::Kind>(row.kind[i]);
  const bool beside = kind == LocalPlanes::Kind::Beside;
  const float distance = beside ? view.beside_mm(row.u[i], row.v[i], point)
                                : view.nearest_face(row.u[i], row.v[i], point).in_front_mm(point);
  const auto quad = static_cast<std::size_t>(row.quad[i]);
  const float weight = beside ? kBesideWeight : view.quads.pixels()[quad].weight;
  row.weight[i] = sampler.weighed(weight, distance);
  row.weighted[i] = row.weight[i] * sampler.told(distance);
}

/// Adds a view to a block, given in camera coordinates: the first voxel, and the step along each
/// axis.
FRANGIA_VECTORISED_WIDELY void add_block(DistanceField::Block& block,
                                         const Sampler& sampler,
                                         const Eigen::Vector3f& first,
                                         const Eigen::Matrix3f& steps) {
  constexpr auto kSmooth = static_cast<std::int32_t>(LocalPlanes::Kind::Smooth);
  const Eigen::Vector3f step = steps.col(0);
  Row row;
  for (int r = 0; r < kEdge * kEdge; ++r) {
    const int across = r % kEdge;
    const int up = r / kEdge;
    const Eigen::Vector3f start =
        first + steps.col(1) * static_cast<float>(across) + steps.col(2) * static_cast<float>(up);
    look_up(row, sampler, start, step);
    std::int32_t seen = 0;
    std::int32_t rough = 0;
    for (std::size_t i = 0; i < kEdge; ++i) {
      seen |= row.kind[i];
      rough |= row.kind[i] & ~kSmooth;
    }
    if (seen == 0) continue;
    weigh_smooth(row, sampler);
    for (std::size_t i = 0; rough != 0 && i < kEdge; ++i) {
      if (row.kind[i] == 0 || row.kind[i] == kSmooth) continue;
      weigh_rough(row, i, sampler, start + static_cast<float>(i) * step);
    }
    DistanceField::Voxel* cells = block.data() + std::ptrdiff_t{r} * kEdge;
    for (std::size_t i = 0; i < kEdge; ++i) {
      cells[i].weighted_mm += row.weighted[i];
      cells[i].weight += row.weight[i];
    }
  }
}

Eigen::Vector3i place_of(std::uint64_t key) {
  constexpr std::uint64_t kMask = (1 << 21) - 1;
  constexpr int kOffset = 1 << 20;
  return {static_cast<int>(key & kMask) - kOffset,
          static_cast<int>((key >> 21) & kMask) - kOffset,
          static_cast<int>(key >> 42) - kOffset};
}

}  // namespace

void add_view(DistanceField& field,
              const LocalPlanes& view,
              const CameraRays& camera,
              const Band& band) {
  const std::vector<std::uint64_t> keys = blocks_near(view, camera, band);
  std::vector<std::uint32_t> touched(keys.size());
  const std::size_t known = field.blocks.size();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    touched[i] = field.index.find(keys[i]);
    if (touched[i] != BlockIndex::kNone) continue;
    touched[i] = static_cast<std::uint32_t>(field.blocks.size());
    field.index.add(keys[i], touched[i]);
    field.places.push_back(place_of(keys[i]));
    field.blocks.add();
  }
  const Sampler sampler(view, camera.lens, band);
  const Eigen::Matrix3f steps = (view.rig_from_object.linear() * band.voxel_mm).cast<float>();
  parallel_chunks(touched.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      DistanceField::Block& block = field.blocks[touched[i]];
      if (touched[i] >= known) block.fill({0.0F, 0.0F});
      const Eigen::Vector3d corner =
          field.places[touched[i]].cast<double>() * (kEdge * band.voxel_mm);
      add_block(block, sampler, (view.rig_from_object * corner).cast<float>(), steps);
    }
  });
}

}  // namespace frangia
