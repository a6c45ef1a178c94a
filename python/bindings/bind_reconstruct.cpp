// Above 250 lines: the arguments and docstrings of the functions of one module.
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/survey_scan.h"
#include "frangia/files/range_scan.h"
#include "frangia/reconstruct/merge_scans.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/rig.h"

#include "arrays.h"
#include "bindings.h"
#include "own_stages.h"
#include "run_work.h"

namespace frangia::python {
namespace {

DecodeOptions decode_options(const py::object& algorithm,
                             const std::string& directions,
                             float max_sigma_rad,
                             bool undo_response,
                             bool undo_blur,
                             bool accept_inconsistent,
                             const py::object& wrap,
                             const py::object& unwrap_spatially,
                             const py::object& unwrap) {
  DecodeOptions options;
  if (py::isinstance<LinearAlgorithm>(algorithm)) {
    options.own_algorithm = algorithm.cast<LinearAlgorithm>();
  } else {
    options.algorithm = algorithm.cast<std::string>();
  }
  options.directions = value_named<DirectionChoice>("directions", directions);
  options.wrap.max_sigma_rad = max_sigma_rad;
  options.undo_own_response = undo_response;
  options.undo_blur = undo_blur;
  options.accept_inconsistent = accept_inconsistent;
  options.own = own_stages(wrap, unwrap_spatially, unwrap);
  return options;
}

/// Fringe order of the finest fringes: whole turns between absolute and wrapped phase; -1 where not
/// measured.
py::array_t<std::int32_t> order_of(const DecodedDirection& direction) {
  if (direction.wrapped.empty())
    throw Error(ErrorKind::Input, "the direction holds no wrapped phase");
  const Image<float>& wrapped = direction.wrapped.back().phase_rad;
  const Image<float>& absolute = direction.phase.phase_rad;
  Image<std::int32_t> order(absolute.width(), absolute.height(), -1);
  for (std::size_t i = 0; i < order.pixels().size(); ++i) {
    const float turns = (absolute.pixels()[i] - wrapped.pixels()[i]) / static_cast<float>(kTwoPi);
    if (!std::isnan(turns)) order.pixels()[i] = static_cast<std::int32_t>(std::lround(turns));
  }
  return array_of<std::int32_t>(std::move(order));
}

DecodedView decode_stacks(const std::vector<FrameStack>& stacks,
                          const Rig& rig,
                          const DecodeOptions& options,
                          const Run& run) {
  const auto rays = has_geometry(rig) ? rays_of(rig.reference().model) : Image<Eigen::Vector2f>();
  return decode_view(stacks, rig, rays, options, run);
}

DecodedView decode(const Scan& scan, std::size_t view, DecodeOptions options, const Run& run) {
  if (view >= scan.views.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has no view {}; its views are 0 to {}",
                            scan.folder.string(),
                            view,
                            scan.views.size() - 1));
  }
  options.survey = survey_scan(scan, run);
  return decode_stacks(read_frames(scan, view, run), scan.rig, options, run);
}

std::vector<std::string> findings_of(const DecodedView& view) {
  std::vector<std::string> out;
  for (const FrameAssessment& assessment : assessments_of(view))
    out.push_back(describe(assessment));
  const std::string misfit = misfit_of(view);
  if (!misfit.empty()) out.push_back(misfit);
  return out;
}

void bind_results(py::module_& module) {
  py::class_<DecodePlan>(module, "DecodePlan", "Where the fringe orders of a scan come from.")
      .def_property_readonly(
          "absolute",
          [](const DecodePlan& self) { return is_absolute(self); },
          "False: phases are relative, or regions have offsets of their own.")
      .def("__str__", [](const DecodePlan& self) { return describe(self); });
  const auto add_parts = [](auto part) {
    part("phase", &DecodedDirection::phase, "Absolute phase of the finest fringes.");
    part("wrapped", &DecodedDirection::wrapped, "Wrapped maps, coarse to fine.");
    part("relative", &DecodedDirection::relative, "Spatially unwrapped phase, or None.");
    part("noise", &DecodedDirection::noise, "Noise of the camera.");
  };
  py::class_<DecodedDirection> direction(
      module, "DecodedDirection", "One direction of fringes of a view and intermediate results.");
  add_parts([&](const char* name, auto member, const char* text) {
    direction.def_readonly(name, member, text);
  });
  direction.def_property_readonly("order", &order_of, "Fringe order; -1: not measured.");
  py::class_<DecodedView> view(
      module, "DecodedView", "The phase of one view; its parts are those of the first direction.");
  add_parts([&](const char* name, auto member, const char* text) {
    view.def_property_readonly(
        name,
        [member](const DecodedView& self) -> const auto& {
          return self.directions.front().*member;
        },
        text);
  });
  view.def_readonly("directions",
                    &DecodedView::directions,
                    "The decoded directions of fringes: two only if both have an absolute phase.")
      .def_property_readonly(
          "order",
          [](const DecodedView& self) { return order_of(self.directions.front()); },
          "Fringe order; -1: not measured.")
      .def_property_readonly("findings", &findings_of, "What the frames show, in sentences.");
  py::class_<ViewSummary>(module, "ViewSummary", "A view after reconstruction.");
  py::class_<MeasuredTarget>(module, "MeasuredTarget", "A target after all views were registered.")
      .def_readonly("code", &MeasuredTarget::code, "-1: it has none.")
      .def_readonly("center_mm", &MeasuredTarget::center_mm, "Object frame, mm.")
      .def_readonly("sigma_mm", &MeasuredTarget::sigma_mm, "Of its coordinates, mm.")
      .def_readonly("views", &MeasuredTarget::views, "That saw it.")
      .def_readonly("setups", &MeasuredTarget::setups, "That saw it, as scan.toml numbers them.");
  py::class_<Reconstruction>(module, "Reconstruction", "A surface and what the stages report.")
      .def_readonly("mesh", &Reconstruction::mesh, "Fused surface, object frame.")
      .def_readonly("points", &Reconstruction::points, "Points of all views.")
      .def_readonly("views", &Reconstruction::views, "Views that hold points.")
      .def_property_readonly(
          "trustworthy",
          [](const Reconstruction& self) { return self.untrusted_reason.empty(); },
          "False: `reason` says why the mesh must not be trusted.")
      .def_property_readonly(
          "targets",
          [](const Reconstruction& self) {
            return self.targets ? self.targets->targets : std::vector<MeasuredTarget>();
          },
          "The stickers of a scan with [targets]; empty without.")
      .def_readonly("reason", &Reconstruction::untrusted_reason, "Empty: it can be trusted.");
}

}  // namespace

void bind_reconstruct(py::module_& module) {
  bind_results(module);
  module.def(
      "plan_decoding",
      [](const Scan& scan, const std::string& directions, float max_sigma_rad) {
        DecodeOptions options;
        options.directions = value_named<DirectionChoice>("directions", directions);
        options.wrap.max_sigma_rad = max_sigma_rad;
        return plan_decoding(scan.patterns, scan.rig, options);
      },
      py::arg("scan"),
      py::kw_only(),
      py::arg("directions") = "fused",
      py::arg("max_sigma_rad") = 0.1F,
      "How `decode` and `reconstruct` decode the views of a scan; str() of it is a line for each "
      "direction.");
  module.def(
      "decode",
      [](const Scan& scan,
         std::size_t view,
         const py::object& algorithm,
         const std::string& directions,
         float max_sigma_rad,
         bool undo_response,
         bool undo_blur,
         bool accept_inconsistent,
         const py::object& wrap,
         const py::object& unwrap_spatially,
         const py::object& unwrap,
         const py::object& progress) {
        const DecodeOptions options = decode_options(algorithm,
                                                     directions,
                                                     max_sigma_rad,
                                                     undo_response,
                                                     undo_blur,
                                                     accept_inconsistent,
                                                     wrap,
                                                     unwrap_spatially,
                                                     unwrap);
        return result_of(progress,
                         [&](const Run& run) { return decode(scan, view, options, run); });
      },
      py::arg("scan"),
      py::arg("view") = 0,
      py::kw_only(),
      py::arg("algorithm") = "auto",
      py::arg("directions") = "fused",
      py::arg("max_sigma_rad") = 0.1F,
      py::arg("undo_response") = DecodeOptions{}.undo_own_response,
      py::arg("undo_blur") = DecodeOptions{}.undo_blur,
      py::arg("accept_inconsistent") = false,
      py::arg("wrap") = py::none(),
      py::arg("unwrap_spatially") = py::none(),
      py::arg("unwrap") = py::none(),
      py::arg("progress") = py::none(),
      "Decodes a view of a scan. wrap, unwrap_spatially and unwrap are functions of yours in place "
      "of a stage, see the package's help.");
  module.def(
      "decode_frames",
      [](const std::vector<FrameStack>& stacks, const Rig& rig, const std::string& algorithm) {
        DecodeOptions options;
        options.algorithm = algorithm;
        return result_of(py::none(),
                         [&](const Run& run) { return decode_stacks(stacks, rig, options, run); });
      },
      py::arg("stacks"),
      py::arg("rig"),
      py::kw_only(),
      py::arg("algorithm") = "auto",
      "Decodes the frames of one view that are in memory.");
  module.def(
      "reconstruct",
      [](const Scan& scan,
         const py::object& algorithm,
         const std::string& directions,
         float max_sigma_rad,
         bool undo_response,
         bool undo_blur,
         bool accept_inconsistent,
         const py::object& wrap,
         const py::object& unwrap_spatially,
         const py::object& unwrap,
         double voxel_mm,
         bool register_views,
         bool indirect_light,
         bool keep_islands,
         bool watertight,
         double clip_below_mm,
         const py::object& progress) {
        ReconstructOptions options;
        options.decode = decode_options(algorithm,
                                        directions,
                                        max_sigma_rad,
                                        undo_response,
                                        undo_blur,
                                        accept_inconsistent,
                                        wrap,
                                        unwrap_spatially,
                                        unwrap);
        options.fusion.voxel_mm = voxel_mm;
        options.register_views = register_views;
        options.indirect_light = indirect_light;
        options.finish.keep_islands = keep_islands;
        options.finish.watertight = watertight;
        options.clip_below_mm = clip_below_mm;
        return result_of(progress, [&](const Run& run) { return reconstruct(scan, options, run); });
      },
      py::arg("scan"),
      py::kw_only(),
      py::arg("algorithm") = "auto",
      py::arg("directions") = "fused",
      py::arg("max_sigma_rad") = 0.1F,
      py::arg("undo_response") = DecodeOptions{}.undo_own_response,
      py::arg("undo_blur") = DecodeOptions{}.undo_blur,
      py::arg("accept_inconsistent") = false,
      py::arg("wrap") = py::none(),
      py::arg("unwrap_spatially") = py::none(),
      py::arg("unwrap") = py::none(),
      py::arg("voxel_mm") = 0.0,
      py::arg("register_views") = true,
      py::arg("indirect_light") = true,
      py::arg("keep_islands") = false,
      py::arg("watertight") = false,
      py::arg("clip_below_mm") = -std::numeric_limits<double>::infinity(),
      py::arg("progress") = py::none(),
      "Frames to one surface, as `frangia reconstruct`. A voxel of 0 mm is derived from the scan.");
  module.def(
      "merge",
      [](const std::vector<std::filesystem::path>& paths,
         double voxel_mm,
         const py::object& progress) {
        MergeScansOptions options;
        options.fusion.voxel_mm = voxel_mm;
        MergedScans merged = result_of(progress, [&](const Run& run) {
          std::vector<RangeScan> scans;
          for (const std::filesystem::path& path : paths)
            scans.push_back(read_range_scan(path, run));
          return merge_scans(scans, options, run);
        });
        std::vector<Eigen::Matrix4d> poses;
        for (const MergedScan& scan : merged.scans)
          poses.emplace_back(scan.world_from_scan.matrix());
        return py::make_tuple(std::move(merged.mesh), poses, merged.untrusted_reason);
      },
      py::arg("paths"),
      py::kw_only(),
      py::arg("voxel_mm") = 0.0,
      py::arg("progress") = py::none(),
      "Registers range scans of other scanners and fuses them: the mesh, the pose of each scan "
      "(4 x 4), and why the mesh must not be trusted (empty: it can be).");
}

}  // namespace frangia::python
