#include "frangia/fusion/internal/hermite_accumulators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {
namespace {

constexpr float kAgree = 0.8F;   // cosine between normals of one face
constexpr float kBack = -0.3F;   // a normal that points so far inward is the back of a thin wall
constexpr float kAround = 4.0F;  // pixels: sight is clear when it is so this far to all sides

/// One of the points that are asked about.
struct Point {
  HermiteAccumulators& all;
  std::size_t number;
};

struct ViewSampler {
  const LocalPlanes& view;
  FastCameraModel model;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float pixel_rad;
  float near_mm;
  float free_space_mm;

  /// Some points, as the view sees them: each figure in a row of its own, for vector code.
  struct Batch {
    static constexpr std::size_t kMost = 64;
    std::array<float, kMost> x, y, z, u, v;
  };

  void project(std::span<const Eigen::Vector3f> points_mm, Batch& batch) const {
    const FastCameraModel how = model;
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

  void sample(Point at, const Eigen::Vector3f& p, float u, float v, int outward) const {
    if (!(p.z() > 0.0F)) return;
    const LocalPlanes::Quad* quad = view.quad_at(u, v);
    if (quad == nullptr) {
      const LocalPlanes::Plane* pixel = view.pixel_at(u, v);
      if (pixel != nullptr) support_at_boundary(at, p, *pixel, outward);
      return;
    }
    const float chord = (1.0F - p.z() * view.inverse_depth_at(u, v)) * quad->distance_mm;
    if (chord < -2.0F * near_mm) return;  // hidden behind what the view saw
    const bool smooth = quad->kind == LocalPlanes::Kind::Smooth;
    const LocalPlanes::Plane& plane = smooth ? view.nearest(u, v) : view.nearest_face(u, v, p);
    const float distance = smooth ? view.smooth_mm(u, v, p) : plane.in_front_mm(p);
    if (std::abs(distance) < near_mm) {
      const bool at_boundary = is_at_boundary(u, v);
      if (at_boundary && !has_surface_at(p - distance * plane.normal)) return;
      support(at, {p, plane.normal, distance, quad->weight, at_boundary}, outward);
    } else if (distance > free_space_mm && is_free_space(u, v, p)) {
      const float cosine = quad->distance_mm * view.inverse_depth_at(u, v);
      // That it sees through is as sure however well it knows what lies behind: what speaks for the
      // point may have been smoothed, what speaks against it not.
      constexpr float kSmoothed = 6.5F;
      at.all[at.number].free_space_weight += kSmoothed * quad->weight / (cosine * cosine);
    }
  }

  /// Whether the point is as far in front of all that the view saw around it: beside a silhouette a
  /// small error of the pose looks like sight through it.
  [[nodiscard]] bool is_free_space(float u, float v, const Eigen::Vector3f& point) const {
    static constexpr std::array<std::pair<int, int>, 8> kSides{
        {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    return std::all_of(kSides.begin(), kSides.end(), [&](const auto& side) {
      const float x = u + kAround * static_cast<float>(side.first);
      const float y = v + kAround * static_cast<float>(side.second);
      if (view.quad_at(x, y) == nullptr) return true;
      const auto& plane = view.planes(static_cast<int>(x), static_cast<int>(y));
      return !(plane.in_front_mm(point) < 0.5F * free_space_mm);
    });
  }

  /// Half a pixel beside the last quad, where that is not far on the surface.
  void support_at_boundary(Point at,
                           const Eigen::Vector3f& point,
                           const LocalPlanes::Plane& pixel,
                           int outward) const {
    constexpr float kBoundaryShare = 0.1F;  // of the weight: what lies further in is better known
    constexpr float kFlattest = 0.3F;
    constexpr float kFlattestOfSmall = 0.5F;  // whose slope is known worse
    const float flattest = pixel.window == WindowKind::Small ? kFlattestOfSmall : kFlattest;
    if (!(-pixel.normal.dot(point) > flattest * point.norm())) return;
    const float distance = pixel.normal.dot(point) + pixel.tangent_distance_mm;
    if (!has_surface_at(point - distance * pixel.normal)) return;
    support(at, {point, pixel.normal, distance, kBoundaryShare * pixel.weight, true}, outward);
  }

  /// Whether the view has a surface where a point would be moved to: at a rim a plane goes on where
  /// the object may not.
  [[nodiscard]] bool has_surface_at(const Eigen::Vector3f& point) const {
    float u = 0.0F;
    float v = 0.0F;
    model.project(point.x(), point.y(), point.z(), u, v);
    return view.quad_at(u, v) != nullptr || view.pixel_at(u, v) != nullptr;
  }

  [[nodiscard]] bool is_at_boundary(float u, float v) const {
    return view.quad_at(u - 1.0F, v) == nullptr || view.quad_at(u + 1.0F, v) == nullptr ||
           view.quad_at(u, v - 1.0F) == nullptr || view.quad_at(u, v + 1.0F) == nullptr;
  }

  /// The face that slopes as the view says, or a new one.
  static HermiteAccumulator::PlaneSum& plane_for(Point at, const Eigen::Vector3f& normal) {
    HermiteAccumulator::PlaneSum& first = at.all[at.number].first;
    const float along = normal.dot(first.normal);
    if (first.views == 0 ||
        (along > 0.0F && along * along >= kAgree * kAgree * first.normal.squaredNorm())) {
      return first;
    }
    const auto agreement = [&](const HermiteAccumulator::PlaneSum& face) {
      return face.views == 0 ? kAgree : normal.dot(face.normal) / face.normal.norm();
    };
    const bool is_other = agreement(at.all.secondary(at.number)) > agreement(first);
    return is_other ? at.all.make_secondary(at.number) : first;
  }

  /// What a view says about a point of the rig frame.
  struct Observation {
    const Eigen::Vector3f& point;
    const Eigen::Vector3f& normal;
    float distance_mm;
    float weight;
    bool at_boundary;  ///< a pixel beside saw nothing
  };

  void support(Point at, const Observation& observation, int outward) const {
    if (!(std::abs(observation.distance_mm) < near_mm)) return;
    const Eigen::Vector3f normal = rotation.transpose() * observation.normal;
    const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
    if (along < kBack) return;
    const float ratio = observation.distance_mm / near_mm;
    const float trust = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);  // Tukey's biweight
    const float w = observation.weight * trust;
    const float cosine = -observation.normal.dot(observation.point) / observation.point.norm();
    const float cosine2 = cosine * cosine;
    constexpr float kInterpolated = 0.73F;  // of a pixel's variance, after interpolation
    const float variance = kInterpolated * cosine2 * cosine2 / observation.weight;
    HermiteAccumulator::PlaneSum& face = plane_for(at, normal);
    face.weight += w;
    face.weight_squared += w * w;
    face.offset += w * observation.distance_mm;
    face.offset_squared += w * observation.distance_mm * observation.distance_mm;
    face.noise += w * variance;
    face.noise_squared += w * w * variance;
    // A lens is known, and light spread evenly over a pixel, to this and no better. A pixel at the
    // rim sees the part with a share from 1 to 1/2 of its square, whose middle is 0 to 1/4 off.
    constexpr float kWithin_px = 0.02F;
    constexpr float kAtBoundary_px = 0.144F;  // RMS of even odds
    const float off_px = observation.at_boundary ? kAtBoundary_px : kWithin_px;
    const float pixel_mm = observation.point.z() * pixel_rad;
    face.lateral_squared +=
        w * w * off_px * off_px * pixel_mm * pixel_mm * std::max(0.0F, 1.0F - cosine2);
    face.spacing += w * pixel_mm / std::sqrt(cosine);
    face.normal += w * normal;
    ++face.views;
  }
};

}  // namespace

const HermiteAccumulator::PlaneSum HermiteAccumulators::kNoPlane{
    0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, Eigen::Vector3f::Zero(), 0};

HermiteAccumulators::HermiteAccumulators(std::size_t count)
    : all_(count), secondary_((count + kChunk - 1) / kChunk) {
  parallel_chunks(count, 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      all_[i] = {kNoPlane, 0.0F, 0.0F, 0};
  });
}

HermiteAccumulator::PlaneSum& HermiteAccumulators::make_secondary(std::size_t i) {
  auto& together = secondary_[i / kChunk];
  std::uint32_t& other = all_[i].other;
  if (other == 0) {
    together.push_back(kNoPlane);
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

void accumulate_view(HermiteAccumulators& hermite,
                     const EdgeCrossings& crossings,
                     const LocalPlanes& view,
                     const CameraRays& camera,
                     const HermiteOptions& options) {
  const ViewSampler sampler{view,
                            FastCameraModel(camera.model),
                            view.rig_from_object.linear().cast<float>(),
                            view.rig_from_object.translation().cast<float>(),
                            static_cast<float>(1.0 / camera.model.focal_px.mean()),
                            static_cast<float>(options.near_mm),
                            static_cast<float>(options.free_space_mm)};
  parallel_chunks(
      hermite.size(), HermiteAccumulators::kChunk, [&](std::size_t begin, std::size_t end) {
        ViewSampler::Batch batch;
        for (std::size_t from = begin; from < end; from += ViewSampler::Batch::kMost) {
          const std::size_t count = std::min(ViewSampler::Batch::kMost, end - from);
          sampler.project(std::span(crossings.points_mm).subspan(from, count), batch);
          for (std::size_t i = 0; i < count; ++i) {
            sampler.sample({hermite, from + i},
                           {batch.x[i], batch.y[i], batch.z[i]},
                           batch.u[i],
                           batch.v[i],
                           crossings.outward[from + i]);
          }
        }
      });
}

void add_between_view_variance(HermiteAccumulators& hermite, const EdgeCrossings& crossings) {
  parallel_chunks(crossings.blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = crossings.first_of(block);
      const std::size_t last = crossings.first_of(block + 1);
      float excess = 0.0F;  // of the scatter between views over what their noise explains
      float freedom = 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
        if (face.views < 2) continue;
        const float scatter = face.offset_squared - face.offset * face.offset / face.weight;
        const float expected = face.noise - face.noise_squared / face.weight;
        excess += (scatter - expected) / face.weight;
        freedom += 1.0F - face.weight_squared / (face.weight * face.weight);
      }
      const float between = excess > 0.0F && freedom > 0.0F ? excess / freedom : 0.0F;
      for (std::size_t i = first; i < last; ++i) {
        const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
        if (face.views == 0) continue;
        hermite[i].common_variance = std::max(between * face.weight_squared, face.lateral_squared) /
                                     (face.weight * face.weight);
      }
    }
  });
}

}  // namespace frangia
