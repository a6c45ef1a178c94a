#include "frangia/scan_plan/plan_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/fringe_sequence.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// What can be added to a recipe, the cheapest first among those for a need.
enum class Remedy : std::uint8_t {
  TurnOver,
  LayDown,
  FinerFringes,
  LongerExposure,
  Shifts,
  Stations
};

std::vector<Remedy> remedies_for(ScanNeed need) {
  switch (need) {
    case ScanNeed::Coverage:
      return {Remedy::TurnOver, Remedy::LayDown, Remedy::Stations};
    case ScanNeed::Noise:
      return {Remedy::FinerFringes,
              Remedy::LongerExposure,
              Remedy::Shifts,
              Remedy::Stations,
              Remedy::TurnOver,
              Remedy::LayDown};
    case ScanNeed::Nothing:
    case ScanNeed::Calibration:
      break;
  }
  return {};
}

/// Periods of a sequence whose finest fringes are half as wide; empty: they would be too fine.
std::vector<double> finer_periods(const ScanRecipe& recipe, const Rig& rig) {
  constexpr double kLeast_px = 8.0;   // finer ones lose contrast in lenses of projectors
  constexpr double kSigma_rad = 0.1;  // of a map, for the orders
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  if (projector == nullptr) return {};
  double finest_px = projector->width_px;
  for (const Pattern& pattern : recipe.patterns(rig))
    if (pattern.kind == PatternKind::Fringe) finest_px = std::min(finest_px, pattern.period_px);
  if (0.5 * finest_px < kLeast_px) return {};
  std::vector<double> periods;
  const double field_px = projector->width_px;
  for (const double fringes : plan_sequence(field_px / (0.5 * finest_px), kSigma_rad).fringes)
    periods.push_back(field_px / fringes);
  return periods;
}

bool has_tilt(const ScanRecipe& recipe, double tilt_rad) {
  return std::any_of(recipe.tilts_rad.begin(), recipe.tilts_rad.end(), [&](double tilt) {
    return std::abs(tilt - tilt_rad) < 1e-6;
  });
}

/// The recipe with a remedy; nothing where it has it already, or the rig cannot.
std::optional<ScanRecipe> remedied(ScanRecipe recipe,
                                   Remedy remedy,
                                   const Rig& rig,
                                   const ScanPlanOptions& options) {
  constexpr int kMostShifts = 16;
  constexpr double kMostExposure = 8.0;
  const auto lay = [&](double tilt_rad) -> std::optional<ScanRecipe> {
    if (has_tilt(recipe, tilt_rad)) return std::nullopt;
    recipe.tilts_rad.push_back(tilt_rad);
    return recipe;
  };
  switch (remedy) {
    case Remedy::TurnOver:
      return lay(kPi);
    case Remedy::LayDown:
      return lay(0.5 * kPi);
    case Remedy::FinerFringes:
      recipe.periods_px = finer_periods(recipe, rig);
      if (recipe.periods_px.empty()) return std::nullopt;
      return recipe;
    case Remedy::LongerExposure: {
      const double right = std::min(kMostExposure, 1.0 / options.scan.reflectance);
      if (!(right > 1.25 * recipe.exposure)) return std::nullopt;
      recipe.exposure = right;
      return recipe;
    }
    case Remedy::Shifts:
      if (2 * recipe.shifts > kMostShifts) return std::nullopt;
      recipe.shifts *= 2;
      return recipe;
    case Remedy::Stations:
      if (!rig.turntable || recipe.stations >= options.most_stations) return std::nullopt;
      recipe.stations = std::min(options.most_stations, (3 * recipe.stations + 1) / 2);
      return recipe;
  }
  return std::nullopt;
}

/// Corners of the reference and where they lie on the table: an operator clicks such points.
std::vector<PointPair> corners_of(const Mesh& reference, const Eigen::Isometry3d& table_from_part) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : reference.vertices_mm)
    box.extend(vertex.cast<double>());
  const Vector3d least = 1e-3 * Vector3d::Constant(box.diagonal().norm());  // of a flat part
  std::vector<PointPair> pairs;
  for (const Vector3d& at :
       {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    const Vector3d corner = box.min() + at.cwiseProduct(box.sizes().cwiseMax(least));
    pairs.push_back({table_from_part * corner, corner});
  }
  return pairs;
}

/// What a recipe measures of a part without errors, inspected by the plan.
struct Prediction {
  TriedRecipe tried;
  Inspection found;
};

/// Scans and inspects in software.
class Predictor {
 public:
  Predictor(const InspectionReference& reference,
            const InspectionPlan& plan,
            const Rig& rig,
            const ScanPlanOptions& options,
            const Run& run)
      : reference_(reference), plan_(plan), rig_(rig), options_(options), run_(run) {
    constexpr double kColumns = 240.0;
    int& divisor = options_.scan.divisor;
    if (divisor == 0)
      divisor =
          std::max(1, static_cast<int>(std::lround(rig.reference().model.width_px / kColumns)));
  }

  [[nodiscard]] Prediction of(const ScanRecipe& recipe) const {
    Prediction prediction;
    prediction.tried.recipe = recipe;
    try {
      inspect(prediction);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Input && error.kind() != ErrorKind::Numeric) throw;
      prediction.tried.fault = error.what();
    }
    return prediction;
  }

 private:
  void inspect(Prediction& prediction) const {
    TriedRecipe& tried = prediction.tried;
    const Mesh& part = reference_.scene.mesh();
    VirtualScan scan = virtual_scan(part, rig_, tried.recipe, options_.scan, run_);
    InspectionPlan plan = plan_;
    if (plan.align != "datum") plan.align = "best-fit";
    plan.start = 0;
    plan.points = corners_of(part, scan.table_from_part);
    // Patches and strips of as many vertices as those of the full camera have.
    const double finer = 1.0 / options_.scan.divisor;
    if (!plan.surface.edge_mm) plan.surface.edge_mm = finer * default_edge_mm(scan.mesh, part);
    if (plan.surface.min_feature_mm > 0.0)
      plan.surface.min_feature_mm =
          std::max(plan.surface.min_feature_mm, default_feature_mm(scan.mesh));
    prediction.found = inspect_part(std::move(scan.mesh),
                                    &reference_,
                                    plan,
                                    {.statistics = false, .mesh_name = "the plan"},
                                    run_);
    tried.reach = reach_of(prediction.found, plan.surface.well_measured_share());
  }

  const InspectionReference& reference_;
  const InspectionPlan& plan_;
  const Rig& rig_;
  ScanPlanOptions options_;
  const Run& run_;
};

/// Whether a recipe reaches clearly more than another one.
bool reaches_more(const TriedRecipe& one, const TriedRecipe& other) {
  if (one.fault.empty() != other.fault.empty()) return one.fault.empty();
  return decides_more(one.reach, other.reach);
}

}  // namespace

ScanPlan plan_scan(const InspectionReference& reference,
                   const InspectionPlan& plan,
                   const Rig& rig,
                   const ScanPlanOptions& options,
                   const Run& run) {
  constexpr std::size_t kMostTried = 16;
  const Predictor predictor(reference, plan, rig, options, run);
  ScanPlan found;
  Prediction best = predictor.of(options.start);
  found.tried.push_back(best.tried);
  std::set<Remedy> useless;
  while (options.search && best.tried.reach.need != ScanNeed::Nothing &&
         found.tried.size() < kMostTried) {
    std::optional<ScanRecipe> next;
    Remedy chosen{};
    for (const Remedy remedy : remedies_for(best.tried.reach.need)) {
      if (useless.contains(remedy)) continue;
      next = remedied(best.tried.recipe, remedy, rig, options);
      chosen = remedy;
      if (next) break;
    }
    if (!next) break;
    Prediction other = predictor.of(*next);
    found.tried.push_back(other.tried);
    if (reaches_more(other.tried, best.tried)) {
      best = std::move(other);
      useless.clear();
    } else {
      useless.insert(chosen);
    }
  }
  if (!best.tried.fault.empty()) throw Error(ErrorKind::Input, best.tried.fault);
  found.recipe = best.tried.recipe;
  found.need = best.tried.reach.need;
  found.suffices = best.tried.reach.need == ScanNeed::Nothing;
  found.predicted = std::move(best.found);
  const SurfaceInspection& surface = found.predicted.surface.value();
  const SurfaceRule& rule = surface.verdict.rule;
  found.characteristics = decidable_characteristics(found.predicted, rule.well_measured_share());
  found.map = uncertainty_map(surface_patches(found.predicted.mesh,
                                              surface.deviations,
                                              reference.scene,
                                              rule.min_feature_mm,
                                              {},
                                              rule.edge_mm.value_or(0.0),
                                              run),
                              reference.scene.mesh(),
                              run);
  return found;
}

}  // namespace frangia
