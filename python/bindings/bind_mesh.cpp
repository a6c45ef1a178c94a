#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/angles.h"
#include "frangia/editor/edit_history.h"
#include "frangia/editor/edit_operation.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/simulate/parts.h"

#include "arrays.h"
#include "bindings.h"
#include "run_work.h"

namespace frangia::python {
namespace {

template <typename Number, typename Element>
void add_values(py::class_<Mesh>& bound,
                const char* name,
                std::vector<Element> Mesh::*member,
                const char* doc) {
  bound.def_property_readonly(
      name,
      [member](const py::object& self) {
        return view_of<Number>(self.cast<const Mesh&>().*member, self);
      },
      doc);
}

Mesh make_mesh(const py::object& vertices, const py::object& triangles) {
  Mesh mesh;
  mesh.vertices_mm = vector_of<float, Eigen::Vector3f>(vertices, "vertices");
  mesh.triangles = vector_of<std::uint32_t, Mesh::Triangle>(triangles, "triangles");
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh.vertices_mm.size()) {
        throw Error(ErrorKind::Input,
                    fmt::format("a triangle refers to vertex {} of {}; indices begin with 0",
                                corner,
                                mesh.vertices_mm.size()));
      }
    }
  }
  mesh.normals = vertex_normals(mesh);
  return mesh;
}

std::vector<EditStep> steps_of(const py::iterable& steps) {
  std::vector<EditStep> out;
  for (const py::handle step : steps) {
    if (py::isinstance<py::str>(step)) {
      out.push_back({step.cast<std::string>(), ""});
    } else {
      const auto pair = step.cast<std::pair<std::string, py::object>>();
      out.push_back({pair.first, py::str(pair.second).cast<std::string>()});
    }
    check_step(out.back());
  }
  return out;
}

Mesh edit(const Mesh& mesh, const py::iterable& steps, const py::object& progress) {
  const std::vector<EditStep> script = steps_of(steps);
  return result_of(progress, [&](const Run& run) {
    EditState state;
    state.mesh = mesh;
    for (const EditStep& step : script)
      apply_step(state, step, run);
    return std::move(state.mesh);
  });
}

py::dict compare(const Mesh& mesh, const Mesh& reference, const py::object& progress) {
  const SurfaceError error = result_of(progress, [&](const Run& run) {
    return surface_error(mesh, RayScene(reference, run), {}, run);
  });
  py::dict out;
  out["count"] = error.count;
  out["rms_mm"] = error.rms_mm;
  out["mean_mm"] = error.mean_mm;
  out["bias_mm"] = error.bias_mm;
  out["p95_mm"] = error.p95_mm;
  out["p99_mm"] = error.p99_mm;
  out["max_mm"] = error.max_mm;
  return out;
}

py::array_t<float> deviations(const Mesh& mesh, const Mesh& reference, const py::object& progress) {
  auto* values = new std::vector<float>(  // NOLINT(*-owning-memory) the capsule owns it
      result_of(progress, [&](const Run& run) {
        return vertex_errors_mm(mesh, RayScene(reference, run), run);
      }));
  const py::capsule owner(values,
                          [](void* held) { delete static_cast<std::vector<float>*>(held); });
  return view_of<float>(*values, owner);
}

py::array_t<std::uint8_t> render(const Mesh& mesh,
                                 int width_px,
                                 int height_px,
                                 double azimuth_deg,
                                 double elevation_deg,
                                 const py::object& values,
                                 const std::string& label) {
  RenderOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.azimuth_rad = rad_from_deg(azimuth_deg);
  options.elevation_rad = rad_from_deg(elevation_deg);
  options.vertex_colors = true;
  if (!values.is_none()) {
    options.values = vector_of<float, float>(values, "values");
    options.value_label = label;
    std::vector<float> known = options.values;
    std::erase_if(known, [](float value) { return std::isnan(value); });
    if (!known.empty()) {
      std::sort(known.begin(), known.end());
      options.value_min = known[known.size() / 100];
      options.value_max = known[known.size() - 1 - known.size() / 100];
    }
  }
  return array_of<std::uint8_t>(
      result_of(py::none(), [&](const Run& run) { return render_mesh(mesh, options, run); }));
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<Mesh> mesh(module, "Mesh", "A triangle mesh, object frame, mm.");
  mesh.def(py::init(&make_mesh),
           py::arg("vertices"),
           py::arg("triangles"),
           "Vertices N x 3 in mm; triangles M x 3, counter-clockwise seen from outside.")
      .def("render",
           &render,
           py::kw_only(),
           py::arg("width_px") = 800,
           py::arg("height_px") = 600,
           py::arg("azimuth_deg") = 35.0,
           py::arg("elevation_deg") = 20.0,
           py::arg("values") = py::none(),
           py::arg("label") = "",
           "A picture, height x width x 3 of uint8; with values, one per vertex, as colours with a "
           "scale.")
      .def("__repr__", [](const Mesh& self) {
        return fmt::format("<frangia.Mesh, {} vertices, {} triangles>",
                           self.vertices_mm.size(),
                           self.triangles.size());
      });
  add_values<float>(mesh, "vertices", &Mesh::vertices_mm, "Positions, N x 3, mm.");
  add_values<std::uint32_t>(mesh, "triangles", &Mesh::triangles, "Indices of vertices, M x 3.");
  add_values<float>(mesh, "normals", &Mesh::normals, "Unit vectors, N x 3; empty: none.");
  add_values<float>(mesh, "sigma_mm", &Mesh::sigma_mm, "Combined standard uncertainty; or empty.");
  add_values<float>(mesh, "sigma_noise_mm", &Mesh::sigma_noise_mm, "Its noise; empty: all of it.");
  add_values<float>(mesh, "sigma_systematic_mm", &Mesh::sigma_systematic_mm, "Or empty.");
  add_values<std::uint16_t>(
      mesh, "views", &Mesh::views, "Number of views of each vertex; or empty.");
  add_values<std::uint8_t>(mesh, "colors", &Mesh::colors, "Red, green, blue, N x 3; or empty.");
  add_values<std::uint8_t>(
      mesh, "vertex_marks", &Mesh::vertex_marks, "0 measured, 1 displaced, 2 made; empty: all 0.");
  add_values<std::uint8_t>(
      mesh, "triangle_marks", &Mesh::triangle_marks, "0 measured, 1 displaced, 2 made; or empty.");

  module.def(
      "read_mesh",
      [](const std::filesystem::path& path) {
        return result_of(py::none(), [&](const Run& run) { return read_mesh(path, run); });
      },
      py::arg("path"),
      "Reads DXF, STL, PLY, OBJ, glTF, 3MF, OFF, XYZ or PCD by the file's extension; mm.");
  module.def(
      "write_mesh",
      [](const std::filesystem::path& path, const Mesh& content) {
        run_work(py::none(), [&](const Run& run) { write_mesh(path, content, {}, run); });
      },
      py::arg("path"),
      py::arg("mesh"),
      "Writes a mesh; the extension chooses the format.");
  module.def("edit",
             &edit,
             py::arg("mesh"),
             py::arg("steps"),
             py::kw_only(),
             py::arg("progress") = py::none(),
             "Applies steps of `frangia edit`: names, or pairs of a name and a value, such as "
             "[('fill-holes', '10mm'), 'remove-spikes'].");
  module.def("surface_error",
             &compare,
             py::arg("mesh"),
             py::arg("reference"),
             py::kw_only(),
             py::arg("progress") = py::none(),
             "Statistics of the distances of the vertices from a reference in the same frame, mm.");
  module.def("deviations",
             &deviations,
             py::arg("mesh"),
             py::arg("reference"),
             py::kw_only(),
             py::arg("progress") = py::none(),
             "Signed distance of each vertex from a reference, mm, positive outside.");
  module.def(
      "make_part",
      [](const std::string& name) {
        return result_of(py::none(), [&](const Run& run) { return make_part(name, run); });
      },
      py::arg("name"),
      "A built-in part of the simulator: shaft, blade, bust, ball-bar, plate, bracket, groove, "
      "gear.");
}

}  // namespace frangia::python
