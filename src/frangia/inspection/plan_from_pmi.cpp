#include "frangia/inspection/plan_from_pmi.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Kind = CadRequirementKind;

/// The characteristic of a kind that has one; none: it is a size or something else.
std::optional<Characteristic> characteristic_of_kind(Kind kind) {
  switch (kind) {
    case Kind::Distance:
      return Characteristic::Distance;
    case Kind::Angle:
      return Characteristic::Angle;
    case Kind::Flatness:
      return Characteristic::Flatness;
    case Kind::Roundness:
      return Characteristic::Roundness;
    case Kind::Cylindricity:
      return Characteristic::Cylindricity;
    case Kind::Parallelism:
      return Characteristic::Parallelism;
    case Kind::Perpendicularity:
      return Characteristic::Perpendicularity;
    case Kind::Position:
      return Characteristic::Position;
    case Kind::RunOut:
      return Characteristic::RunOut;
    case Kind::TotalRunOut:
      return Characteristic::TotalRunOut;
    case Kind::SurfaceProfile:
      return Characteristic::SurfaceProfile;
    case Kind::Datum:
    case Kind::Diameter:
    case Kind::Other:
      break;
  }
  return std::nullopt;
}

/// Why a model without a requirement has none.
std::string why_nothing(const CadPmi& pmi) {
  constexpr const char* kDo =
      "export it as STEP AP242 with semantic PMI, or write the plan by hand";
  if (pmi.schema == "AP203" || pmi.schema == "AP214")
    return fmt::format("it is STEP {}, which holds no tolerances; {}", pmi.schema, kDo);
  if (pmi.has_graphics)
    return fmt::format("its tolerances are drawn for people and not stated for programs; {}", kDo);
  return fmt::format("it states no dimensions with tolerances; {}", kDo);
}

/// Builds a plan, a requirement at a time.
class PlanBuilder {
 public:
  PlanBuilder(std::span<const CadFace> faces, const CadPmi& pmi, const std::filesystem::path& file)
      : faces_(faces), pmi_(pmi) {
    plan_.plan.part = file.stem().string();
    plan_.plan.reference = file;
    plan_.plan.align = "best-fit";
  }

  PmiPlan built() {
    for (const CadRequirement& one : pmi_.requirements)
      if (one.kind == Kind::Datum) add_datum(one);
    for (const CadRequirement& one : pmi_.requirements)
      if (one.kind != Kind::Datum) add(one);
    if (!system_.empty()) {
      plan_.plan.align = "datum";
      plan_.plan.datums = system_;
    }
    return std::move(plan_);
  }

 private:
  static std::string title_of(const CadRequirement& one) {
    std::string title(one.kind == Kind::Other ? one.name : std::string(name_of(one.kind)));
    if (one.kind != Kind::Other && !one.name.empty()) title += fmt::format(" \"{}\"", one.name);
    if (!one.faces.empty()) title += fmt::format(" of face {}", one.faces.front());
    return title;
  }

  void leave_out(const CadRequirement& one, const std::string& why) {
    plan_.left_out.push_back(fmt::format("{}: {}", title_of(one), why));
  }

  /// The first of some faces that has a shape to measure; 0: none.
  [[nodiscard]] std::size_t measurable(const std::vector<std::size_t>& faces) const {
    for (const std::size_t face : faces)
      if (faces_[face - 1].shape) return face;
    return 0;
  }

  /// The planned feature of a face, added where it is new.
  PlannedFeature& feature_of_face(std::size_t face) {
    auto& features = plan_.plan.features;
    const auto known = std::find_if(
        features.begin(), features.end(), [&](const auto& one) { return one.face == face; });
    if (known != features.end()) return *known;
    PlannedFeature feature;
    feature.name = fmt::format("face {}", face);
    feature.face = face;
    feature.kind = faces_[face - 1].shape->kind;
    features.push_back(std::move(feature));
    return features.back();
  }

  void add_datum(const CadRequirement& one) {
    const std::size_t face = measurable(one.faces);
    if (face == 0) {
      leave_out(one, "the file names no flat or round face for it");
      return;
    }
    PlannedFeature& feature = feature_of_face(face);
    if (!feature.name.starts_with("face ")) {
      leave_out(one, fmt::format("its face is datum {}, too", feature.name));
      return;
    }
    feature.name = one.name;
    datums_.insert(one.name);
  }

  void add(const CadRequirement& one) {
    if (one.kind == Kind::Other) return leave_out(one, "is not read");
    if (one.kind == Kind::SurfaceProfile) return add_profile(one);
    std::vector<std::size_t> faces = one.faces;
    std::vector<std::size_t> others = one.other_faces;
    if (others.empty() && faces.size() == 2 &&
        (one.kind == Kind::Distance || one.kind == Kind::Angle)) {
      others = {faces.back()};
      faces.pop_back();
    }
    const std::size_t face = measurable(faces);
    if (face == 0) return leave_out(one, "the file names no flat or round face for it");
    if (!(one.value > 0.0)) return leave_out(one, "it states no value");
    if (one.kind == Kind::Diameter) return add_diameter(one, face);
    if (one.kind == Kind::Distance || one.kind == Kind::Angle)
      return add_between(one, face, measurable(others));
    add_geometric(one, face);
  }

  void add_diameter(const CadRequirement& one, std::size_t face) {
    if (!(one.lower < one.upper)) return leave_out(one, "it has no tolerance");
    const ShapeKind kind = faces_[face - 1].shape->kind;
    if (kind != ShapeKind::Cylinder && kind != ShapeKind::Sphere)
      return leave_out(one, "its face is no cylinder or sphere");
    PlannedFeature& feature = feature_of_face(face);
    feature.diameter_mm = one.value;
    feature.tolerance_mm = ToleranceLimits{one.lower, one.upper};
  }

  void add_between(const CadRequirement& one, std::size_t face, std::size_t other) {
    if (!(one.lower < one.upper)) return leave_out(one, "it has no tolerance");
    if (other == 0 || other == face) return leave_out(one, "the file names no second face for it");
    PlannedCharacteristic planned = characteristic(one, face);
    planned.datum = feature_of_face(other).name;
    planned.nominal = one.value;
    planned.tolerance = ToleranceLimits{one.lower, one.upper};
    if (one.kind == Kind::Angle && one.value > 90.0) {  // measured are angles up to 90 degrees
      planned.nominal = 180.0 - one.value;
      planned.tolerance = ToleranceLimits{-one.upper, -one.lower};
    }
    plan_.plan.characteristics.push_back(std::move(planned));
  }

  void add_geometric(const CadRequirement& one, std::size_t face) {
    const Characteristic kind = characteristic_of_kind(one.kind).value();
    if (kind == Characteristic::Flatness || kind == Characteristic::Roundness ||
        kind == Characteristic::Cylindricity) {
      feature_of_face(face).forms_mm[kind] = one.value;
      return;
    }
    if (needs_datum(kind) && one.datums.empty()) return leave_out(one, "it names no datum");
    for (const std::string& datum : one.datums) {
      if (!datums_.contains(datum)) {
        return leave_out(
            one, fmt::format("it refers to datum {}, which the file does not define", datum));
      }
    }
    PlannedCharacteristic planned = characteristic(one, face);
    planned.limit = one.value;
    if (needs_datum(kind)) planned.datum = one.datums.front();
    if (kind == Characteristic::Position) planned.position_mm = faces_[face - 1].shape->center_mm;
    plan_.plan.characteristics.push_back(std::move(planned));
    if (one.datums.size() > system_.size()) system_ = one.datums;
  }

  void add_profile(const CadRequirement& one) {
    const std::set<std::size_t> faces(one.faces.begin(), one.faces.end());
    if (!(one.value > 0.0)) return leave_out(one, "it states no value");
    if (!faces.empty() && faces.size() < faces_.size()) return add_profiles(one, faces);
    plan_.plan.tolerance_mm = ToleranceLimits{-0.5 * one.value, 0.5 * one.value};
  }

  /// Profiles of single faces.
  void add_profiles(const CadRequirement& one, const std::set<std::size_t>& faces) {
    for (const std::size_t face : faces) {
      if (!faces_[face - 1].shape) {
        leave_out(one, fmt::format("face {} is no plane, cylinder, sphere, cone or torus", face));
        continue;
      }
      PlannedCharacteristic planned = characteristic(one, face);
      planned.limit = one.value;
      plan_.plan.characteristics.push_back(std::move(planned));
    }
  }

  /// A characteristic of a face with a name of its own.
  PlannedCharacteristic characteristic(const CadRequirement& one, std::size_t face) {
    PlannedCharacteristic planned;
    planned.kind = characteristic_of_kind(one.kind).value();
    planned.feature = feature_of_face(face).name;
    const std::string title =
        one.name.empty() ? fmt::format("{} of {}", name_of(one.kind), planned.feature) : one.name;
    planned.name = title;
    for (int copy = 2; !names_.insert(planned.name).second; ++copy)
      planned.name = fmt::format("{} ({})", title, copy);
    return planned;
  }

  std::span<const CadFace> faces_;
  const CadPmi& pmi_;
  PmiPlan plan_;
  std::set<std::string> datums_;
  std::set<std::string> names_;      ///< of the characteristics
  std::vector<std::string> system_;  ///< of datums, the most complete one
};

}  // namespace

PmiPlan plan_from_pmi(std::span<const CadFace> faces,
                      const CadPmi& pmi,
                      const std::filesystem::path& file) {
  if (pmi.requirements.empty())
    throw Error(ErrorKind::Input, fmt::format("{}: {}", file.string(), why_nothing(pmi)));
  PmiPlan found = PlanBuilder(faces, pmi, file).built();
  const InspectionPlan& plan = found.plan;
  const bool judges = std::any_of(plan.features.begin(), plan.features.end(), [](const auto& one) {
    return one.tolerance_mm || !one.forms_mm.empty();
  });
  if (!judges && plan.characteristics.empty() && !plan.tolerance_mm) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: none of its {} dimensions and tolerances can be planned, such as "
                            "{}; write the plan by hand",
                            file.string(),
                            pmi.requirements.size(),
                            found.left_out.empty() ? "its datums" : found.left_out.front()));
  }
  return found;
}

}  // namespace frangia
