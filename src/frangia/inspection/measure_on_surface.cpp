#include "frangia/inspection/measure_on_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/features/filtered_range.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/verdict_clause.h"
#include "frangia/inspection/internal/continuous_walls.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Where the surface of a feature is, of which the measured shape is a part: what is dented or
/// bulges lies off the shape, and belongs to it.
class FeatureRegion {
 public:
  /// `near_mm` are the points that the shape was fitted to, or their feet on the nominal surface.
  FeatureRegion(const Shape& shape, const std::vector<Vector3d>& near_mm, double slack_mm)
      : shape_(shape), slack_mm_(slack_mm) {
    std::vector<double> offsets;
    for (const Vector3d& point : near_mm) {
      box_.extend(point);
      offsets.push_back(distance_to(shape, point).distance_mm);
    }
    if (offsets.empty()) return;
    offset_mm_ = median_in_place(std::span<double>(offsets));
    // The border of a feature was left out of its fit.
    constexpr double kBorder = 3.0;
    const Vector3d border = Vector3d::Constant(kBorder * slack_mm);
    box_.extend(Vector3d(box_.min() - border));
    box_.extend(Vector3d(box_.max() + border));
  }

  [[nodiscard]] bool holds(const Vector3d& point, const Vector3d& normal) const {
    constexpr double kAlong = 0.866;  // cosine of 30 degrees
    if (box_.isEmpty() || !box_.contains(point)) return false;
    const ShapeDistance at = distance_to(shape_, point);
    return std::abs(at.distance_mm - offset_mm_) <= slack_mm_ &&
           std::abs(at.normal.dot(normal)) >= kAlong;
  }

 private:
  const Shape& shape_;
  double slack_mm_;
  double offset_mm_ = 0.0;
  Eigen::AlignedBox3d box_;
};

/// The patches that a function chooses, with their neighbors among those.
template <typename Chooses>
SurfacePatches chosen_patches(const SurfacePatches& all, const Chooses& chooses) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(all.size(), kNone);
  SurfacePatches some;
  some.diameter_mm = all.diameter_mm;
  some.uncertainty_known = all.uncertainty_known;
  some.noise_factor = all.noise_factor;
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!chooses(i)) continue;
    number[i] = static_cast<std::uint32_t>(some.size());
    some.center_mm.push_back(all.center_mm[i]);
    some.normal.push_back(all.normal[i]);
    some.area_mm2.push_back(all.area_mm2[i]);
    some.at_edge.push_back(all.at_edge[i]);
    some.deviation_mm.push_back(all.deviation_mm[i]);
    some.noise_mm.push_back(all.noise_mm[i]);
    some.systematic_mm.push_back(all.systematic_mm[i]);
    some.missing.push_back(all.missing[i]);
    some.neighbors.push_back(all.neighbors[i]);
    some.total_area_mm2 += all.area_mm2[i];
    box.extend(all.center_mm[i]);
  }
  for (auto& neighbors : some.neighbors) {
    for (std::uint32_t& neighbor : neighbors)
      neighbor = number[neighbor];
    std::erase(neighbors, kNone);
  }
  some.size_mm = box.isEmpty() ? 0.0 : static_cast<double>(box.diagonal().norm());
  return some;
}

/// Measures one characteristic after the other.
class OnSurface {
 public:
  OnSurface(const InspectionPlan& plan, const InspectedSurface& on, const Run& run)
      : plan_(plan), on_(on), normals_(vertex_normals(*on.mesh)), run_(run) {}

  void measure(const PlannedCharacteristic& planned, MeasuredCharacteristic& row) {
    row.uncertainty_known = !on_.mesh->sigma_mm.empty();
    if (planned.kind == Characteristic::Thickness) {
      measure_thickness(planned, row);
      decide(row);
    } else {
      measure_profile(planned, row);
    }
    if (!std::isfinite(row.value))
      run_.warn(fmt::format("{}: nothing was measured well enough there; its value is missing",
                            planned.name));
  }

 private:
  void measure_profile(const PlannedCharacteristic& planned, MeasuredCharacteristic& row) {
    if (on_.deviations == nullptr || on_.reference == nullptr) {
      throw Error(
          ErrorKind::Input,
          fmt::format("\"{}\" is a {}, which needs a reference; give one, or leave it out of "
                      "the plan",
                      planned.name,
                      name_of(planned.kind)));
    }
    const SurfaceRule& used = on_.deviations->verdict.rule;
    if (!patches_) {
      patches_ = surface_patches(*on_.mesh,
                                 on_.deviations->deviations,
                                 *on_.reference,
                                 used.min_feature_mm,
                                 used.excluded,
                                 used.edge_mm.value_or(0.0),
                                 run_);
    }
    const SurfacePatches patches = patches_of(planned);
    if (!(patches.total_area_mm2 > 0.0)) return;
    SurfaceRule rule = used;
    rule.max_gap_mm = plan_.surface.max_gap_mm;  // by default a share of the size
    if (planned.limit) rule.limits = {-0.5 * *planned.limit, 0.5 * *planned.limit};
    const SurfaceVerdict verdict = judge_surface(patches, rule);
    const bool is_low = -verdict.lowest.deviation_mm > verdict.highest.deviation_mm;
    const Extreme& extreme = is_low ? verdict.lowest : verdict.highest;
    // The zone lies on both sides of the nominal surface.
    row.value = 2.0 * std::abs(extreme.deviation_mm);
    row.u95 = 2.0 * extreme.u95_mm;
    if (!planned.limit) return;
    row.conformity = verdict.conformity;
    // The value covers the measured patches only; the decision also depends on those not measured.
    if (row.conformity != Conformity::In) row.reason = sentence_of(verdict);
  }

  [[nodiscard]] SurfacePatches patches_of(const PlannedCharacteristic& planned) const {
    const SurfacePatches& all = *patches_;
    if (planned.kind == Characteristic::LineProfile) {
      const auto section =
          std::find_if(plan_.sections.begin(), plan_.sections.end(), [&](const auto& one) {
            return one.name == planned.section;
          });
      return chosen_patches(all, [&](std::size_t i) {
        const double from_plane =
            (all.center_mm[i].cast<double>() - section->point_mm).dot(section->normal);
        return std::abs(from_plane) <= 0.5 * all.diameter_mm;
      });
    }
    if (planned.feature.empty()) return all;
    const NamedFeature* feature = feature_of(planned);
    if (feature == nullptr) return {};
    std::vector<Vector3d> feet;
    for (const std::uint32_t v : feature->vertices) {
      const Vector3f& foot = on_.deviations->deviations.foot_mm[v];
      if (foot.allFinite()) feet.push_back(foot.cast<double>());
    }
    const FeatureRegion region(feature->shape, feet, all.diameter_mm);
    return chosen_patches(all, [&](std::size_t i) {
      return region.holds(all.center_mm[i].cast<double>(), all.normal[i].cast<double>());
    });
  }

  void measure_thickness(const PlannedCharacteristic& planned, MeasuredCharacteristic& row) const {
    const NamedFeature* feature = feature_of(planned);
    if (!planned.feature.empty() && feature == nullptr) return;
    const std::vector<float>& walls_mm = on_.walls->thickness_mm;
    std::vector<Vector3d> fitted;
    if (feature != nullptr)
      for (const std::uint32_t v : feature->vertices)
        fitted.push_back(on_.mesh->vertices_mm[v].cast<double>());
    std::optional<FeatureRegion> region;
    if (feature != nullptr) region.emplace(feature->shape, fitted, default_feature_mm(*on_.mesh));
    std::vector<bool> counts(walls_mm.size());
    std::vector<double> shared;
    const std::vector<float>& systematic = on_.mesh->sigma_systematic_mm;
    for (std::size_t v = 0; v < counts.size(); ++v) {
      counts[v] = std::isfinite(walls_mm[v]) &&
                  (!region || region->holds(on_.mesh->vertices_mm[v].cast<double>(),
                                            normals_[v].cast<double>()));
      if (counts[v] && !systematic.empty() && std::isfinite(systematic[v]))
        shared.push_back(static_cast<double>(systematic[v]));
    }
    const auto [low, high] = ends_of(inspection::continuous_walls(*on_.mesh, *on_.walls, counts));
    if (!std::isfinite(low.value)) return;
    const bool is_low =
        !planned.nominal || *planned.nominal - low.value > high.value - *planned.nominal;
    const WallEnd& end = is_low ? low : high;
    row.value = end.value;
    if (!row.uncertainty_known) return;
    // Both ends of the range are alike and independent: one has the root of a half of its interval.
    // What is alike in both walls adds up.
    const double both_mm = shared.empty() ? 0.0 : 2.0 * median_in_place(std::span<double>(shared));
    row.u95 = std::hypot(std::sqrt(0.5) * end.u95, kNormal95 * both_mm);
  }

  /// One end of the range of thicknesses, and the uncertainty of the wall that has it.
  struct WallEnd {
    double value = kMissing;
    double u95 = kMissing;  ///< of the range of that wall
  };

  /// The least and the largest thickness of several walls, each without its noise; missing without
  /// walls. A wall of few points counts only where there is no other.
  [[nodiscard]] std::pair<WallEnd, WallEnd> ends_of(
      const std::vector<std::vector<std::uint32_t>>& walls) const {
    constexpr std::size_t kFewest = 12;  // a linear function leaves eight of their errors
    std::size_t largest = 0;
    for (const auto& wall : walls)
      largest = std::max(largest, wall.size());
    WallEnd low;
    WallEnd high;
    for (const auto& wall : walls) {
      if (wall.size() < std::min(kFewest, largest)) continue;
      std::vector<SurfaceValue> values;
      for (const std::uint32_t v : wall)
        values.push_back({on_.mesh->vertices_mm[v].cast<double>(),
                          static_cast<double>(on_.walls->thickness_mm[v])});
      const FilteredRange range = filtered_range(std::move(values));
      if (!(range.low >= low.value)) low = {range.low, range.u95};
      if (!(range.high <= high.value)) high = {range.high, range.u95};
    }
    return {low, high};
  }

  /// The feature that was found; null: none, or one whose vertices are not those of the mesh.
  [[nodiscard]] const NamedFeature* feature_of(const PlannedCharacteristic& planned) const {
    if (planned.feature.empty()) return nullptr;
    const auto found =
        std::find_if(on_.features->begin(), on_.features->end(), [&](const NamedFeature& one) {
          return one.name == planned.feature;
        });
    if (found == on_.features->end()) return nullptr;  // of which `run` was warned
    if (!found->vertices.empty()) return &*found;
    run_.warn(
        fmt::format("{}: the vertices of the mesh do not cover {}; inspect the mesh before it "
                    "is decimated",
                    planned.name,
                    planned.feature));
    return nullptr;
  }

  const InspectionPlan& plan_;
  const InspectedSurface& on_;
  std::vector<Vector3f> normals_;
  std::optional<SurfacePatches> patches_;  ///< of the whole surface, once they are needed
  const Run& run_;
};

}  // namespace

bool needs_walls(const InspectionPlan& plan) {
  return plan.thickness ||
         std::any_of(plan.characteristics.begin(), plan.characteristics.end(), [](const auto& one) {
           return one.kind == Characteristic::Thickness;
         });
}

void measure_on_surface(const InspectionPlan& plan,
                        const InspectedSurface& surface,
                        std::vector<MeasuredCharacteristic>& rows,
                        const Run& run) {
  std::optional<OnSurface> on;
  for (const PlannedCharacteristic& planned : plan.characteristics) {
    if (!is_of_surface(planned.kind)) continue;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& one) {
      return one.name == planned.name && one.kind == planned.kind;
    });
    if (row == rows.end()) continue;
    if (!on) on.emplace(plan, surface, run);
    on->measure(planned, *row);
  }
}

}  // namespace frangia
