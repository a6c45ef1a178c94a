#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/rig/rig.h"

#include "../bindings/arrays.h"
#include "../bindings/run_work.h"
#include "acquisition_bindings.h"

namespace frangia::python {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// One pose of the board: where its points were seen, and how far the rig is from that.
struct CalibrationView {
  std::string name;
  std::vector<int> indices;
  Rows camera_px;
  Rows projector_px;
  Rows camera_residuals_px;
  Rows projector_residuals_px;
  double camera_rms_px = 0.0;
  double projector_rms_px = 0.0;
  double leave_one_out_mm = 0.0;
};

Rows rows_of(const std::vector<Eigen::Vector2d>& values) {
  Rows rows(static_cast<Eigen::Index>(values.size()), 2);
  for (std::size_t i = 0; i < values.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = values[i];
  return rows;
}

std::vector<CalibrationView> views_of(const RigCalibration& found) {
  std::vector<CalibrationView> out;
  for (std::size_t i = 0; i < found.views.size(); ++i) {
    const std::vector<BoardPoint>& points = found.views[i].points;
    CalibrationView view;
    view.name = found.views[i].name;
    view.camera_px.resize(static_cast<Eigen::Index>(points.size()), 2);
    view.projector_px.resize(static_cast<Eigen::Index>(points.size()), 2);
    for (std::size_t k = 0; k < points.size(); ++k) {
      view.indices.push_back(points[k].index);
      view.camera_px.row(static_cast<Eigen::Index>(k)) = points[k].camera_px;
      view.projector_px.row(static_cast<Eigen::Index>(k)) = points[k].projector_px;
    }
    view.camera_residuals_px = rows_of(found.solution.reference().residuals_px.at(i));
    view.camera_rms_px = found.solution.reference().by_view.at(i).rms_px;
    if (found.solution.has_projector) {
      view.projector_residuals_px =
          rows_of(found.solution.reference().projector_residuals_px.at(i));
      view.projector_rms_px = found.solution.reference().projector_by_view.at(i).rms_px;
    }
    view.leave_one_out_mm = found.solution.leave_one_out_mm.at(i);
    out.push_back(std::move(view));
  }
  return out;
}

RigCalibration calibrate(const Scan& scan, bool flat_board, const py::object& progress) {
  CalibrateRigOptions options;
  options.solve.release_board = !flat_board;
  return result_of(progress, [&](const Run& run) {
    RigCalibration found = calibrate_rig(scan, options, run);
    found.rig.calibration->covariance = {found.solution.parameters, found.solution.covariance};
    return found;
  });
}

}  // namespace

void bind_calibrate(py::module_& module) {
  py::class_<CalibrationView>(module, "CalibrationView", "One pose of the board.")
      .def_readonly("name", &CalibrationView::name, "Folder of the view.")
      .def_property_readonly(
          "indices",
          [](const py::object& self) {
            return view_of<int>(self.cast<const CalibrationView&>().indices, self);
          },
          "Number of each point on the board, row by row.")
      .def_readonly("camera_px", &CalibrationView::camera_px, "Points in the image, N x 2, px.")
      .def_readonly("projector_px",
                    &CalibrationView::projector_px,
                    "Projector pixels that light them, N x 2; NaN: a phase is missing.")
      .def_readonly("camera_residuals_px",
                    &CalibrationView::camera_residuals_px,
                    "Observed minus predicted, N x 2, px.")
      .def_readonly("projector_residuals_px",
                    &CalibrationView::projector_residuals_px,
                    "Observed minus predicted, N x 2, projector px; NaN: a phase is missing.")
      .def_readonly("camera_rms_px", &CalibrationView::camera_rms_px, "Of the distances, px.")
      .def_readonly("projector_rms_px", &CalibrationView::projector_rms_px, "Projector px.")
      .def_readonly("leave_one_out_mm",
                    &CalibrationView::leave_one_out_mm,
                    "How far points move without this pose, root mean square, mm.");
  py::class_<RigCalibration>(module, "Calibration", "A calibrated rig and how it was found.")
      .def_readonly("rig", &RigCalibration::rig, "Calibrated rig; `write_rig` writes it.")
      .def_property_readonly("views", &views_of, "The poses that were used.")
      .def_readonly(
          "without_board", &RigCalibration::without_board, "Folders of views without the board.")
      .def_readonly("left_out", &RigCalibration::left_out, "Folders of views with a fault.")
      .def_property_readonly(
          "parameters",
          [](const RigCalibration& self) { return self.solution.parameters; },
          "Names of the rows of `covariance`, such as \"camera.focal_px\".")
      .def_property_readonly(
          "covariance",
          [](const RigCalibration& self) -> const Eigen::MatrixXd& {
            return self.solution.covariance;
          },
          py::return_value_policy::reference_internal,
          "Of the parameters, P x P, in the squares of their units.")
      .def_property_readonly(
          "camera_rms_px",
          [](const RigCalibration& self) { return self.solution.reference().residuals.rms_px; },
          "Reprojection error of the camera, px.")
      .def_property_readonly(
          "projector_rms_px",
          [](const RigCalibration& self) {
            return self.solution.reference().projector_residuals.rms_px;
          },
          "That of the projector, projector px.")
      .def_property_readonly(
          "point_sigma_mm",
          [](const RigCalibration& self) { return self.solution.point_sigma_mm; },
          "Standard uncertainty of a point by the calibration, mm.")
      .def_property_readonly(
          "spread_mm",
          [](const RigCalibration& self) { return self.solution.spread_mm; },
          "The same from the differences between the poses, mm.")
      .def_property_readonly(
          "distance_mm",
          [](const RigCalibration& self) { return self.solution.distance_mm; },
          "Mean distance of the board, mm.")
      .def_property_readonly(
          "grade",
          [](const RigCalibration& self) { return calibration_grade(self.solution); },
          "excellent, good, usable or poor.")
      .def_property_readonly(
          "estimated",
          [](const RigCalibration& self) { return self.solution.terms; },
          "Terms of the model that the data supports.")
      .def_property_readonly(
          "held",
          [](const RigCalibration& self) { return self.solution.held; },
          "Terms that it does not support.");
  module.def("calibrate",
             &calibrate,
             py::arg("scan"),
             py::kw_only(),
             py::arg("flat_board") = false,
             py::arg("progress") = py::none(),
             "Calibrates camera and projector from a scan whose views are poses of a board, as "
             "`frangia calibrate rig`. Read it with read_scan(folder, rig=\"start-values\"). "
             "flat_board: the board is exactly flat and square.");
}

}  // namespace frangia::python
