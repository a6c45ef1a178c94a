#include "frangia/inspection/measured_characteristics.h"

#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/statistics.h"
#include "frangia/inspection/internal/assign_features.h"
#include "frangia/inspection/internal/shape_mismatch.h"

namespace frangia {
namespace {

using inspection::assign_features;
using inspection::AssignedFeature;

/// What a plan says of a feature, and what was found.
struct FoundFeature {
  const MeasuredFeature* measured = nullptr;
  const PlannedFeature* planned = nullptr;
};
using FeatureByName = std::map<std::string, FoundFeature>;

/// How far from its planned place a feature may be.
double farthest_mm(const std::vector<MeasuredFeature>& features) {
  Eigen::AlignedBox3d box;
  for (const MeasuredFeature& feature : features) {
    for (const Eigen::Vector3d& point : feature.points_mm)
      box.extend(point);
  }
  return box.isEmpty() ? 0.0 : kFarthestFeature * box.diagonal().norm();
}

ToleranceLimits at_most(double limit) {
  return {-std::numeric_limits<double>::infinity(), limit};
}

void add_feature_rows(const PlannedFeature& planned,
                      const MeasuredFeature* feature,
                      std::vector<MeasuredCharacteristic>& rows) {
  if (planned.diameter_mm) {
    MeasuredCharacteristic row;
    row.name = planned.name + " diameter";
    row.feature = planned.name;
    row.shape = planned.kind;
    row.nominal = planned.diameter_mm;
    if (planned.tolerance_mm) {
      row.limits = ToleranceLimits{*planned.diameter_mm + planned.tolerance_mm->lower,
                                   *planned.diameter_mm + planned.tolerance_mm->upper};
    }
    if (feature != nullptr) {
      row.value = 2.0 * feature->feature.fit.shape.radius_mm;
      row.u95 = feature->feature.uncertainty.u95_mm;
      row.uncertainty_known = feature->feature.uncertainty.is_known;
    }
    decide(row);
    rows.push_back(row);
  }
  for (const auto& [form, limit] : planned.forms_mm) {
    MeasuredCharacteristic row;
    row.name = fmt::format("{} {}", planned.name, name_of(form));
    row.kind = form;
    row.feature = planned.name;
    row.shape = planned.kind;
    row.limits = at_most(limit);
    row.fit = planned.form;
    if (feature != nullptr) {
      const MeasuredValue value =
          measure(form, *feature, nullptr, Eigen::Vector3d::Zero(), planned.form);
      row.value = value.value;
      row.u95 = value.u95;
      row.uncertainty_known = feature->feature.uncertainty.is_known;
    }
    decide(row);
    rows.push_back(row);
  }
}

MeasuredCharacteristic row_of(const PlannedCharacteristic& planned, const FeatureByName& found) {
  MeasuredCharacteristic row;
  row.name = planned.name;
  row.kind = planned.kind;
  row.feature = planned.feature;
  row.datum = planned.datum;
  row.unit = planned.kind == Characteristic::Angle ? "degrees" : "mm";
  row.nominal = planned.nominal;
  if (planned.nominal && planned.tolerance) {
    row.limits = ToleranceLimits{*planned.nominal + planned.tolerance->lower,
                                 *planned.nominal + planned.tolerance->upper};
  }
  if (planned.limit) row.limits = at_most(*planned.limit);
  if (!planned.section.empty()) row.feature = planned.section;
  if (!planned.feature.empty()) row.shape = found.at(planned.feature).planned->kind;
  if (is_of_surface(planned.kind)) return row;
  const auto& [feature, of] = found.at(planned.feature);
  if (is_form(planned.kind)) row.fit = of->form;
  const MeasuredFeature* datum = planned.datum.empty() ? nullptr : found.at(planned.datum).measured;
  const bool is_measured = feature != nullptr && (planned.datum.empty() || datum != nullptr);
  if (is_measured) {
    const MeasuredValue value =
        measure(planned.kind, *feature, datum, planned.position_mm, of->form);
    row.value = value.value;
    row.u95 = value.u95;
    row.uncertainty_known = feature->feature.uncertainty.is_known &&
                            (datum == nullptr || datum->feature.uncertainty.is_known);
  }
  decide(row);
  return row;
}

/// Warns of a feature that was not found, and of one that may be another one.
void warn_of(const PlannedFeature& planned, const AssignedFeature& found, const Run& run) {
  if (found.claimed_by != nullptr) {
    run.warn(
        fmt::format("{}: the {} that is nearest to it is that of {}; its values are missing; scan "
                    "it, or correct its near_mm",
                    planned.name,
                    name_of(planned.kind),
                    found.claimed_by->name));
  } else if (found.measured == nullptr) {
    run.warn(fmt::format("{}: no {} was found near ({:g}, {:g}, {:g}); its values are missing",
                         planned.name,
                         name_of(planned.kind),
                         planned.near_mm.x(),
                         planned.near_mm.y(),
                         planned.near_mm.z()));
  } else if (found.off_mm > 0.0) {
    run.warn(
        fmt::format("{}: its values are those of a {} that is {:.3g} mm from its near_mm; check "
                    "that it is not another one",
                    planned.name,
                    name_of(planned.kind),
                    found.off_mm));
  }
}

}  // namespace

void decide(MeasuredCharacteristic& row) {
  if (!row.limits || !std::isfinite(row.value)) return;
  const double u = row.uncertainty_known ? row.u95 / kNormal95 : 0.0;
  row.conformity = conformity_of(row.value, u, *row.limits);
  if (!std::isfinite(u)) {
    row.reason =
        "undecided: its uncertainty is not known, because too few points were measured; scan it "
        "from more stations";
  }
}

const Feature* nearest_feature(const PlannedFeature& planned,
                               const std::vector<Feature>& features,
                               double farthest_mm) {
  const Feature* best = nullptr;
  double least = farthest_mm;
  for (const Feature& feature : features) {
    if (feature.fit.shape.kind != planned.kind) continue;
    const double mismatch = shape_mismatch_mm(planned, feature.fit.shape);
    if (mismatch >= least) continue;
    least = mismatch;
    best = &feature;
  }
  return best;
}

std::vector<MeasuredCharacteristic> measure_characteristics(
    const InspectionPlan& plan, const std::vector<MeasuredFeature>& features, const Run& run) {
  std::vector<MeasuredCharacteristic> rows;
  FeatureByName found;
  const auto assigned = assign_features(plan.features, features, farthest_mm(features));
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    const PlannedFeature& planned = plan.features[i];
    found[planned.name] = {assigned[i].measured, &planned};
    warn_of(planned, assigned[i], run);
    add_feature_rows(planned, assigned[i].measured, rows);
  }
  for (const PlannedCharacteristic& planned : plan.characteristics)
    rows.push_back(row_of(planned, found));
  return rows;
}

std::vector<NamedFeature> named_features(const InspectionPlan& plan,
                                         const std::vector<MeasuredFeature>& features) {
  std::vector<NamedFeature> named;
  const auto assigned = assign_features(plan.features, features, farthest_mm(features));
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    const MeasuredFeature* found = assigned[i].measured;
    if (found == nullptr) continue;
    named.push_back({plan.features[i].name,
                     found->feature.fit.shape,
                     found->feature.uncertainty,
                     found->low_mm,
                     found->high_mm,
                     found->sampled ? std::vector<std::uint32_t>{} : found->feature.vertices});
  }
  return named;
}

Conformity overall(const std::vector<MeasuredCharacteristic>& rows) {
  bool all_in = false;
  bool undecided = false;
  for (const MeasuredCharacteristic& row : rows) {
    if (!row.limits) continue;
    if (row.conformity == Conformity::Out) return Conformity::Out;
    undecided = undecided || row.conformity == Conformity::Undecided;
    all_in = true;
  }
  return all_in && !undecided ? Conformity::In : Conformity::Undecided;
}

}  // namespace frangia
