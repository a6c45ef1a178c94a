#include "inspect_picture.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/frames/png.h"
#include "frangia/report/labelled_picture.h"

#include "usage.h"

namespace frangia {
namespace {

/// The values of the vertices that --show names.
std::vector<float> shown_values(const InspectArguments& arguments, const Mesh& mesh) {
  if (arguments.show == "sigma") return mesh.sigma_mm;
  return {mesh.views.begin(), mesh.views.end()};
}

}  // namespace

void check_shown(const InspectArguments& arguments,
                 const InspectionPlan& plan,
                 const std::filesystem::path& path,
                 const Mesh& mesh) {
  const std::string& show = arguments.show;
  if (show == "deviation") {
    require_usage(!plan.reference.empty(),
                  "--show deviation needs a --reference; give one, or choose another --show");
  }
  if (show == "thickness")
    require_usage(plan.thickness, "--show thickness needs --thickness; add it");
  const bool missing =
      (show == "sigma" && mesh.sigma_mm.empty()) || (show == "views" && mesh.views.empty()) ||
      (show == "marks" && mesh.vertex_marks.empty() && mesh.triangle_marks.empty());
  if (!missing) return;
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "{}: the file has no {}; choose another --show, such as shape", path.string(), show));
}

void draw_picture(const InspectArguments& arguments, const Inspection& part, const Run& run) {
  const Mesh& mesh = part.mesh;
  RenderOptions options;
  if (arguments.show == "deviation") {
    options = deviation_picture(mesh, part.surface.value(), arguments.scale_mm);
  } else if (arguments.show == "thickness") {
    options = thickness_picture(mesh, part.walls.value(), arguments.scale_mm);
  } else if (arguments.show == "marks") {
    options.show_marks = true;
  } else {
    options.values = shown_values(arguments, mesh);
    options.value_label = arguments.show == "sigma" ? "sigma, mm" : "views";
    options.value_max = arguments.scale_mm > 0.0 ? static_cast<float>(arguments.scale_mm) : 0.1F;
  }
  if (arguments.show == "shape") options.values.clear();
  if (arguments.show == "views") {
    options.value_max = *std::max_element(options.values.begin(), options.values.end());
    options.whole_values = true;
  }
  options.azimuth_rad = rad_from_deg(arguments.from_deg[0]);
  options.elevation_rad = rad_from_deg(arguments.from_deg[1]);
  options.legend = arguments.legend;
  options.width_px = arguments.width_px;
  options.height_px = arguments.height_px;
  run.stage("picture");
  write_png(arguments.picture, render_mesh(mesh, options, run));
}

}  // namespace frangia
