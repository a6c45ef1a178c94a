#include "frangia/surface/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/views/fast_lens.h"

namespace frangia {
namespace {

constexpr float kAgree = 0.8F;   // cosine between normals of one face
constexpr float kBack = -0.3F;   // a normal that points so far inward is the back of a thin wall
constexpr float kAround = 4.0F;  // pixels: sight is clear when it is so this far to all sides

/// One of the points that are asked about.
struct Point {
  Evidences& all;
  std::size_t number;
};

struct Questioner {
  const LocalPlanes& view;
  FastLens lens;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float pixel_rad;
  float near_mm;
  float through_mm;

  /// Some points, as the view sees them: each figure in a row of its own, for vector code.
  struct Batch {
    static constexpr std::size_t kMost = 64;
    std::array<float, kMost> x, y, z, u, v;
  };

  void project(std::span<const Eigen::Vector3f> points_mm, Batch& batch) const {
    const FastLens how = lens;
    const Eigen::Matrix3f r = rotation;
    const Eigen::Vector3f t = translation;
    const float* point = points_mm.front().data();
    const auto count = static_cast<std::ptrdiff_t>(points_mm.size());
    Batch& to = batch;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const float x = point[3 * i];
      const float y = point[3 * i + 1];
      const float z = point[3 * i + 2];
      to.x[k] = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + t.x();
      to.y[k] = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + t.y();
      to.z[k] = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + t.z();
      how.project(to.x[k], to.y[k], to.z[k], to.u[k], to.v[k]);
    }
  }

  void ask(Point at, const Eigen::Vector3f& p, float u, float v, int outward) const {
    if (!(p.z() > 0.0F)) return;
    const LocalPlanes::Quad* quad = view.quad_at(u, v);
    if (quad == nullptr) {
      const LocalPlanes::Plane* pixel = view.pixel_at(u, v);
      if (pixel != nullptr) support_beside(at, p, *pixel, outward);
      return;
    }
    const float chord = (1.0F - p.z() * view.inverse_depth_at(u, v)) * quad->distance_mm;
    if (chord < -2.0F * near_mm) return;  // hidden behind what the view saw
    const bool smooth = quad->kind == LocalPlanes::Kind::Smooth;
    const LocalPlanes::Plane& plane = smooth ? view.nearest(u, v) : view.nearest_face(u, v, p);
    const float distance = smooth ? view.smooth_mm(u, v, p) : plane.in_front_mm(p);
    if (std::abs(distance) < near_mm) {
      const bool at_rim = is_at_rim(u, v);
      if (at_rim && !sees(p - distance * plane.normal)) return;
      support(at, {p, plane.normal, distance, quad->weight, at_rim}, outward);
    } else if (distance > through_mm && is_clear(u, v, p)) {
      const float cosine = quad->distance_mm * view.inverse_depth_at(u, v);
      // That it sees through is as sure however well it knows what lies behind: what speaks for the
      // point may have been smoothed, what speaks against it not.
      constexpr float kSmoothed = 6.5F;
      at.all[at.number].against += kSmoothed * quad->weight / (cosine * cosine);
    }
  }

  /// Whether the point is as far in front of all that the view saw around it: beside a silhouette a
  /// small error of the pose looks like sight through it.
  [[nodiscard]] bool is_clear(float u, float v, const Eigen::Vector3f& point) const {
    static constexpr std::array<std::pair<int, int>, 8> kSides{
        {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    return std::all_of(kSides.begin(), kSides.end(), [&](const auto& side) {
      const float x = u + kAround * static_cast<float>(side.first);
      const float y = v + kAround * static_cast<float>(side.second);
      if (view.quad_at(x, y) == nullptr) return true;
      const auto& plane = view.planes(static_cast<int>(x), static_cast<int>(y));
      return !(plane.in_front_mm(point) < 0.5F * through_mm);
    });
  }

  /// Half a pixel beside the last quad, where that is not far on the surface.
  void support_beside(Point at,
                      const Eigen::Vector3f& point,
                      const LocalPlanes::Plane& pixel,
                      int outward) const {
    constexpr float kRim = 0.1F;  // of the weight: what lies further in is better known
    constexpr float kFlattest = 0.3F;
    constexpr float kFlattestOfSmall = 0.5F;  // whose slope is known worse
    const float flattest = pixel.window == WindowKind::Small ? kFlattestOfSmall : kFlattest;
    if (!(-pixel.normal.dot(point) > flattest * point.norm())) return;
    const float distance = pixel.normal.dot(point) + pixel.through_mm;
    if (!sees(point - distance * pixel.normal)) return;
    support(at, {point, pixel.normal, distance, kRim * pixel.weight, true}, outward);
  }

  /// Whether the view has a surface where a point would be moved to: at a rim a plane goes on where
  /// the object may not.
  [[nodiscard]] bool sees(const Eigen::Vector3f& point) const {
    float u = 0.0F;
    float v = 0.0F;
    lens.project(point.x(), point.y(), point.z(), u, v);
    return view.quad_at(u, v) != nullptr || view.pixel_at(u, v) != nullptr;
  }

  [[nodiscard]] bool is_at_rim(float u, float v) const {
    return view.quad_at(u - 1.0F, v) == nullptr || view.quad_at(u + 1.0F, v) == nullptr ||
           view.quad_at(u, v - 1.0F) == nullptr || view.quad_at(u, v + 1.0F) == nullptr;
  }

  /// The face that slopes as the view says, or a new one.
  static Evidence::Face& face_for(Point at, const Eigen::Vector3f& normal) {
    Evidence::Face& first = at.all[at.number].first;
    const float along = normal.dot(first.normal);
    if (first.views == 0 ||
        (along > 0.0F && along * along >= kAgree * kAgree * first.normal.squaredNorm())) {
      return first;
    }
    const auto agreement = [&](const Evidence::Face& face) {
      return face.views == 0 ? kAgree : normal.dot(face.normal) / face.normal.norm();
    };
    const bool is_other = agreement(at.all.other(at.number)) > agreement(first);
    return is_other ? at.all.make_other(at.number) : first;
  }

  /// What a view says about a point of the rig frame.
  struct Word {
    const Eigen::Vector3f& point;
    const Eigen::Vector3f& normal;
    float distance_mm;
    float weight;
    bool at_rim;  ///< a pixel beside saw nothing
  };

  void support(Point at, const Word& word, int outward) const {
    if (!(std::abs(word.distance_mm) < near_mm)) return;
    const Eigen::Vector3f normal = rotation.transpose() * word.normal;
    const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
    if (along < kBack) return;
    const float ratio = word.distance_mm / near_mm;
    const float trust = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);  // Tukey's biweight
    const float w = word.weight * trust;
    const float cosine = -word.normal.dot(word.point) / word.point.norm();
    const float cosine2 = cosine * cosine;
    constexpr float kInterpolated = 0.73F;  // of a pixel's variance, after interpolation
    const float variance = kInterpolated * cosine2 * cosine2 / word.weight;
    Evidence::Face& face = face_for(at, normal);
    face.weight += w;
    face.weight_squared += w * w;
    face.offset += w * word.distance_mm;
    face.offset_squared += w * word.distance_mm * word.distance_mm;
    face.noise += w * variance;
    face.noise_squared += w * w * variance;
    // A lens is known, and light spread evenly over a pixel, to this and no better. A pixel at the
    // rim sees the part with a share from 1 to 1/2 of its square, whose middle is 0 to 1/4 off.
    constexpr float kWithin_px = 0.02F;
    constexpr float kAtRim_px = 0.144F;  // RMS of even odds
    const float off_px = word.at_rim ? kAtRim_px : kWithin_px;
    const float pixel_mm = word.point.z() * pixel_rad;
    face.lateral_squared +=
        w * w * off_px * off_px * pixel_mm * pixel_mm * std::max(0.0F, 1.0F - cosine2);
    face.spacing += w * pixel_mm / std::sqrt(cosine);
    face.normal += w * normal;
    ++face.views;
  }
};

}  // namespace

const Evidence::Face Evidences::kNoFace{
    0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, Eigen::Vector3f::Zero(), 0};

Evidences::Evidences(std::size_t count)
    : all_(count), others_((count + kTogether - 1) / kTogether) {
  parallel_chunks(count, 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      all_[i] = {kNoFace, 0.0F, 0.0F, 0};
  });
}

Evidence::Face& Evidences::make_other(std::size_t i) {
  auto& together = others_[i / kTogether];
  std::uint32_t& other = all_[i].other;
  if (other == 0) {
    together.push_back(kNoFace);
    other = static_cast<std::uint32_t>(together.size());
  }
  return together[other - 1];
}

float correlation(float distance_mm, float spacing_mm) {
  constexpr float kWide = 1.6F;  // pixels: the best paraboloid of 5 x 5 spreads as far as that
  const float x = distance_mm / (kWide * spacing_mm);
  if (x >= 2.0F) return 0.0F;
  if (x >= 1.0F) return 0.25F * (2.0F - x) * (2.0F - x) * (2.0F - x);
  return 1.0F - 1.5F * x * x + 0.75F * x * x * x;
}

void add_evidence(Evidences& evidence,
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
  parallel_chunks(evidence.size(), Evidences::kTogether, [&](std::size_t begin, std::size_t end) {
    Questioner::Batch batch;
    for (std::size_t from = begin; from < end; from += Questioner::Batch::kMost) {
      const std::size_t count = std::min(Questioner::Batch::kMost, end - from);
      questioner.project(std::span(crossings.points_mm).subspan(from, count), batch);
      for (std::size_t i = 0; i < count; ++i) {
        questioner.ask({evidence, from + i},
                       {batch.x[i], batch.y[i], batch.z[i]},
                       batch.u[i],
                       batch.v[i],
                       crossings.outward[from + i]);
      }
    }
  });
}

void add_disagreement(Evidences& evidence, const Crossings& crossings) {
  parallel_chunks(crossings.blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = crossings.first_of(block);
      const std::size_t last = crossings.first_of(block + 1);
      float excess = 0.0F;  // of the scatter between views over what their noise explains
      float freedom = 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const Evidence::Face& face = evidence.main(i);
        if (face.views < 2) continue;
        const float scatter = face.offset_squared - face.offset * face.offset / face.weight;
        const float expected = face.noise - face.noise_squared / face.weight;
        excess += (scatter - expected) / face.weight;
        freedom += 1.0F - face.weight_squared / (face.weight * face.weight);
      }
      const float between = excess > 0.0F && freedom > 0.0F ? excess / freedom : 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const Evidence::Face& face = evidence.main(i);
        if (face.views == 0) continue;
        evidence[i].common = std::max(between * face.weight_squared, face.lateral_squared) /
                             (face.weight * face.weight);
      }
    }
  });
}

}  // namespace frangia
