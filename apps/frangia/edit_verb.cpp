#include <charconv>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/mesh/boundary_loops.h"
#include "frangia/mesh/connected_parts.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remove_spikes.h"
#include "frangia/mesh/smooth.h"
#include "frangia/mesh/stitch.h"

#include "verbs.h"

namespace frangia {
namespace {

/// One operation with its number, as the command line has it.
struct Step {
  std::string name;
  std::string value;
};

struct Operation {
  const char* name;
  const char* unit;  ///< of its number: "mm", "" for a count, nullptr when it takes none
  const char* help;
  std::function<Mesh(Mesh, double, const Run&)> apply;
};

std::size_t count_from(double value) {
  return static_cast<std::size_t>(value);
}

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all{
      {"--make-manifold",
       nullptr,
       "part what is not manifold, drop broken and repeated triangles",
       [](Mesh m, double, const Run&) { return make_manifold(std::move(m)); }},
      {"--orient",
       nullptr,
       "wind neighbours alike and closed parts outwards",
       [](Mesh m, double, const Run&) { return orient(std::move(m)); }},
      {"--stitch",
       "mm",
       "join boundaries within this distance",
       [](Mesh m, double v, const Run&) { return stitch(std::move(m), v); }},
      {"--keep-largest",
       "",
       "keep so many parts of the largest area",
       [](Mesh m, double v, const Run&) {
         return keep_largest_parts(std::move(m), count_from(v));
       }},
      {"--remove-islands",
       "mm",
       "drop parts up to this size",
       [](Mesh m, double v, const Run&) { return remove_islands(std::move(m), v); }},
      {"--fill-holes",
       "mm",
       "close holes up to this size as the surface around them runs",
       [](Mesh m, double v, const Run& run) {
         return fill_holes(
             std::move(m), {.up_to_mm = v, .kind = HoleFill::Smooth, .only = {}}, run);
       }},
      {"--fill-holes-flat",
       "mm",
       "close holes up to this size with flat triangles",
       [](Mesh m, double v, const Run& run) {
         return fill_holes(std::move(m), {.up_to_mm = v, .kind = HoleFill::Flat, .only = {}}, run);
       }},
      {"--remove-spikes",
       nullptr,
       "set tips sharper than a cone of 60 degrees down",
       [](Mesh m, double, const Run& run) { return remove_spikes(std::move(m), {}, run); }},
      {"--smooth",
       "",
       "take away noise, in so many rounds",
       [](Mesh m, double v, const Run& run) {
         return smooth_taubin(std::move(m), {.iterations = static_cast<int>(v)}, run);
       }},
      {"--smooth-keeping-edges",
       "",
       "take away noise and keep edges, in so many rounds",
       [](Mesh m, double v, const Run& run) {
         KeepEdgesOptions options;
         options.smooth.iterations = static_cast<int>(v);
         return smooth_keeping_edges(std::move(m), options, run);
       }},
      {"--decimate",
       "mm",
       "as few triangles as stay within this distance everywhere",
       [](Mesh m, double v, const Run& run) {
         return decimate(std::move(m), {.triangles = 0, .tolerance_mm = v}, run);
       }},
      {"--decimate-to",
       "",
       "so many triangles",
       [](Mesh m, double v, const Run& run) {
         return decimate(std::move(m), {.triangles = count_from(v)}, run);
       }},
      {"--offset",
       "mm",
       "move the surface outwards",
       [](Mesh m, double v, const Run&) { return offset_mesh(std::move(m), v); }},
  };
  return all;
}

struct EditArguments {
  std::filesystem::path mesh;
  std::vector<std::filesystem::path> outputs;
  std::vector<Step> steps;
  bool list = false;
};

/// A number with its unit, or without one.
double number_of(const Step& step, const Operation& operation) {
  if (operation.unit == nullptr) return 0.0;
  const char* const end = step.value.data() + step.value.size();
  double number = 0.0;
  const auto parsed = std::from_chars(step.value.data(), end, number);
  const std::string rest(parsed.ptr, end);
  const bool fits = parsed.ec == std::errc() && (rest.empty() || rest == operation.unit);
  if (!fits || !(number >= 0.0 || step.name == "--offset") || number > 1e9) {
    throw Error(ErrorKind::Input,
                fmt::format("{} {}: give a number{}",
                            step.name,
                            step.value,
                            *operation.unit == 0 ? "" : " of mm, as in 10mm"));
  }
  return number;
}

const Operation& operation_of(const Step& step) {
  for (const Operation& operation : operations())
    if (step.name == operation.name) return operation;
  throw Error(ErrorKind::Input, fmt::format("there is no operation {}", step.name));
}

nlohmann::ordered_json findings(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  double volume = 0.0;
  double area = 0.0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[ia].cast<double>();
    const Eigen::Vector3d b = mesh.vertices_mm[ib].cast<double>();
    const Eigen::Vector3d c = mesh.vertices_mm[ic].cast<double>();
    box.extend(a).extend(b).extend(c);
    volume += a.dot(b.cross(c)) / 6.0;
    area += (b - a).cross(c - a).norm() / 2.0;
  }
  nlohmann::ordered_json json;
  json["vertices"] = mesh.vertices_mm.size();
  json["triangles"] = mesh.triangles.size();
  json["parts"] = nlohmann::ordered_json::array();
  for (const MeshPart& part : connected_parts(mesh).parts)
    json["parts"].push_back(
        {{"triangles", part.triangles}, {"size_mm", part.size_mm}, {"area_mm2", part.area_mm2}});
  json["holes"] = nlohmann::ordered_json::array();
  for (const BoundaryLoop& loop : boundary_loops(mesh))
    json["holes"].push_back(
        {{"edges", loop.edges.size()}, {"size_mm", loop.size_mm}, {"length_mm", loop.length_mm}});
  const std::size_t crowded = count_non_manifold_edges(mesh);
  json["non_manifold_edges"] = crowded;
  json["closed"] = json["holes"].empty() && crowded == 0 && !mesh.empty();
  json["area_mm2"] = area;
  json["volume_mm3"] = volume;
  if (!mesh.empty()) {
    json["low_mm"] = {box.min().x(), box.min().y(), box.min().z()};
    json["high_mm"] = {box.max().x(), box.max().y(), box.max().z()};
  }
  return json;
}

void print_findings(const nlohmann::ordered_json& json) {
  constexpr std::size_t kShown = 20;
  fmt::print("{} triangles, {} vertices, area {:.3f} mm2, volume {:.3f} mm3{}\n",
             json["triangles"].get<std::size_t>(),
             json["vertices"].get<std::size_t>(),
             json["area_mm2"].get<double>(),
             json["volume_mm3"].get<double>(),
             json["closed"].get<bool>() ? ", closed" : "");
  fmt::print("{} edges are not manifold\n", json["non_manifold_edges"].get<std::size_t>());
  for (const char* what : {"parts", "holes"}) {
    fmt::print("{} {}\n", json[what].size(), what);
    for (std::size_t i = 0; i < std::min(kShown, json[what].size()); ++i)
      fmt::print("  {:>3}: {}\n", i, json[what][i].dump());
  }
}

void edit(const EditArguments& arguments, Terminal& terminal) {
  for (const auto& path : arguments.outputs)
    check_mesh_ending(path);
  std::vector<std::pair<const Operation*, double>> plan;
  for (const Step& step : arguments.steps)
    plan.emplace_back(&operation_of(step), number_of(step, operation_of(step)));
  const Run run = terminal.run();
  run.stage("read");
  Mesh mesh = read_mesh(arguments.mesh);
  for (const auto& step : plan) {
    run.stage(step.first->name + 2);
    mesh = step.first->apply(std::move(mesh), step.second, run);
  }
  run.stage("write");
  for (const auto& path : arguments.outputs)
    write_mesh(path, mesh);
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = findings(mesh);
    for (const auto& stage : terminal.stage_seconds())
      json["seconds"][stage.first] = stage.second;
    fmt::print("{}\n", json.dump(2));
  } else if (arguments.list) {
    print_findings(findings(mesh));
  } else if (!terminal.quiet) {
    fmt::print("{} triangles\n", mesh.triangles.size());
  }
}

void add_operations(CLI::App& verb, EditArguments& arguments) {
  for (const Operation& operation : operations()) {
    const std::string name = operation.name;
    if (operation.unit == nullptr) {
      verb.add_flag_callback(
              name,
              [&arguments, name] {
                arguments.steps.push_back({name, ""});
              },
              operation.help)
          ->trigger_on_parse();
    } else {
      verb.add_option_function<std::string>(
              name,
              [&arguments, name](const std::string& value) {
                arguments.steps.push_back({name, value});
              },
              operation.help)
          ->trigger_on_parse();
    }
  }
}

}  // namespace

void add_edit_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<EditArguments>();
  CLI::App* verb = program.add_subcommand("edit", "repair and change a mesh, in the order given");
  verb->footer(
      "example:\n  frangia edit bust.ply --remove-islands 2mm --fill-holes 10mm --decimate 0.01mm "
      "-o bust.dxf");
  verb->add_option("MESH", arguments->mesh, "the mesh: .ply, .stl or .obj")->required();
  verb->add_option("-o,--output", arguments->outputs, "where to write it: .dxf, .stl, .ply or .obj")
      ->allow_extra_args(false);
  verb->add_flag("--list", arguments->list, "show parts, holes, area and volume of the result");
  add_operations(*verb, *arguments);
  verb->callback([arguments, &terminal] { edit(*arguments, terminal); });
}

}  // namespace frangia
