#include "frangia/fusion/internal/accumulate_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/rig/camera_model.h"

namespace frangia {
namespace {

/// `HermiteOptions` as floats, with cosines in place of angles.
struct SamplerSettings {
  explicit SamplerSettings(const HermiteOptions& options)
      : near_mm(static_cast<float>(options.near_mm)),
        free_space_mm(static_cast<float>(options.free_space_mm)),
        same_face(cosine(options.parameters.same_face_rad)),
        back_face(cosine(options.parameters.back_face_rad)),
        hidden_mm(static_cast<float>(options.parameters.hidden_bands * options.near_mm)),
        clear_sight_px(static_cast<float>(options.parameters.clear_sight_px)),
        clear_sight_mm(
            static_cast<float>(options.parameters.clear_sight_share * options.free_space_mm)),
        free_space_factor(static_cast<float>(options.parameters.free_space_factor)),
        boundary_share(static_cast<float>(options.parameters.boundary_share)),
        boundary_incidence(cosine(options.parameters.boundary_incidence_rad)),
        small_window_incidence(cosine(options.parameters.small_window_incidence_rad)),
        interpolated_variance(static_cast<float>(options.parameters.interpolated_variance)),
        lateral_px(static_cast<float>(options.parameters.lateral_px)),
        boundary_lateral_px(static_cast<float>(options.parameters.boundary_lateral_px)),
        step_lateral_px(static_cast<float>(options.parameters.step_lateral_px)) {}

  static float cosine(double angle_rad) { return static_cast<float>(std::cos(angle_rad)); }

  float near_mm;
  float free_space_mm;
  float same_face;
  float back_face;
  float hidden_mm;
  float clear_sight_px;
  float clear_sight_mm;
  float free_space_factor;
  float boundary_share;
  float boundary_incidence;
  float small_window_incidence;
  float interpolated_variance;
  float lateral_px;
  float boundary_lateral_px;
  float step_lateral_px;
};

/// The accumulator of one crossing.
struct AccumulatorRef {
  HermiteAccumulators& all;
  std::size_t number;
};

struct ViewSampler {
  const LocalPlanes& view;
  FastCameraModel model;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float pixel_rad;
  SamplerSettings set;
  SystematicImages systematic;
  std::size_t number;

  /// Points in camera coordinates and in the image, one array for each coordinate, for vector code.
  struct Batch {
    static constexpr std::size_t kMost = 64;
    std::array<float, kMost> x, y, z, u, v;
  };

  void project(std::span<const Eigen::Vector3f> points_mm, Batch& batch) const {
    model.lens.extended ? project_by<true>(points_mm, batch) : project_by<false>(points_mm, batch);
  }

  /// `kExtended` is that of the camera.
  template <bool kExtended>
  void project_by(std::span<const Eigen::Vector3f> points_mm, Batch& batch) const {
    const FastCameraModel camera = model;
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
      camera.project<kExtended>(to.x[k], to.y[k], to.z[k], to.u[k], to.v[k]);
    }
  }

  void sample(AccumulatorRef at, const Eigen::Vector3f& p, float u, float v, int outward) const {
    if (!(p.z() > 0.0F)) return;
    const LocalPlanes::Quad* quad = view.quad_at(u, v);
    if (quad == nullptr) {
      const LocalPlanes::Plane* pixel = view.pixel_at(u, v);
      if (pixel != nullptr) support_at_boundary(at, p, *pixel, systematic_at(u, v), outward);
      return;
    }
    const float chord = (1.0F - p.z() * view.inverse_depth_at(u, v)) * quad->distance_mm;
    if (chord < -set.hidden_mm) return;
    const bool smooth = quad->kind == LocalPlanes::Kind::Smooth;
    const LocalPlanes::Plane& plane = smooth ? view.nearest(u, v) : view.nearest_face(u, v, p);
    const float distance = smooth ? view.smooth_mm(u, v, p) : plane.in_front_mm(p);
    if (std::abs(distance) < set.near_mm) {
      const bool at_boundary = is_at_boundary(u, v);
      if (at_boundary && !has_surface_at(p - distance * plane.normal)) return;
      support(at,
              {p,
               plane.normal,
               distance,
               quad->weight,
               off_px(plane, p, at_boundary),
               systematic_at(u, v)},
              outward);
    } else if (distance > set.free_space_mm && is_free_space(u, v, p)) {
      const float cosine = quad->distance_mm * view.inverse_depth_at(u, v);
      at.all[at.number].free_space_weight +=
          set.free_space_factor * quad->weight / (cosine * cosine);
    }
  }

  /// Both systematic parts of a pixel.
  struct Systematic {
    float common_mm = 0.0F;
    float differing_mm = 0.0F;
  };

  /// The systematic parts of the nearest pixel; 0 where none is known.
  [[nodiscard]] Systematic systematic_at(float u, float v) const {
    if (systematic.all_mm.empty()) return {};
    const int x = static_cast<int>(u + 0.5F);
    const int y = static_cast<int>(v + 0.5F);
    const float all = systematic.all_mm(x, y);
    if (std::isnan(all)) return {};
    if (systematic.differing_mm.empty()) return {all, 0.0F};
    const float differing = systematic.differing_mm(x, y);
    return {std::sqrt(std::max(0.0F, all * all - differing * differing)), differing};
  }

  /// Whether the surface all around the pixel lies far behind the point.
  [[nodiscard]] bool is_free_space(float u, float v, const Eigen::Vector3f& point) const {
    static constexpr std::array<std::pair<int, int>, 8> kSides{
        {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    return std::all_of(kSides.begin(), kSides.end(), [&](const auto& side) {
      const float x = u + set.clear_sight_px * static_cast<float>(side.first);
      const float y = v + set.clear_sight_px * static_cast<float>(side.second);
      if (view.quad_at(x, y) == nullptr) return true;
      const auto& plane = view.planes(static_cast<int>(x), static_cast<int>(y));
      return !(plane.in_front_mm(point) < set.clear_sight_mm);
    });
  }

  /// Adds a point that projects up to half a pixel beyond the last quad, onto the pixel's plane.
  void support_at_boundary(AccumulatorRef at,
                           const Eigen::Vector3f& point,
                           const LocalPlanes::Plane& pixel,
                           const Systematic& parts,
                           int outward) const {
    const float incidence =
        pixel.window == WindowKind::Small ? set.small_window_incidence : set.boundary_incidence;
    if (!(-pixel.normal.dot(point) > incidence * point.norm())) return;
    const float distance = pixel.normal.dot(point) + pixel.tangent_distance_mm;
    if (!has_surface_at(point - distance * pixel.normal)) return;
    support(at,
            {point,
             pixel.normal,
             distance,
             set.boundary_share * pixel.weight,
             off_px(pixel, point, true),
             parts},
            outward);
  }

  /// Whether the view has a surface at a point that was projected onto a plane: at the boundary the
  /// plane may extend beyond the object.
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

  /// RMS error of the position of a plane in the image, near a point in front of it. `at_boundary`:
  /// a neighbouring quad has no surface.
  [[nodiscard]] float off_px(const LocalPlanes::Plane& plane,
                             const Eigen::Vector3f& point,
                             bool at_boundary) const {
    const bool may_be_step = plane.window == WindowKind::Small &&
                             -plane.normal.dot(point) < set.small_window_incidence * point.norm();
    if (may_be_step) return set.step_lateral_px;
    return at_boundary ? set.boundary_lateral_px : set.lateral_px;
  }

  /// Returns the face whose normal agrees, or a new second face.
  [[nodiscard]] HermiteAccumulator::PlaneSum& plane_for(AccumulatorRef at,
                                                        const Eigen::Vector3f& normal) const {
    HermiteAccumulator::PlaneSum& first = at.all[at.number].first;
    const float along = normal.dot(first.normal);
    if (first.views == 0 || (along > 0.0F && along * along >= set.same_face * set.same_face *
                                                                  first.normal.squaredNorm())) {
      return first;
    }
    const auto agreement = [&](const HermiteAccumulator::PlaneSum& face) {
      return face.views == 0 ? set.same_face : normal.dot(face.normal) / face.normal.norm();
    };
    const bool is_second = agreement(at.all.secondary(at.number)) > agreement(first);
    return is_second ? at.all.make_secondary(at.number) : first;
  }

  /// The surface of a view near a crossing, in the rig frame.
  struct Observation {
    const Eigen::Vector3f& point;
    const Eigen::Vector3f& normal;
    float distance_mm;
    float weight;
    float off_px;           ///< RMS error of its position in the image
    Systematic systematic;  ///< of the pixel, along its ray
  };

  void support(AccumulatorRef at, const Observation& observation, int outward) const {
    if (!(std::abs(observation.distance_mm) < set.near_mm)) return;
    const Eigen::Vector3f normal = rotation.transpose() * observation.normal;
    const float along = outward > 0 ? normal[outward - 1] : -normal[-outward - 1];
    if (along < set.back_face) return;
    const float ratio = observation.distance_mm / set.near_mm;
    const float trust = (1.0F - ratio * ratio) * (1.0F - ratio * ratio);  // Tukey's biweight
    const float w = observation.weight * trust;
    const float cosine = -observation.normal.dot(observation.point) / observation.point.norm();
    const float cosine2 = cosine * cosine;
    const float variance = set.interpolated_variance * cosine2 * cosine2 / observation.weight;
    HermiteAccumulator::PlaneSum& face = plane_for(at, normal);
    face.weight += w;
    face.weight_squared += w * w;
    face.offset += w * observation.distance_mm;
    face.offset_squared += w * observation.distance_mm * observation.distance_mm;
    face.noise += w * variance;
    face.noise_squared += w * w * variance;
    const float pixel_mm = observation.point.z() * pixel_rad;
    face.lateral_squared += w * w * observation.off_px * observation.off_px * pixel_mm * pixel_mm *
                            std::max(0.0F, 1.0F - cosine2);
    face.spacing += w * pixel_mm / std::sqrt(cosine);
    face.normal += w * normal;
    ++face.views;
    const bool first = &face == &at.all[at.number].first;
    at.all.note_weight(at.number, first, number, w);
    if (!at.all.has_systematic()) return;
    HermiteAccumulators::SystematicSums& sums = at.all.systematic_sums(at.number);
    HermiteAccumulators::SystematicSum& sum = first ? sums.first : sums.second;
    sum.common += w * cosine * observation.systematic.common_mm;
    const float differing = w * cosine * observation.systematic.differing_mm;
    sum.differing_squared += differing * differing;
  }
};

}  // namespace

void accumulate_view(HermiteAccumulators& hermite,
                     const EdgeCrossings& crossings,
                     const LocalPlanes& view,
                     const CameraRays& camera,
                     const HermiteOptions& options,
                     const SystematicImages& systematic,
                     std::size_t number) {
  const ViewSampler sampler{view,
                            FastCameraModel(camera.model),
                            view.rig_from_object.linear().cast<float>(),
                            view.rig_from_object.translation().cast<float>(),
                            static_cast<float>(1.0 / camera.model.focal_px.mean()),
                            SamplerSettings(options),
                            systematic,
                            number};
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

}  // namespace frangia
