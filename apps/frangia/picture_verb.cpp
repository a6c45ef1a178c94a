#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/read_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspect/contact_sheet.h"
#include "frangia/inspect/render_mesh.h"

#include "allow_memory.h"
#include "option_values.h"
#include "picture_file.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

struct PictureArguments {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path output;
  double azimuth_deg = 35.0;
  double elevation_deg = 20.0;
  RenderOptions shade;
  ReadOptions read;
  std::string up = "z";
  std::string color = "auto";
};

/// The rotation that turns the direction `text`, such as "y", "-x" or "0,1,0.2", to z.
Eigen::Isometry3d upright(const std::string& text) {
  const bool negative = text.starts_with('-');
  const std::string axis = negative ? text.substr(1) : text;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  if (axis == "x" || axis == "y" || axis == "z") {
    up[axis.front() - 'x'] = negative ? -1.0 : 1.0;
  } else {
    std::istringstream words(text);
    char comma = ',';
    words >> up.x() >> comma >> up.y() >> comma >> up.z();
    const bool complete = !words.fail() && (words >> std::ws).eof() && comma == ',';
    if (!complete) up.setZero();
  }
  if (!up.allFinite() || !(up.norm() > 0.0)) {
    throw Error(ErrorKind::Input,
                fmt::format("`up` is \"{}\"; it must be x, y, z, -x, -y, -z or three numbers such "
                            "as 0,1,0",
                            text));
  }
  return Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()));
}

void draw(PictureArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  check_picture_output(arguments.output);
  arguments.shade.azimuth_rad = rad_from_deg(arguments.azimuth_deg);
  arguments.shade.elevation_rad = rad_from_deg(arguments.elevation_deg);
  std::vector<Image<Rgb>> pictures;
  for (const auto& path : arguments.meshes) {
    run.stage(path.filename().string());
    const Mesh mesh =
        transform_mesh(read_surface(path, run, arguments.read), upright(arguments.up));
    if (arguments.color == "vertex" && mesh.colors.empty()) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{}: its vertices have no colors; set `color` to plain", path.string()));
    }
    arguments.shade.vertex_colors =
        arguments.color == "vertex" || (arguments.color == "auto" && !arguments.shade.show_marks);
    pictures.push_back(render_mesh(mesh, arguments.shade, run));
  }
  if (pictures.size() == 1) {
    write_png(arguments.output, pictures.front());
  } else {
    write_png(arguments.output, contact_sheet({pictures}, arguments.shade.height_px));
  }
  if (terminal.json) {
    print_json({{"picture", arguments.output.string()},
                {"meshes", pictures.size()},
                {"warnings", terminal.warnings()}});
  }
  terminal.print_written(arguments.output.string());
}

}  // namespace

void add_picture_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<PictureArguments>();
  CLI::App* verb = program.add_subcommand("picture", "draw meshes, side by side");
  verb->footer("example:\n  frangia picture bust.ply repaired.ply --marks -o both.png");
  verb->add_option("MESH", arguments->meshes, fmt::format("the meshes: {}", mesh_extensions()))
      ->required();
  verb->add_option("-o,--output", arguments->output, "the picture, a .png")->required();
  const auto size = [&](const char* name, int& value, const char* help) {
    verb->add_option(name, value, help)->check(from_to(16, 16'384))->capture_default_str();
  };
  size("--width", arguments->shade.width_px, "of each mesh, without its legend, pixels");
  size("--height", arguments->shade.height_px, "pixels");
  verb->add_option("--azimuth",
                   arguments->azimuth_deg,
                   "direction of the viewer about z, degrees from x to y")
      ->capture_default_str();
  verb->add_option("--elevation",
                   arguments->elevation_deg,
                   "direction of the viewer above the ground, degrees")
      ->check(from_to(-90.0, 90.0))
      ->capture_default_str();
  verb->add_option("--up",
                   arguments->up,
                   "direction that points up: x, y, z, -x, -y, -z or three numbers such as 0,1,0")
      ->capture_default_str();
  verb->add_flag("--edges", arguments->shade.show_edges, "draw the edges of the triangles");
  verb->add_flag("--marks",
                 arguments->shade.show_marks,
                 "color what was displaced yellow, what was synthesized blue");
  verb->add_option("--color",
                   arguments->color,
                   "color of the surface: auto (that of the vertices if they have any), vertex or "
                   "plain")
      ->check(one_of({"auto", "vertex", "plain"}))
      ->capture_default_str();
  verb->add_flag("!--no-ground", arguments->shade.ground, "leave out the shadow on the ground");
  verb->add_flag("!--no-legend", arguments->shade.legend, "leave out the meaning of the colors");
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { draw(*arguments, terminal); });
}

}  // namespace frangia
