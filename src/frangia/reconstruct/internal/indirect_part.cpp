#include "frangia/reconstruct/internal/indirect_part.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/indirect_light/estimate_albedo.h"
#include "frangia/indirect_light/indirect_phase.h"
#include "frangia/indirect_light/lit_surface.h"
#include "frangia/indirect_light/view_light.h"
#include "frangia/range/triangulate.h"
#include "frangia/views/thin_view.h"

namespace frangia {
namespace {

constexpr double kMaterial = 0.01;  ///< share of the points that see light, of those looked at

/// Pixels on a regular grid, about `count` of those of a view that have a point.
std::vector<Eigen::Vector2i> sampled_pixels(const Image<float>& depth_mm, std::size_t count) {
  std::size_t points = 0;
  for (const float depth : depth_mm.pixels())
    points += std::isnan(depth) ? 0U : 1U;
  const int step = std::max(
      1, static_cast<int>(std::sqrt(static_cast<double>(points) / static_cast<double>(count))));
  std::vector<Eigen::Vector2i> out;
  for (int y = step / 2; y < depth_mm.height(); y += step) {
    for (int x = step / 2; x < depth_mm.width(); x += step) {
      if (!std::isnan(depth_mm(x, y))) out.emplace_back(x, y);
    }
  }
  return out;
}

/// Whether some points of a surface see other parts of it, wherever the light is.
bool sees_itself(const LitSurface& surface) {
  constexpr std::size_t kPoints = 600;
  const Mesh& mesh = surface.scene().mesh();
  const std::size_t every = mesh.triangles.size() / kPoints + 1;
  const std::size_t count = (mesh.triangles.size() + every - 1) / every;
  std::vector<char> sees(count);
  parallel_chunks(count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& corners = mesh.triangles[i * every];
      const Eigen::Vector3d a = mesh.vertices_mm[corners[0]].cast<double>();
      const Eigen::Vector3d b = mesh.vertices_mm[corners[1]].cast<double>();
      const Eigen::Vector3d c = mesh.vertices_mm[corners[2]].cast<double>();
      const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
      if (normal.allFinite()) sees[i] = surface.sees_something({(a + b + c) / 3.0, normal}) ? 1 : 0;
    }
  });
  const auto seeing = static_cast<double>(std::count(sees.begin(), sees.end(), 1));
  return seeing > kMaterial * static_cast<double>(count);
}

/// Whether a view sees indirect light, by the surface alone.
struct ViewExposure {
  std::size_t view = 0;   ///< in the store
  double indirect = 0.0;  ///< mean share of indirect light over the points
  double affected = 0.0;  ///< share of the points whose phase it may shift by more than the noise
};

/// Noise of a point as one of the phase.
double noise_rad(const RangePixel& at, const LitSurface& surface, const Eigen::Vector2d& ray) {
  const Pattern& finest = surface.patterns().back();
  const Eigen::Vector3d point = static_cast<double>(at.depth_mm) * ray.homogeneous();
  const double phase = phase_at(point, finest, surface.projector());
  const RayDepth slope = intersect_fringe(ray, phase, finest, surface.projector());
  return static_cast<double>(at.sigma_mm) /
         (std::abs(slope.mm_per_rad) * std::sqrt(1.0 + ray.squaredNorm()));
}

ViewExposure exposure_of(std::size_t index,
                         const ViewStore& views,
                         const LitSurface& surface,
                         const Image<Eigen::Vector2f>& rays) {
  constexpr std::size_t kSamples = 100;
  const View view = views.load_points(index);
  const auto pixels = sampled_pixels(view.range.depth_mm, kSamples);
  const Eigen::Isometry3d& pose = views.rig_from_object(index);
  const Eigen::Isometry3d object_from_rig = pose.inverse();
  std::vector<double> shares(pixels.size());
  std::vector<char> matters(pixels.size());
  parallel_chunks(pixels.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d ray = rays(pixels[i].x(), pixels[i].y()).cast<double>().homogeneous();
      double distance = 0.0;
      const PointLight light = surface.light_along(
          pose, object_from_rig.translation(), object_from_rig.linear() * ray, distance);
      if (!(light.direct > 0.0)) continue;
      shares[i] = std::min(1.0, light.indirect / light.direct);
      const RangePixel at = view.range.pixel(pixels[i].x(), pixels[i].y());
      const double fringes = std::abs(light.fringes.back()) / light.direct;
      matters[i] = fringes > noise_rad(at, surface, ray.head<2>()) ? 1 : 0;
    }
  });
  ViewExposure out{index};
  const auto count = static_cast<double>(std::max<std::size_t>(1, pixels.size()));
  for (const double share : shares)
    out.indirect += share / count;
  out.affected = static_cast<double>(std::count(matters.begin(), matters.end(), 1)) / count;
  return out;
}

/// Adds what the frames of a view show at about `count` pixels, with what the surface predicts
/// there.
void add_samples(const LitViews& lit,
                 std::size_t index,
                 const LitSurface& surface,
                 std::size_t count,
                 const SurfaceLight* collected,
                 std::vector<AlbedoSample>& out) {
  constexpr double kMost = 1.0;  // at grazing light the prediction is too sensitive
  if (lit.of_scan[index] >= lit.fringes.size()) return;
  const std::vector<ShownFringes>& shown = lit.fringes[lit.of_scan[index]];
  const View view = lit.views.load_points(index);
  const ViewLight light(surface, view, lit.rays, LightUse::FewPixels, collected);
  const std::size_t every = std::max<std::size_t>(1, shown.size() / count);
  const std::size_t sampled = (shown.size() + every - 1) / every;
  std::vector<AlbedoSample> samples(sampled);
  parallel_chunks(sampled, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ShownFringes& at = shown[i * every];
      const int x = at.x / lit.step_px;
      const int y = at.y / lit.step_px;
      const float depth_mm = view.range.depth_mm(x, y);
      if (!std::isnan(depth_mm))
        samples[i] = {light.at(x, y, static_cast<double>(depth_mm)), at.measured};
    }
  });
  for (AlbedoSample& sample : samples)
    if (!sample.measured.empty() && sample.predicted.mean < kMost) out.push_back(std::move(sample));
}

/// What the phase of a direction is computed from.
PhaseSource source_of(const DirectionPlan& plan) {
  return std::holds_alternative<FromSlope>(plan.orders) ? PhaseSource::Slope : PhaseSource::Finest;
}

std::size_t index_in_scan(const Scan& scan, const std::string& folder) {
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    if (scan.views[i].folder.string() == folder) return i;
  }
  return scan.views.size();
}

/// The reflectance that explains what some views show at about `count` pixels each.
AlbedoEstimate albedo_of(const LitViews& lit,
                         std::span<const ViewExposure> exposures,
                         const LitSurface& surface,
                         std::size_t count,
                         const SurfaceLight* collected,
                         const Run& run) {
  std::vector<AlbedoSample> samples;
  for (const ViewExposure& exposure : exposures) {
    run.check();
    add_samples(lit, exposure.view, surface, count, collected, samples);
  }
  return estimate_albedo(samples, surface.patterns());
}

/// A surface under the projector; null where nothing predicts light.
std::shared_ptr<const LitSurface> lit_surface(const LitViews& lit, const Mesh& surface) {
  if (lit.plan == nullptr || surface.empty()) return nullptr;
  Mesh shape;
  shape.vertices_mm = surface.vertices_mm;
  shape.triangles = surface.triangles;
  shape.normals = surface.normals;
  return std::make_shared<const LitSurface>(std::move(shape), lit.projector, lit.plan->maps);
}

/// The views that see indirect light, those first that see most; none where a few pixels of the
/// first one show none, as in most scans.
std::vector<ViewExposure> exposures_of(const LitViews& lit,
                                       const LitSurface& surface,
                                       const Run& run) {
  constexpr std::size_t kFew = 400;
  if (!sees_itself(surface)) return {};
  std::vector<ViewExposure> exposures;
  for (std::size_t i = 0; i < lit.views.size(); ++i) {
    run.check();
    exposures.push_back(exposure_of(i, lit.views, surface, lit.rays));
  }
  std::erase_if(exposures, [](const ViewExposure& one) { return one.affected < kMaterial; });
  if (exposures.empty()) return {};
  std::stable_sort(exposures.begin(), exposures.end(), [](const auto& a, const auto& b) {
    return a.indirect > b.indirect;
  });
  const bool shown =
      albedo_of(lit, std::span(exposures).first(1), surface, kFew, nullptr, run).significant;
  return shown ? exposures : std::vector<ViewExposure>();
}

}  // namespace

std::vector<Eigen::Isometry3d> poses_of(const ViewStore& views) {
  std::vector<Eigen::Isometry3d> out;
  for (std::size_t i = 0; i < views.size(); ++i)
    out.push_back(views.rig_from_object(i));
  return out;
}

int thinning_px(const MeasuredViews& measured) {
  constexpr double kPoints = 15'000.0;  // of a view: with fewer, narrow grooves would be lost
  const auto views = static_cast<double>(std::max<std::size_t>(1, measured.stations.size()));
  const double step = std::sqrt(static_cast<double>(measured.points) / views / kPoints);
  return step < 2.0 ? 1 : step < 4.0 ? 2 : 4;
}

ThinnedViews::ThinnedViews(const MeasuredViews& all,
                           std::size_t camera_number,
                           const CameraModel& model,
                           int step,
                           const Run& run)
    : measured(all),
      camera_index(camera_number),
      step_px(step),
      camera(subsample(model, step_px)),
      rays(rays_of(camera)) {
  const ViewStore& from = all.cameras.at(camera_number);
  for (std::size_t i = 0; i < from.size(); ++i) {
    run.check();
    views.add(subsample(from.load(i), step_px));
  }
}

FusionOptions ThinnedViews::coarse_fusion(double voxel_px, FusionOptions options) const {
  constexpr double kLeastVoxel_px = 1.5;  // of the thinned views
  const auto px = static_cast<double>((rays(1, 0) - rays(0, 0)).norm());
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<float> depths_mm;
    const Image<float> depth_mm = views.load_depth_mm(i);
    for (const float depth : depth_mm.pixels())
      if (!std::isnan(depth)) depths_mm.push_back(depth);
    if (depths_mm.empty()) continue;
    options.voxel_mm = std::max(voxel_px / step_px, kLeastVoxel_px) * px *
                       static_cast<double>(median(std::move(depths_mm)));
    break;
  }
  options.terms.clear();
  return options;
}

LitViews lit_views(const ThinnedViews& thinned, const LitScan& lit, const Projector& projector) {
  LitViews out{.views = thinned.views,
               .rays = thinned.rays,
               .step_px = thinned.step_px,
               .projector = projector,
               .fringes = lit.fringes.at(thinned.camera_index)};
  for (const Station& station : thinned.measured.stations)
    out.of_scan.push_back(index_in_scan(lit.scan, station.name));
  const auto& directions = lit.plan.directions;
  const auto plan =
      std::ranges::find(directions, thinned.measured.coarsest.direction, &DirectionPlan::direction);
  if (plan != directions.end() && !plan->maps.empty()) out.plan = &*plan;
  return out;
}

bool may_light_itself(const LitViews& lit, const Mesh& surface, const Run& run) {
  const auto source = lit_surface(lit, surface);
  return source != nullptr && !exposures_of(lit, *source, run).empty();
}

std::optional<IndirectPart> indirect_part(const LitViews& lit,
                                          const Mesh& surface,
                                          const Run& run) {
  constexpr std::size_t kMany = 2500;
  constexpr std::size_t kViews = 3;  // whose frames determine the reflectance
  const auto source = lit_surface(lit, surface);
  if (source == nullptr) return std::nullopt;
  const std::vector<ViewExposure> exposures = exposures_of(lit, *source, run);
  if (exposures.empty()) return std::nullopt;
  const auto collected = std::make_shared<const SurfaceLight>(source, poses_of(lit.views));
  const auto views = std::span(exposures).first(std::min(kViews, exposures.size()));
  const AlbedoEstimate found = albedo_of(lit, views, *source, kMany, collected.get(), run);
  if (!found.significant) return std::nullopt;
  return IndirectPart{.light = collected,
                      .albedo = found.albedo,
                      .source = source_of(*lit.plan),
                      .unexplained = found.unexplained,
                      .most_of_all = exposures.front().view};
}

IndirectLightReport report_of(const IndirectPart& part,
                              ShiftedPoints points,
                              const ViewStore& views,
                              const Image<Eigen::Vector2f>& rays) {
  constexpr std::size_t kSamples = 4000;
  const View view = views.load_points(part.most_of_all);
  const IndirectCorrection correction = part.correction(points);
  const ViewLight light = correction.light_of(view, rays);
  std::vector<float> added;
  std::vector<float> noise;
  double affected = 0.0;
  for (const Eigen::Vector2i& at : sampled_pixels(view.range.depth_mm, kSamples)) {
    const RangePixel pixel = view.range.pixel(at.x(), at.y());
    added.push_back(static_cast<float>(correction.sigma_mm(light, pixel)));
    noise.push_back(pixel.sigma_mm);
    affected += added.back() > 0.5F * pixel.sigma_mm ? 1.0 : 0.0;
  }
  IndirectLightReport out{.albedo = part.albedo, .corrected = points == ShiftedPoints::Moved};
  if (added.empty()) return out;
  out.affected = affected / static_cast<double>(added.size());
  const auto high = added.begin() + static_cast<std::ptrdiff_t>(19 * added.size() / 20);
  std::nth_element(added.begin(), high, added.end());
  out.largest_mm = static_cast<double>(*high);
  out.noise_mm = static_cast<double>(median(std::move(noise)));
  return out;
}

}  // namespace frangia
