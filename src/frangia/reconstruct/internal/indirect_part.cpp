#include "frangia/reconstruct/internal/indirect_part.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/core/parallel.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/indirect_light/estimate_albedo.h"
#include "frangia/indirect_light/indirect_correction.h"
#include "frangia/indirect_light/indirect_phase.h"
#include "frangia/indirect_light/lit_surface.h"
#include "frangia/indirect_light/view_light.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

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
  constexpr std::size_t kSamples = 150;
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

/// What the frames of a decoded view show at some pixels that have a point.
std::vector<ShownFringes::AtPixel> fringes_of(const DecodedView& decoded,
                                              const std::vector<Pattern>& patterns,
                                              const Image<float>& depth_mm) {
  constexpr std::size_t kSamples = 2500;
  const auto lit = std::ranges::find(
      decoded.directions, patterns.back().direction, [](const DecodedDirection& one) {
        return one.phase.pattern.direction;
      });
  if (lit == decoded.directions.end()) return {};
  std::vector<const WrappedPhase*> maps;
  for (const Pattern& pattern : patterns) {
    for (const WrappedPhase& map : lit->wrapped) {
      if (map.pattern.name == pattern.name) maps.push_back(&map);
    }
  }
  if (maps.size() != patterns.size()) return {};
  const AbsolutePhase& absolute = lit->phase;
  std::vector<ShownFringes::AtPixel> out;
  for (const Eigen::Vector2i& at : sampled_pixels(depth_mm, kSamples)) {
    const int x = at.x();
    const int y = at.y();
    if (std::isnan(absolute.phase_rad(x, y))) continue;
    ShownFringes::AtPixel sample{x, y, {}};
    for (const WrappedPhase* map : maps) {
      const float modulation = map->modulation_counts(x, y);
      if (std::isnan(map->phase_rad(x, y)) || !(modulation > 0.0F)) break;
      const double ratio = map->pattern.fringes_per_unit() / absolute.pattern.fringes_per_unit();
      sample.measured.push_back(
          {map->mean_counts(x, y) / modulation,
           1.0F / modulation,
           map->sigma_rad(x, y),
           static_cast<float>(map->phase_rad(x, y) - ratio * absolute.phase_rad(x, y))});
    }
    if (sample.measured.size() == maps.size()) out.push_back(std::move(sample));
  }
  return out;
}

/// Adds what the frames of a view show, with what the surface predicts there.
void add_samples(const std::vector<ShownFringes::AtPixel>& shown,
                 const View& view,
                 const LitSurface& surface,
                 const Image<Eigen::Vector2f>& rays,
                 std::vector<AlbedoSample>& out) {
  const ViewLight light(surface, view, rays, LightUse::FewPixels);
  for (const ShownFringes::AtPixel& at : shown) {
    const float depth_mm = view.range.depth_mm(at.x, at.y);
    if (std::isnan(depth_mm)) continue;
    AlbedoSample sample{light.at(at.x, at.y, static_cast<double>(depth_mm)), at.measured};
    constexpr double kMost = 1.0;  // at grazing light the prediction is too sensitive
    if (sample.predicted.mean < kMost) out.push_back(std::move(sample));
  }
}

/// What the phase of a direction is computed from.
PhaseSource source_of(const DirectionPlan& plan) {
  return std::holds_alternative<FromSlope>(plan.orders) ? PhaseSource::Slope : PhaseSource::Finest;
}

/// Summarizes what is added to the points of the view that sees most of it.
IndirectLightReport report_of(const View& view,
                              const LitSurface& surface,
                              const IndirectCorrection& correction,
                              double albedo,
                              const Image<Eigen::Vector2f>& rays) {
  constexpr std::size_t kSamples = 4000;
  const ViewLight light(surface, view, rays, LightUse::FewPixels);
  std::vector<float> added;
  std::vector<float> noise;
  double affected = 0.0;
  for (const Eigen::Vector2i& at : sampled_pixels(view.range.depth_mm, kSamples)) {
    const RangePixel pixel = view.range.pixel(at.x(), at.y());
    added.push_back(static_cast<float>(correction.sigma_mm(light, pixel)));
    noise.push_back(pixel.sigma_mm);
    affected += added.back() > 0.5F * pixel.sigma_mm ? 1.0 : 0.0;
  }
  IndirectLightReport out{.albedo = albedo};
  if (added.empty()) return out;
  out.affected = affected / static_cast<double>(added.size());
  const auto high = added.begin() + static_cast<std::ptrdiff_t>(19 * added.size() / 20);
  std::nth_element(added.begin(), high, added.end());
  out.largest_mm = static_cast<double>(*high);
  out.noise_mm = static_cast<double>(median(std::move(noise)));
  return out;
}

std::size_t index_in_scan(const Scan& scan, const std::string& folder) {
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    if (scan.views[i].folder.string() == folder) return i;
  }
  return scan.views.size();
}

/// Adds what the frames of some views show.
void add_views(const ScanDecoding& decoding,
               const LitViews& lit,
               std::span<const ViewExposure> exposures,
               const DirectionPlan& plan,
               const LitSurface& surface,
               ShownFringes& shown,
               const Run& run,
               std::vector<AlbedoSample>& samples) {
  for (const ViewExposure& exposure : exposures) {
    run.check();
    const std::size_t index = lit.of_scan[exposure.view];
    if (index == decoding.scan.views.size()) continue;
    const View view = lit.views.load_points(exposure.view);
    add_samples(shown.of_view(decoding, index, plan, view.range.depth_mm, run),
                view,
                surface,
                decoding.rays,
                samples);
  }
}

}  // namespace

const std::vector<ShownFringes::AtPixel>& ShownFringes::of_view(const ScanDecoding& decoding,
                                                                std::size_t index,
                                                                const DirectionPlan& plan,
                                                                const Image<float>& depth_mm,
                                                                const Run& run) {
  const auto known = views_.find(index);
  if (known != views_.end()) return known->second;
  DecodeOptions options = decoding.options;
  options.keep_maps = true;
  Run quiet = run;
  quiet.on_note = nullptr;
  quiet.on_warning = nullptr;
  const DecodedView decoded = decode_view(read_frames(decoding.scan, index, run),
                                          decoding.plan,
                                          decoding.scan.rig,
                                          decoding.rays,
                                          options_of_view(options, index),
                                          quiet);
  return views_.emplace(index, fringes_of(decoded, plan.maps, depth_mm)).first->second;
}

LitViews lit_views(const MeasuredViews& measured, const Scan& scan, std::size_t camera) {
  LitViews out{measured.cameras.at(camera), {}, measured.coarsest.direction};
  for (const Station& station : measured.stations)
    out.of_scan.push_back(index_in_scan(scan, station.name));
  return out;
}

std::optional<IndirectPart> indirect_part(const ScanDecoding& decoding,
                                          const LitViews& lit,
                                          const Mesh& surface,
                                          ShiftedPoints points,
                                          ShownFringes& shown,
                                          const Run& run) {
  constexpr double kMaterial = 0.01;   // share of the points of a view
  constexpr std::size_t kDecoded = 3;  // views whose frames determine the reflectance
  const Scan& scan = decoding.scan;
  const Image<Eigen::Vector2f>& rays = decoding.rays;
  const auto& directions = decoding.plan.directions;
  const auto plan = std::ranges::find(directions, lit.direction, &DirectionPlan::direction);
  if (plan == directions.end() || plan->maps.empty() || surface.empty()) return std::nullopt;
  Mesh shape;
  shape.vertices_mm = surface.vertices_mm;
  shape.triangles = surface.triangles;
  shape.normals = surface.normals;
  const auto source =
      std::make_shared<const LitSurface>(std::move(shape), scan.rig.projector, plan->maps);
  std::vector<ViewExposure> exposures;
  for (std::size_t i = 0; i < lit.views.size(); ++i) {
    run.check();
    exposures.push_back(exposure_of(i, lit.views, *source, rays));
  }
  std::erase_if(exposures, [](const ViewExposure& one) { return one.affected < kMaterial; });
  if (exposures.empty()) return std::nullopt;
  std::stable_sort(exposures.begin(), exposures.end(), [](const auto& a, const auto& b) {
    return a.indirect > b.indirect;
  });

  // The view that sees most of it decides whether to look further, which most parts do not need.
  std::vector<AlbedoSample> samples;
  AlbedoEstimate found;
  const std::size_t most = std::min(kDecoded, exposures.size());
  for (const auto& [begin, end] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, most}}) {
    if (begin == end) break;
    const auto views = std::span(exposures).subspan(begin, end - begin);
    add_views(decoding, lit, views, *plan, *source, shown, run, samples);
    found = estimate_albedo(samples, plan->maps);
    if (!found.significant) return std::nullopt;
  }
  const auto correction = std::make_shared<const IndirectCorrection>(
      source, found.albedo, source_of(*plan), points == ShiftedPoints::Moved, rays);
  IndirectPart out;
  out.report = report_of(
      lit.views.load_points(exposures.front().view), *source, *correction, found.albedo, rays);
  out.unexplained = found.unexplained;
  out.correct = [correction](View& view) { correction->correct(view); };
  out.largest_shifts_mm = [correction](const View& view) {
    return correction->largest_shifts_mm(view);
  };
  out.systematic_mm = [correction](const View& view) { return correction->systematic_mm(view); };
  return out;
}

}  // namespace frangia
