#include "frangia/surface/evidence.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/surface/fast_lens.h"

namespace frangia {
namespace {

constexpr float kAgree = 0.8F;  // cosine between normals of one face
constexpr float kBack = -0.3F;  // a normal that points so far inward is the back of a thin wall
constexpr int kTile = 4;        // pixels; sight is clear when it is so over 3 x 3 tiles

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

struct Questioner {
  const LocalPlanes& view;
  FastLens lens;
  Image<float> nearest;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float pixel_rad;
  float near_mm;
  float through_mm;

  void ask(Evidence& evidence, const Eigen::Vector3f& point_mm, int outward) const {
    const Eigen::Vector3f p = rotation * point_mm + translation;
    float u = 0.0F;
    float v = 0.0F;
    lens.project(p.x(), p.y(), p.z(), u, v);
    const LocalPlanes::Quad* quad = view.quad_at(u, v);
    if (quad == nullptr || !(p.z() > 0.0F)) return;
    const bool smooth = quad->kind == LocalPlanes::Kind::Smooth;
    const LocalPlanes::Plane& plane =
        smooth ? view.planes(static_cast<int>(u + 0.5F), static_cast<int>(v + 0.5F))
               : view.nearest_face(u, v, p);
    const float distance = smooth ? (1.0F - p.z() * view.inverse_depth_at(u, v)) * quad->distance_mm
                                  : plane.in_front_mm(p);
    if (std::abs(distance) < near_mm) {
      const Eigen::Vector3f normal = rotation.transpose() * plane.normal;
      const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
      if (along < kBack) return;
      const float cosine = -plane.normal.dot(p) / p.norm();
      add(face_for(evidence, normal), normal, distance, {quad->weight, cosine, p.z()});
    } else if (distance > through_mm) {
      const float blocking = nearest(static_cast<int>(u) / kTile, static_cast<int>(v) / kTile);
      if ((1.0F - p.z() * blocking) * quad->distance_mm > through_mm)
        evidence.against += quad->weight;
    }
  }

  /// The face that slopes as the view says, or a new one.
  static Evidence::Face& face_for(Evidence& evidence, const Eigen::Vector3f& normal) {
    const auto agreement = [&](const Evidence::Face& face) {
      return face.views == 0 ? kAgree : normal.dot(face.normal) / face.normal.norm();
    };
    const float first = agreement(evidence.faces[0]);
    if (first >= kAgree) return evidence.faces[0];
    return evidence.faces[agreement(evidence.faces[1]) > first ? 1 : 0];
  }

  struct Pixel {
    float weight;
    float cosine;
    float depth_mm;
  };

  void add(Evidence::Face& face,
           const Eigen::Vector3f& normal,
           float distance,
           const Pixel& pixel) const {
    const float ratio = distance / near_mm;
    const float trust = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);  // Tukey's biweight
    const float w = pixel.weight * trust;
    const float cosine2 = pixel.cosine * pixel.cosine;
    constexpr float kInterpolated = 4.0F / 9.0F;  // of a pixel's variance, after interpolation
    const float variance = kInterpolated * cosine2 * cosine2 / pixel.weight;
    face.weight += w;
    face.weight_squared += w * w;
    face.offset += w * distance;
    face.offset_squared += w * distance * distance;
    face.noise += w * variance;
    face.noise_squared += w * w * variance;
    face.spacing += w * pixel.depth_mm * pixel_rad / std::sqrt(pixel.cosine);
    face.normal += w * normal;
    ++face.views;
  }
};

}  // namespace

float correlation(float distance_mm, float spacing_mm) {
  const float x = distance_mm / spacing_mm;
  if (x >= 2.0F) return 0.0F;
  if (x >= 1.0F) return 0.25F * (2.0F - x) * (2.0F - x) * (2.0F - x);
  return 1.0F - 1.5F * x * x + 0.75F * x * x * x;
}

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
      const std::size_t first = crossings.blocks[block]->first_crossing.front();
      const std::size_t last = block + 1 < crossings.blocks.size()
                                   ? crossings.blocks[block + 1]->first_crossing.front()
                                   : evidence.size();
      float excess = 0.0F;  // of the scatter between views over what their noise explains
      float freedom = 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const Evidence::Face& face = evidence[i].main();
        if (face.views < 2) continue;
        const float scatter = face.offset_squared - face.offset * face.offset / face.weight;
        const float expected = face.noise - face.noise_squared / face.weight;
        excess += (scatter - expected) / face.weight;
        freedom += 1.0F - face.weight_squared / (face.weight * face.weight);
      }
      if (!(excess > 0.0F && freedom > 0.0F)) continue;
      for (std::size_t i = first; i < last; ++i) {
        const Evidence::Face& face = evidence[i].main();
        if (face.views == 0) continue;
        evidence[i].common = excess / freedom * face.weight_squared / (face.weight * face.weight);
      }
    }
  });
}

}  // namespace frangia
