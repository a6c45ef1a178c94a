#include "frangia/indirect_light/indirect_correction.h"

#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/range/triangulate.h"

namespace frangia {

namespace {

/// Whether a pixel is inside of the data: at most one of the eight pixels around it has no point.
bool is_inside(const Image<float>& depth_mm, int x, int y) {
  constexpr int kLeast = 7;
  int count = -1;  // itself
  for (int v = std::max(0, y - 1); v <= std::min(depth_mm.height() - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(depth_mm.width() - 1, x + 1); ++u)
      count += std::isnan(depth_mm(u, v)) ? 0 : 1;
  }
  return count >= kLeast;
}

}  // namespace

void IndirectCorrection::correct(View& view, const Image<Eigen::Vector2f>& rays) const {
  if (!moves_points_ || view.range.phase_rad.empty()) return;
  const ViewLight light(collected_->surface(), view, rays, LightUse::Correction, collected_.get());
  const Image<float> before_mm = view.range.depth_mm;
  parallel_rows(before_mm.height(), [&](int y) {
    for (int x = 0; x < before_mm.width(); ++x) {
      RangePixel at = view.range.pixel(x, y);
      if (std::isnan(at.depth_mm)) continue;
      const bool keeps = is_inside(before_mm, x, y) || !is_lit_indirectly(light, at);
      if (keeps && move(light, at)) {
        view.range.depth_mm(x, y) = at.depth_mm;
      } else {
        view.range.remove(x, y);
      }
    }
  });
  std::erase_if(view.edge_pixels, [&](RangePixel& pixel) {
    return is_lit_indirectly(light, pixel) || !move(light, pixel);
  });
}

/// Whether indirect light shifts a point by much. At the rim of a gap that indirect light leaves in
/// the data, as at a crease, the frames of a pixel just pass their checks, and its point lies
/// anywhere: at the crease of a groove such points were 0.3 mm off, of a noise of 0.03 mm.
bool IndirectCorrection::is_lit_indirectly(const ViewLight& light, const RangePixel& at) const {
  constexpr double kMatters_rad = 0.05;  // the noise of fine fringes is far below
  const IndirectShare share = light.near(at.x, at.y, static_cast<double>(at.depth_mm));
  return albedo_ * std::abs(share.fringes.back()) > kMatters_rad;
}

Image<float> IndirectCorrection::systematic_mm(const View& view,
                                               const Image<Eigen::Vector2f>& rays) const {
  const ViewLight light(collected_->surface(), view, rays, LightUse::Uncertainty, collected_.get());
  const Image<float>& depth_mm = view.range.depth_mm;
  Image<float> out(depth_mm.width(), depth_mm.height(), kMissing);
  parallel_rows(depth_mm.height(), [&](int y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      const RangePixel at = view.range.pixel(x, y);
      if (!std::isnan(at.depth_mm)) out(x, y) = static_cast<float>(sigma_mm(light, at));
    }
  });
  return out;
}

Image<float> IndirectCorrection::largest_shifts_mm(const View& view,
                                                   const Image<Eigen::Vector2f>& rays) const {
  constexpr double kMatters = 2.0;  // sigma of noise
  const ViewLight light(collected_->surface(), view, rays, LightUse::Uncertainty, collected_.get());
  const Image<float>& depth_mm = view.range.depth_mm;
  Image<float> out(depth_mm.width(), depth_mm.height(), kMissing);
  std::vector<float> sigmas_mm;
  for (const float sigma : view.range.sigma_mm.pixels())
    if (!std::isnan(sigma)) sigmas_mm.push_back(sigma);
  if (sigmas_mm.empty()) return out;
  // Indirect light lowers the contrast, too: noise at its place says little.
  const auto typical_mm = static_cast<double>(median_in_place(std::span(sigmas_mm)));
  parallel_rows(depth_mm.height(), [&](int y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      const RangePixel at = view.range.pixel(x, y);
      if (std::isnan(at.depth_mm)) continue;
      if (sigma_mm(light, at) < kMatters * std::min(typical_mm, static_cast<double>(at.sigma_mm))) {
        out(x, y) = 0.0F;
        continue;
      }
      constexpr double kMost_rad = 2.0;  // the indirect fringes may be the stronger ones
      out(x, y) = static_cast<float>(kMost_rad * ray_mm_per_rad(light, at));
    }
  });
  return out;
}

/// Change of a point along its ray with the phase.
double IndirectCorrection::ray_mm_per_rad(const ViewLight& light, const RangePixel& at) const {
  const Eigen::Vector2d ray = light.rays()(at.x, at.y).cast<double>();
  const Pattern& finest = patterns().back();
  const double phase = phase_at(static_cast<double>(at.depth_mm) * ray.homogeneous(),
                                finest,
                                collected_->surface().projector());
  const RayDepth slope = intersect_fringe(ray, phase, finest, collected_->surface().projector());
  return std::abs(slope.mm_per_rad) * std::sqrt(1.0 + ray.squaredNorm());
}

double IndirectCorrection::sigma_mm(const ViewLight& light, const RangePixel& at) const {
  const auto depth = static_cast<double>(at.depth_mm);
  const IndirectShare share = light.at(at.x, at.y, depth);
  if (share.mean + share.unknown <= 0.0) return 0.0;
  const IndirectPhase found = indirect_phase(share, albedo_, patterns(), source_);
  const double sigma_rad =
      moves_points_ ? found.sigma_rad : std::hypot(found.sigma_rad, found.error_rad);
  const double mm = ray_mm_per_rad(light, at) * sigma_rad;
  return std::isfinite(mm) ? mm : 0.0;
}

/// Sets the depth that the phase without its predicted error has; false for a wrong order.
bool IndirectCorrection::move(const ViewLight& light, RangePixel& at) const {
  IndirectShare share = light.at(at.x, at.y, static_cast<double>(at.depth_mm));
  if (share.mean <= 0.0 || std::isnan(at.phase_rad)) return true;
  const Pattern& finest = patterns().back();
  const Eigen::Vector2d ray = light.rays()(at.x, at.y).cast<double>();
  const double phase = phase_at(static_cast<double>(at.depth_mm) * ray.homogeneous(),
                                finest,
                                collected_->surface().projector());
  const SolvedPhase solved =
      direct_phase(share, phase, static_cast<double>(at.phase_rad), albedo_, patterns(), source_);
  if (solved.wrong_order) return false;
  const RayDepth moved =
      intersect_fringe(ray, solved.phase_rad, finest, collected_->surface().projector());
  if (!std::isnan(moved.depth_mm)) at.depth_mm = static_cast<float>(moved.depth_mm);
  return true;
}

std::string IndirectLightReport::text() const {
  const std::string found = fmt::format(
      "indirect light: the part lights its own concave sides (reflectance {:.2f}); {} {:.4f} mm "
      "{} in sigma, more than half of the noise at {:.0f} % of the points",
      albedo,
      corrected ? "the depth is corrected by what the surface predicts, and up to"
                : "the depth is not corrected, and up to",
      largest_mm,
      corrected ? "remain" : "are counted",
      100.0 * affected);
  if (!is_large()) return found;
  return found + "; project only fine fringes, as a plan for indirect light proposes";
}

void announce(const IndirectLightReport& report, const Run& run) {
  if (report.is_large()) {
    run.warn(report.text());
  } else {
    run.note(report.text());
  }
}

}  // namespace frangia
