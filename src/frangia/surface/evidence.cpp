#include "frangia/surface/evidence.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/surface/fast_lens.h"

namespace frangia {
namespace {

constexpr int kTile = 4;  // pixels; sight is clear when it is so over 3 x 3 tiles

/// The nearest surface (largest inverse depth) within a tile of each pixel's tile and its
/// neighbours.
Image<float> nearest_of(const Image<float>& inverse_depth) {
  const int width = (inverse_depth.width() + kTile - 1) / kTile;
  const int height = (inverse_depth.height() + kTile - 1) / kTile;
  Image<float> tiles(width, height);
  parallel_rows(height, [&](int row) {
    for (int y = row * kTile; y < std::min((row + 1) * kTile, inverse_depth.height()); ++y) {
      for (int x = 0; x < inverse_depth.width(); ++x) {
        tiles(x / kTile, row) = std::max(tiles(x / kTile, row), inverse_depth(x, y));
      }
    }
  });
  Image<float> nearest(width, height);
  parallel_rows(height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      float largest = 0.0F;
      for (int y = std::max(0, row - 1); y <= std::min(height - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(width - 1, column + 1); ++x) {
          largest = std::max(largest, tiles(x, y));
        }
      }
      nearest(column, row) = largest;
    }
  });
  return nearest;
}

/// Autocorrelation of the triangle that linear interpolation spreads a pixel over, at lag x.
float cubic_spline(float x) {
  if (x >= 2.0F) return 0.0F;
  if (x >= 1.0F) return (2.0F - x) * (2.0F - x) * (2.0F - x) / 6.0F;
  return 2.0F / 3.0F - x * x + 0.5F * x * x * x;
}

struct Questioner {
  const LocalPlanes& view;
  FastLens lens;
  Image<float> nearest;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float pixel_rad;
  float voxel_mm;
  float near_mm;
  float through_mm;

  void ask(Evidence& evidence, const Eigen::Vector3f& point_mm, int outward) const {
    const Eigen::Vector3f p = rotation * point_mm + translation;
    float u = 0.0F;
    float v = 0.0F;
    lens.project(p.x(), p.y(), p.z(), u, v);
    if (!(p.z() > 0.0F && u >= 0.0F && v >= 0.0F && u < static_cast<float>(view.quads.width()) &&
          v < static_cast<float>(view.quads.height()))) {
      return;
    }
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const LocalPlanes::Quad& quad = view.quads(x, y);
    if (quad.weight == 0.0F) return;
    const float right = u - static_cast<float>(x);
    const float down = v - static_cast<float>(y);
    const Image<float>& q = view.inverse_depth;
    const float upper = q(x, y) + right * (q(x + 1, y) - q(x, y));
    const float lower = q(x, y + 1) + right * (q(x + 1, y + 1) - q(x, y + 1));
    const float inverse = upper + down * (lower - upper);
    const float distance = (1.0F - p.z() * inverse) * quad.distance_mm;
    if (std::abs(distance) < near_mm) {
      const Eigen::Vector3f& plane = view.plane_per_mm(x + (right > 0.5F), y + (down > 0.5F));
      const Eigen::Vector3f normal = rotation.transpose() * plane * (-1.0F / plane.norm());
      const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
      if (along < -0.3F) return;  // the back of a thin wall
      const float cosine = inverse * quad.distance_mm * p.z() / p.norm();
      support(evidence, distance, quad.weight, cosine, p.z());
      evidence.normal += normal * quad.weight;
    } else if (distance > through_mm) {
      const float blocking = nearest(x / kTile, y / kTile);
      if ((1.0F - p.z() * blocking) * quad.distance_mm > through_mm)
        evidence.against += quad.weight;
    }
  }

  void support(Evidence& evidence, float distance, float quad_weight, float cosine, float z) const {
    const float ratio = distance / near_mm;
    const float trust = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);  // Tukey's biweight
    const float w = quad_weight * trust;
    const float cosine2 = cosine * cosine;
    const float variance = cosine2 * cosine2 / quad_weight;  // of one pixel, along the normal
    constexpr float kInterpolated = 4.0F / 9.0F;             // of it left after interpolation
    const float spacing = z * pixel_rad / std::sqrt(cosine);
    const float per_axis = 0.5F * (2.0F / 3.0F + cubic_spline(voxel_mm / spacing));
    evidence.weight += w;
    evidence.weight_squared += w * w;
    evidence.offset += w * distance;
    evidence.offset_squared += w * distance * distance;
    evidence.noise += w * variance * kInterpolated;
    evidence.noise_squared += w * w * variance * kInterpolated;
    evidence.vertex_noise += w * w * variance * per_axis * per_axis;
    ++evidence.views;
  }
};

}  // namespace

void add_evidence(std::vector<Evidence>& evidence,
                  const Crossings& crossings,
                  const LocalPlanes& view,
                  const CameraRays& camera,
                  const EvidenceOptions& options) {
  const Questioner questioner{view,
                              FastLens(camera.lens),
                              nearest_of(view.inverse_depth),
                              view.rig_from_object.linear().cast<float>(),
                              view.rig_from_object.translation().cast<float>(),
                              static_cast<float>(1.0 / camera.lens.focal_px.mean()),
                              static_cast<float>(crossings.voxel_mm),
                              static_cast<float>(options.near_mm),
                              static_cast<float>(options.through_mm)};
  parallel_chunks(evidence.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      questioner.ask(evidence[i], crossings.points_mm[i], crossings.outward[i]);
    }
  });
}

void add_disagreement(std::vector<Evidence>& evidence, const Crossings& crossings) {
  parallel_chunks(crossings.blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = crossings.blocks[block].first_crossing.front();
      const std::size_t last = block + 1 < crossings.blocks.size()
                                   ? crossings.blocks[block + 1].first_crossing.front()
                                   : evidence.size();
      float excess = 0.0F;  // of the scatter between views over what their noise explains
      float freedom = 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const Evidence& e = evidence[i];
        if (e.views < 2) continue;
        const float scatter = e.offset_squared - e.offset * e.offset / e.weight;
        const float expected = e.noise - e.noise_squared / e.weight;
        excess += (scatter - expected) / e.weight;
        freedom += 1.0F - e.weight_squared / (e.weight * e.weight);
      }
      if (!(excess > 0.0F && freedom > 0.0F)) continue;
      const float variance = excess / freedom;
      for (std::size_t i = first; i < last; ++i) {
        evidence[i].vertex_noise += variance * evidence[i].weight_squared;
      }
    }
  });
}

}  // namespace frangia
