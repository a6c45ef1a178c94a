#include "frangia/surface/evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/surface/fast_lens.h"

namespace frangia {
namespace {

constexpr float kAgree = 0.8F;   // cosine between normals of one face
constexpr float kBack = -0.3F;   // a normal that points so far inward is the back of a thin wall
constexpr float kAround = 4.0F;  // pixels: sight is clear when it is so this far to all sides

struct Questioner {
  const LocalPlanes& view;
  FastLens lens;
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
    const float distance = smooth ? view.smooth_mm(u, v, p) : plane.in_front_mm(p);
    if (std::abs(distance) < near_mm) {
      const Eigen::Vector3f normal = rotation.transpose() * plane.normal;
      const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
      if (along < kBack) return;
      const float cosine = -plane.normal.dot(p) / p.norm();
      add(face_for(evidence, normal), normal, distance, {quad->weight, cosine, p.z()});
    } else if (distance > through_mm && is_clear(u, v, p)) {
      const float cosine = quad->distance_mm * view.inverse_depth_at(u, v);
      evidence.against += quad->weight / (cosine * cosine);
    }
  }

  /// Whether the point is as far in front of all that the view saw around it: beside a silhouette a
  /// small error of the pose looks like sight through it.
  [[nodiscard]] bool is_clear(float u, float v, const Eigen::Vector3f& point) const {
    for (const auto& [right, down] :
         {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
      const float x = u + kAround * static_cast<float>(right);
      const float y = v + kAround * static_cast<float>(down);
      const LocalPlanes::Quad* quad = view.quad_at(x, y);
      if (quad == nullptr) continue;
      const auto& plane = view.planes(static_cast<int>(x), static_cast<int>(y));
      if (plane.in_front_mm(point) < 0.5F * through_mm) return false;
    }
    return true;
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
