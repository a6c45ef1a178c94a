#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/inspect/section_curves.h"
#include "frangia/report/section_drawing.h"
#include "frangia/service/hand_measurements.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

constexpr std::size_t kMostPlaces = 3;
constexpr const char* kTooMany = "this project has 500 measurements; remove some";

std::vector<PickedPlace> places_of(const nlohmann::json& json) {
  require(json.is_array() && json.size() <= kMostPlaces, "places: is a list of at most 3 places");
  std::vector<PickedPlace> places;
  for (const nlohmann::json& one : json) {
    require(one.is_object(), "places: each is an object");
    CommandArguments place(one.dump());
    const auto point = place.numbers("point_mm", 3);
    places.push_back({{point[0], point[1], point[2]},
                      static_cast<std::uint32_t>(place.whole("triangle", 0, UINT32_MAX)),
                      place.flag("face")});
    place.check_all_read();
  }
  return places;
}

/// A plane through a point, of the arguments `point_mm` and `normal`.
SectionPlane plane_of(CommandArguments& arguments) {
  const auto point = arguments.numbers("point_mm", 3);
  const auto normal = arguments.numbers("normal", 3);
  return section_plane({point[0], point[1], point[2]}, {normal[0], normal[1], normal[2]});
}

}  // namespace

std::string mesh_name(const SurfaceSnapshot& surface) {
  return mesh_name(surface.version, std::span(surface.steps).first(surface.done));
}

nlohmann::ordered_json Service::Implementation::start_measure(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const PickedQuantity quantity = arguments.named<PickedQuantity>("quantity");
  const std::vector<PickedPlace> places = places_of(arguments.value("places"));
  const std::string mesh = arguments.text("mesh");
  arguments.check_all_read();
  require(opened().measurements.size() < kMostMeasurements, kTooMany);
  return started("measure", [this, project, quantity, places, mesh](const Run& run) {
    const SurfaceModel& model =
        model_of(project, "there is no surface to measure; reconstruct it first", run);
    const SurfaceSnapshot& shown = *model.snapshot();
    require(mesh_name(shown) == mesh, "the surface has changed since; measure again");
    const PickedMeasurement found =
        measure_picked(model.mesh(), quantity, places, *shown.selection, run);
    keep_measurements(project, [&](std::vector<HandMeasurement>& all) {
      require(all.size() < kMostMeasurements, kTooMany);
      all.push_back(hand_measurement_of(found, free_label(all), mesh));
    });
  });
}

nlohmann::ordered_json Service::Implementation::remove_measurements(CommandArguments& arguments) {
  const nlohmann::json labels = arguments.value("labels");
  arguments.check_all_read();
  require(labels.is_array() && labels.size() <= kMostMeasurements &&
              std::all_of(
                  labels.begin(), labels.end(), [](const auto& one) { return one.is_string(); }),
          "labels: is a list of at most 500 labels");
  std::set<std::string> removed;
  for (const nlohmann::json& label : labels)
    removed.insert(label.get<std::string>());
  keep_measurements(folder(), [&](std::vector<HandMeasurement>& all) {
    std::erase_if(all, [&](const HandMeasurement& one) { return removed.contains(one.label); });
  });
  return Json::object();
}

void Service::Implementation::keep_measurements(
    const ProjectFolder& project, const std::function<void(std::vector<HandMeasurement>&)>& edit) {
  const std::lock_guard one_at_a_time(measurements_mutex_);
  std::vector<HandMeasurement> all = opened().measurements;
  edit(all);
  write_hand_measurements(project, all);
  change([&](OpenProject& now) { now.measurements.swap(all); });
}

std::string Service::Implementation::section(const std::string& plane_json) const {
  CommandArguments arguments(plane_json);
  const SectionPlane plane = plane_of(arguments);
  arguments.check_all_read();
  const SurfacePtr shown = surface();
  require(shown != nullptr, "there is no surface to cut; reconstruct it first");
  const auto curves = section_curves(shown->picture->mesh(), plane);
  const auto vector = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  double length = 0.0;
  std::string all;  // dozens of thousands of points: written at once, in tenths of a micrometre
  for (const SectionCurve& curve : curves) {
    length += length_mm(curve);
    all += fmt::format(R"({}{{"closed":{},"points_mm":[)",
                       all.empty() ? "" : ",",
                       curve.closed ? "true" : "false");
    for (std::size_t i = 0; i < curve.points_mm.size(); ++i) {
      all += fmt::format(
          "{}{:.4f},{:.4f}", i == 0 ? "" : ",", curve.points_mm[i].x(), curve.points_mm[i].y());
    }
    all += "]}";
  }
  const Json json{{"mesh_revision", shown->mesh_revision},
                  {"origin_mm", vector(plane.point_mm)},
                  {"u", vector(plane.u)},
                  {"v", vector(plane.v)},
                  {"length_mm", length},
                  {"area_mm2", area_mm2(curves)}};  // NaN is written as null
  std::string text = json.dump();
  text.pop_back();
  return text + R"(,"curves":[)" + all + "]}";
}

nlohmann::ordered_json Service::Implementation::start_export_section(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const std::string format = arguments.text("format");
  const SectionPlane plane = plane_of(arguments);
  arguments.check_all_read();
  require(format == "dxf" || format == "svg", "format: is dxf or svg");
  return started("export", [this, project, format, plane](const Run& run) {
    const SurfaceModel& model =
        model_of(project, "there is no surface to cut; reconstruct it first", run);
    SectionResult section;
    section.plane = plane;
    section.measured = section_curves(model.mesh(), plane);
    require(!section.measured.empty(),
            "the plane does not meet the surface; move it into the part");
    const std::string text = format == "dxf" ? dxf_of(section) : svg_of(section);
    const ExportOrigin origin{model.snapshot()->version, versions_of(project)->revision};
    const auto write = [&](const std::filesystem::path& path) { write_text_file(path, text); };
    put_export(project, project.name + " section." + format, origin, write, run);
  });
}

}  // namespace frangia
