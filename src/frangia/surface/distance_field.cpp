#include "frangia/surface/distance_field.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/surface/fast_lens.h"

namespace frangia {
namespace {

constexpr int kEdge = DistanceField::kEdge;

/// Of a guess beside what was seen, in 1/mm^2: it counts where nobody knows better.
constexpr float kBesideWeight = 1e-6F;

/// Distance of a voxel from what a view saw, at the voxel's pixel.
struct Sampler {
  const LocalPlanes& view;
  FastLens lens;
  float front;
  float back;
  float guess;

  Sampler(const LocalPlanes& seen, const Lens& camera, const Band& band)
      : view(seen),
        lens(camera),
        front(static_cast<float>(band.front_mm)),
        back(static_cast<float>(band.back_mm)),
        guess(static_cast<float>(band.guess_mm)) {}

  void add(DistanceField::Voxel& cell, float u, float v, const Eigen::Vector3f& point) const {
    const LocalPlanes::Quad* quad = view.quad_or_beside(u, v);
    if (quad == nullptr || !(point.z() > 0.0F)) return;
    float weight = quad->weight;
    float distance = 0.0F;
    if (quad->kind == LocalPlanes::Kind::Smooth) {
      distance = (1.0F - point.z() * view.inverse_depth_at(u, v)) * quad->distance_mm;
    } else if (quad->kind == LocalPlanes::Kind::Beside) {
      distance = view.beside_mm(u, v, point);
      weight = kBesideWeight;
    } else {
      distance = view.nearest_face(u, v, point).in_front_mm(point);
    }
    if (!(distance < front && distance > -back)) return;
    // Behind its surface a view can only guess: the object may be thin, or end beside the ray.
    const float depth = distance < 0.0F ? distance / guess : 0.0F;
    const float trust = 1.0F / ((1.0F + depth * depth) * (1.0F + depth * depth));
    cell.weighted_mm += weight * trust * distance;
    cell.weight += weight * trust;
  }
};

/// Adds a view to a block, given in camera coordinates: the first voxel, and the step along each
/// axis.
[[gnu::target_clones("avx512f", "avx2", "default")]] void add_block(DistanceField::Block& block,
                                                                    const Sampler& sampler,
                                                                    const Eigen::Vector3f& first,
                                                                    const Eigen::Matrix3f& steps) {
  alignas(32) std::array<float, kEdge> u{};
  alignas(32) std::array<float, kEdge> v{};
  for (int row = 0; row < kEdge * kEdge; ++row) {
    const Eigen::Vector3f start = first + steps.col(1) * static_cast<float>(row % kEdge) +
                                  steps.col(2) * static_cast<float>(row / kEdge);
    for (std::size_t i = 0; i < kEdge; ++i) {
      const auto step = static_cast<float>(i);
      sampler.lens.project(start.x() + step * steps(0, 0),
                           start.y() + step * steps(1, 0),
                           start.z() + step * steps(2, 0),
                           u[i],
                           v[i]);
    }
    DistanceField::Voxel* cells = block.data() + row * kEdge;
    for (std::size_t i = 0; i < kEdge; ++i) {
      sampler.add(cells[i], u[i], v[i], start + static_cast<float>(i) * steps.col(0));
    }
  }
}

/// Collects keys of blocks, cheap when the same ones come again and again.
class KeySet {
 public:
  void add(std::uint64_t key) {
    for (const std::uint64_t seen : recent_) {
      if (seen == key) return;
    }
    recent_[next_] = key;
    next_ = (next_ + 1) % recent_.size();
    keys_.push_back(key);
    if (keys_.size() > limit_) {
      tidy();
      limit_ = std::max(limit_, 2 * keys_.size());
    }
  }
  std::vector<std::uint64_t> take() {
    tidy();
    return std::move(keys_);
  }

 private:
  void tidy() {
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }

  std::array<std::uint64_t, 8> recent_{};
  std::size_t next_ = 0;
  std::size_t limit_ = 4096;
  std::vector<std::uint64_t> keys_;
};

/// All blocks that a box of voxel coordinates meets.
void add_box(KeySet& keys, const Eigen::Array3f& low, const Eigen::Array3f& high) {
  const Eigen::Array3i first = low.floor().cast<int>();
  const Eigen::Array3i last = high.floor().cast<int>();
  for (int z = first.z() >> 3; z <= last.z() >> 3; ++z) {
    for (int y = first.y() >> 3; y <= last.y() >> 3; ++y) {
      for (int x = first.x() >> 3; x <= last.x() >> 3; ++x)
        keys.add(block_key(x, y, z));
    }
  }
}

/// All blocks that hold the corners of cells around the segment.
void add_along(KeySet& keys, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  constexpr float kMargin = 1.75F;  // the corners of a cell are so far from a point in it
  const Eigen::Array3f low = from.cwiseMin(to).array() - kMargin;
  const Eigen::Array3f high = from.cwiseMax(to).array() + kMargin;
  const Eigen::Array3f block = (low * 0.125F).floor() * 8.0F;
  if ((high < block + 8.0F).all()) return add_box(keys, low, low);
  const float length = (to - from).norm();
  const int steps = static_cast<int>(length / 2.0F) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Array3f point =
        from + (to - from) * (static_cast<float>(i) / static_cast<float>(steps));
    add_box(keys, point - kMargin, point + kMargin);
  }
}

/// How many pixels to step so that no voxel between two of them is left out.
int pixel_stride(const LocalPlanes& view, const CameraRays& camera, const Band& band) {
  float nearest = 0.0F;
  for (const float q : view.inverse_depth.pixels())
    nearest = std::max(nearest, q);
  const double pixels =
      band.voxel_mm * static_cast<double>(nearest) * camera.lens.focal_px.minCoeff();
  return std::clamp(static_cast<int>(pixels), 1, 8);
}

Eigen::Vector3i place_of(std::uint64_t key) {
  constexpr std::uint64_t kMask = (1 << 21) - 1;
  constexpr int kOffset = 1 << 20;
  return {static_cast<int>(key & kMask) - kOffset,
          static_cast<int>((key >> 21) & kMask) - kOffset,
          static_cast<int>(key >> 42) - kOffset};
}

}  // namespace

std::vector<std::uint64_t> blocks_near(const LocalPlanes& view,
                                       const CameraRays& camera,
                                       const Band& band) {
  const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
  const Eigen::Matrix3f rotation = (object_from_rig.linear() / band.voxel_mm).cast<float>();
  const Eigen::Vector3f origin = (object_from_rig.translation() / band.voxel_mm).cast<float>();
  constexpr float kLongest = 2.0F;  // at grazing incidence the band along the ray has no end
  const auto per_voxel = static_cast<float>(1.0 / band.voxel_mm);
  const int stride = pixel_stride(view, camera, band);

  constexpr std::size_t kRows = 16;
  const std::size_t rows = static_cast<std::size_t>((view.quads.height() + stride - 1) / stride);
  std::vector<std::vector<std::uint64_t>> parts((rows + kRows - 1) / kRows);
  parallel_chunks(rows, kRows, [&](std::size_t begin, std::size_t end) {
    KeySet keys;
    for (int y = static_cast<int>(begin) * stride; y < static_cast<int>(end) * stride;
         y += stride) {
      for (int x = 0; x < view.quads.width(); x += stride) {
        const LocalPlanes::Quad& quad = view.quads(x, y);
        if (quad.kind <= LocalPlanes::Kind::Beside) continue;
        const float depth = 1.0F / view.inverse_depth(x, y);
        const Eigen::Vector3f ray(camera.rays(x, y).x(), camera.rays(x, y).y(), 1.0F);
        const Eigen::Vector3f point = origin + rotation * (depth * ray);
        const Eigen::Vector3f along = (rotation * ray).normalized();  // one voxel
        const float cosine = std::max(1.0F / kLongest, quad.distance_mm / (depth * ray.norm()));
        const float reach = per_voxel / cosine;
        add_along(keys,
                  point - along * (static_cast<float>(band.front_mm) * reach),
                  point + along * (static_cast<float>(band.back_mm) * reach));
      }
    }
    parts[begin / kRows] = keys.take();
  });
  KeySet all;
  for (const auto& part : parts) {
    for (const std::uint64_t key : part)
      all.add(key);
  }
  return all.take();
}

void add_view(DistanceField& field,
              const LocalPlanes& view,
              const CameraRays& camera,
              const Band& band) {
  const std::vector<std::uint64_t> keys = blocks_near(view, camera, band);
  std::vector<std::uint32_t> touched;
  touched.reserve(keys.size());
  for (const std::uint64_t key : keys) {
    const auto [entry, fresh] =
        field.index.try_emplace(key, static_cast<std::uint32_t>(field.blocks.size()));
    if (fresh) {
      field.places.push_back(place_of(key));
      field.blocks.emplace_back();
    }
    touched.push_back(entry->second);
  }
  const Sampler sampler(view, camera.lens, band);
  const Eigen::Matrix3f steps = (view.rig_from_object.linear() * band.voxel_mm).cast<float>();
  parallel_chunks(touched.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d corner =
          field.places[touched[i]].cast<double>() * (kEdge * band.voxel_mm);
      add_block(
          field.blocks[touched[i]], sampler, (view.rig_from_object * corner).cast<float>(), steps);
    }
  });
}

}  // namespace frangia
