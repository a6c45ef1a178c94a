// Plans of inspections, inspect_part, and what it finds as objects.
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/error.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/inspection_json.h"
#include "frangia/report/write_report.h"

#include "arrays.h"
#include "bindings.h"
#include "run_work.h"

namespace frangia::python {
namespace {

using Limits = std::pair<double, double>;
using Pairs = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// An inspection, and what its report states besides.
struct InspectedPart {
  Inspection found;
  InspectionPlan plan;
  std::filesystem::path reference;
  std::optional<Scan> scan;
};

std::optional<ToleranceLimits> limits_of(const std::optional<Limits>& limits) {
  if (!limits) return std::nullopt;
  const ToleranceLimits out{limits->first, limits->second};
  out.check();
  return out;
}

std::optional<Limits> pair_of(const std::optional<ToleranceLimits>& limits) {
  if (!limits) return std::nullopt;
  return Limits{limits->lower, limits->upper};
}

void set_align(InspectionPlan& plan, const std::string& align) {
  if (!align.empty() &&
      std::find(kAlignments.begin(), kAlignments.end(), align) == kAlignments.end()) {
    throw Error(
        ErrorKind::Input,
        fmt::format(
            "align = \"{}\" is not known; use {} or \"\"", align, fmt::join(kAlignments, ", ")));
  }
  plan.align = align;
}

void set_points(InspectionPlan& plan, const Pairs& points) {
  plan.points.clear();
  for (const auto& [scan_mm, reference_mm] : points)
    plan.points.push_back({scan_mm, reference_mm});
}

InspectionPlan make_plan(const std::string& align,
                         const std::optional<Limits>& tolerance_mm,
                         const Pairs& points,
                         std::size_t start,
                         double min_feature_mm,
                         const std::optional<double>& edge_mm,
                         double min_coverage,
                         double max_gap_mm,
                         bool thickness) {
  InspectionPlan plan;
  set_align(plan, align);
  plan.tolerance_mm = limits_of(tolerance_mm);
  set_points(plan, points);
  plan.start = start;
  plan.surface.min_feature_mm = min_feature_mm;
  plan.surface.edge_mm = edge_mm;
  plan.surface.min_coverage = min_coverage;
  plan.surface.max_gap_mm = max_gap_mm;
  plan.thickness = thickness;
  plan.surface.check();
  return plan;
}

InspectedPart inspect(const Mesh& mesh,
                      const py::object& reference,
                      const InspectionPlan& plan,
                      bool features,
                      const std::optional<Scan>& scan,
                      const py::object& progress) {
  InspectedPart part;
  part.plan = plan;
  part.scan = scan;
  std::optional<Mesh> nominal;
  if (py::isinstance<Mesh>(reference)) {
    nominal = reference.cast<const Mesh&>();
  } else {
    part.reference = reference.is_none() ? plan.reference : reference.cast<std::filesystem::path>();
  }
  part.found = result_of(progress, [&](const Run& run) {
    std::optional<InspectionReference> against;
    if (nominal) {
      against = reference_of_mesh(std::move(*nominal), run);
    } else if (!part.reference.empty()) {
      against = read_inspection_reference(part.reference, {.unit_mm = plan.unit_mm}, run);
    }
    const InspectOptions options{.features = features, .scan = part.scan ? &*part.scan : nullptr};
    return inspect_part(mesh, against ? &*against : nullptr, plan, options, run);
  });
  return part;
}

py::array_t<float> values_of(const std::vector<float>* values, const py::object& owner) {
  if (values == nullptr) return py::array_t<float>(std::vector<py::ssize_t>{0});
  return view_of<float>(*values, owner);
}

void bind_plan(py::module_& module) {
  py::class_<InspectionPlan> plan(
      module, "InspectionPlan", "How the parts of one kind are inspected.");
  plan.def(py::init(&make_plan),
           py::kw_only(),
           py::arg("align") = "",
           py::arg("tolerance_mm") = std::optional<Limits>(),
           py::arg("points") = Pairs(),
           py::arg("start") = std::size_t{0},
           py::arg("min_feature_mm") = 0.0,
           py::arg("edge_mm") = std::optional<double>(),
           py::arg("min_coverage") = SurfaceRule{}.min_coverage,
           py::arg("max_gap_mm") = 0.0,
           py::arg("thickness") = false,
           "As the keys of inspection.toml. align: best-fit, datum, points, none, or empty; "
           "tolerance_mm: lower and upper; points: pairs of the same place on mesh and reference; "
           "0: the default. Features and characteristics are read from a file by "
           "read_inspection_plan.");
  plan.def_readonly("part", &InspectionPlan::part, "Name of the part; may be empty.")
      .def_readonly("reference", &InspectionPlan::reference, "Path; empty: none is stated.")
      .def_property(
          "align",
          [](const InspectionPlan& self) { return self.align; },
          &set_align,
          "best-fit, datum, points, none, or empty.")
      .def_property(
          "points",
          [](const InspectionPlan& self) {
            Pairs pairs;
            for (const PointPair& pair : self.points)
              pairs.emplace_back(pair.scan_mm, pair.reference_mm);
            return pairs;
          },
          &set_points,
          "Pairs of the same place on mesh and reference, mm.")
      .def_readwrite("start", &InspectionPlan::start, "Of poses that fit alike, from 1; 0: none.")
      .def_property(
          "tolerance_mm",
          [](const InspectionPlan& self) { return pair_of(self.tolerance_mm); },
          [](InspectionPlan& self, const std::optional<Limits>& limits) {
            self.tolerance_mm = limits_of(limits);
          },
          "Lower and upper limit of the deviations; None: plus and minus 0.1.")
      .def_readwrite("thickness", &InspectionPlan::thickness, "Measure the walls.")
      .def_property_readonly(
          "features",
          [](const InspectionPlan& self) {
            std::vector<std::string> names;
            for (const PlannedFeature& feature : self.features)
              names.push_back(feature.name);
            return names;
          },
          "Names of the features.")
      .def("__repr__", [](const InspectionPlan& self) {
        return fmt::format("<frangia.InspectionPlan, {} features, {} characteristics>",
                           self.features.size(),
                           self.characteristics.size());
      });
  module.def("read_inspection_plan",
             &read_inspection_plan,
             py::arg("path"),
             "Reads inspection.toml; its reference is relative to it.");
}

void bind_rows(py::module_& module) {
  py::class_<MeasuredCharacteristic>(
      module, "MeasuredCharacteristic", "A row of the table of results.")
      .def_readonly("name", &MeasuredCharacteristic::name, "Of the plan, with the quantity.")
      .def_readonly("feature", &MeasuredCharacteristic::feature, "Name of the feature.")
      .def_readonly("unit", &MeasuredCharacteristic::unit, "mm or degrees.")
      .def_readonly("nominal", &MeasuredCharacteristic::nominal, "None: not stated.")
      .def_property_readonly(
          "limits",
          [](const MeasuredCharacteristic& self) { return pair_of(self.limits); },
          "Lower and upper limit of the value; an absent one is infinite. None: no limits.")
      .def_readonly("value", &MeasuredCharacteristic::value, "NaN: the feature was not found.")
      .def_readonly("u95", &MeasuredCharacteristic::u95, "Half the width of the 95 % interval.")
      .def_property_readonly(
          "verdict",
          [](const MeasuredCharacteristic& self) {
            return self.limits ? std::optional(std::string(name_of(self.conformity)))
                               : std::nullopt;
          },
          "in, out or undecided by ISO 14253-1; None without limits.")
      .def("__repr__", [](const MeasuredCharacteristic& self) {
        return fmt::format("<frangia.MeasuredCharacteristic {}: {:.4f} {}, U95 {:.4f}>",
                           self.name,
                           self.value,
                           self.unit,
                           self.u95);
      });
  py::class_<SurfacePlace>(
      module, "SurfacePlace", "A place of the surface that is out or undecided.")
      .def_property_readonly(
          "decision",
          [](const SurfacePlace& self) { return std::string(name_of(self.decision)); },
          "out, near_limit, not_well_measured or not_measured.")
      .def_readonly("at_mm", &SurfacePlace::at_mm, "Where, frame of the reference.")
      .def_readonly("deviation_mm", &SurfacePlace::deviation_mm, "Mean over a patch; or NaN.")
      .def_readonly("u95_mm", &SurfacePlace::u95_mm, "Of the deviation.")
      .def_readonly("area_mm2", &SurfacePlace::area_mm2, "Of the nominal surface.");
}

void bind_reasons(py::module_& module) {
  py::class_<VerdictClause>(module, "VerdictClause", "A part of the sentence about a verdict.")
      .def_property_readonly(
          "id",
          [](const VerdictClause& self) { return std::string(self.id); },
          "What it says, such as out_at.")
      .def_property_readonly(
          "values",
          [](const VerdictClause& self) {
            std::map<std::string, ClauseValue> values;
            for (const auto& [name, value] : self.values)
              values.emplace(name, value);
            return values;
          },
          "Its parameters by name; NaN where one is not known.")
      .def_readonly("text", &VerdictClause::text, "In English.");
  py::class_<VerdictReason>(module, "VerdictReason", "A reason of the verdict about a part.")
      .def_property_readonly(
          "about",
          [](const VerdictReason& self) { return std::string(self.about); },
          "surface or characteristics.")
      .def_readonly("clauses", &VerdictReason::clauses, "The parts of its sentence.")
      .def("__str__", &VerdictReason::text);
}

}  // namespace

void bind_inspection(py::module_& module) {
  bind_plan(module);
  bind_rows(module);
  bind_reasons(module);
  py::class_<InspectedPart> part(
      module, "Inspection", "What an inspection found. Missing values are NaN, empty or None.");
  part.def_property_readonly(
          "verdict",
          [](const InspectedPart& self) { return std::string(name_of(self.found.verdict)); },
          "in, out or undecided: the surface and the characteristics together.")
      .def_property_readonly(
          "sentence",
          [](const InspectedPart& self) {
            return self.found.surface ? sentence_of(self.found.surface->verdict) : std::string();
          },
          "The verdict about the surface in words; empty without a reference.")
      .def_property_readonly(
          "reasons",
          [](const InspectedPart& self) { return self.found.reasons; },
          "Why the verdict is what it is, what decided first.")
      .def_property_readonly(
          "mesh",
          [](const InspectedPart& self) -> const Mesh& { return self.found.mesh; },
          py::return_value_policy::reference_internal,
          "As it lies on the reference.")
      .def_property_readonly(
          "deviation_mm",
          [](const py::object& self) {
            const auto& surface = self.cast<const InspectedPart&>().found.surface;
            return values_of(surface ? &surface->deviations.deviation_mm : nullptr, self);
          },
          "Of each vertex, positive outside; NaN: not compared; empty without a reference.")
      .def_property_readonly(
          "u_mm",
          [](const py::object& self) {
            const auto& surface = self.cast<const InspectedPart&>().found.surface;
            return values_of(surface ? &surface->deviations.u_mm : nullptr, self);
          },
          "Standard uncertainty of each deviation; empty: not known.")
      .def_property_readonly(
          "thickness_mm",
          [](const py::object& self) {
            const auto& walls = self.cast<const InspectedPart&>().found.walls;
            return values_of(walls ? &walls->thickness.thickness_mm : nullptr, self);
          },
          "Of the wall at each vertex; empty: not asked for.")
      .def_property_readonly(
          "reference_from_mesh",
          [](const InspectedPart& self) -> std::optional<Eigen::Matrix4d> {
            if (!self.found.alignment) return std::nullopt;
            return self.found.alignment->pose.reference_from_mesh.matrix();
          },
          "4 x 4; None: the plan says nothing about an alignment.")
      .def_property_readonly(
          "characteristics",
          [](const InspectedPart& self) { return self.found.characteristics; },
          "Rows of the table of results, in the order of the plan.")
      .def_property_readonly(
          "places",
          [](const InspectedPart& self) {
            return self.found.surface ? self.found.surface->verdict.places
                                      : std::vector<SurfacePlace>{};
          },
          "Of the surface that are out or undecided, the worst first.")
      .def(
          "to_dict",
          [](const InspectedPart& self) -> py::dict {
            return py::module_::import("json").attr("loads")(inspection_json(self.found));
          },
          "Everything, as `frangia inspect --json` prints it; missing values are None.")
      .def(
          "write_report",
          [](const InspectedPart& self,
             const std::filesystem::path& path,
             const py::object& progress) {
            return result_of(progress, [&](const Run& run) {
              const ReportSources sources{.reference = self.reference,
                                          .scan = self.scan ? &*self.scan : nullptr,
                                          .version = "Frangia " FRANGIA_VERSION};
              return write_report(path, self.found, self.plan, sources, run);
            });
          },
          py::arg("path"),
          py::kw_only(),
          py::arg("progress") = py::none(),
          "Writes the report as HTML, and its JSON, CSV and sections next to it. Returns the "
          "paths.")
      .def("__repr__", [](const InspectedPart& self) {
        return fmt::format("<frangia.Inspection: {}, {} characteristics>",
                           name_of(self.found.verdict),
                           self.found.characteristics.size());
      });
  module.def(
      "inspect_part",
      &inspect,
      py::arg("mesh"),
      py::arg("reference") = py::none(),
      py::arg("plan") = InspectionPlan{},
      py::kw_only(),
      py::arg("features") = false,
      py::arg("scan") = std::optional<Scan>(),
      py::arg("progress") = py::none(),
      "Inspects a part as `frangia inspect` does. reference: a mesh, or the path of a mesh or "
      "a CAD file; None: that of the plan, if it states one. features: find all, not only "
      "those of the plan. scan: of the mesh, so that features hold the covariance of its rig.");
}

}  // namespace frangia::python
