#include "frangia/service/display_level.h"

#include <algorithm>
#include <array>
#include <string>

#include <meshoptimizer.h>

#include "frangia/acquisition/with_display.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/read_file.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/array_packer.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/rig_history.h"

namespace frangia {
namespace {

constexpr std::size_t kCorners = 3;
constexpr std::uint32_t kUnused = 0xFFFFFFFF;
static_assert(sizeof(Eigen::Vector3f) == kCorners * sizeof(float));
static_assert(sizeof(Mesh::Triangle) == kCorners * sizeof(std::uint32_t));

/// Numbers the vertices that the triangles use, in the order of the mesh.
std::vector<std::uint32_t> renumber(std::vector<Mesh::Triangle>& triangles, std::size_t count) {
  std::vector<std::uint32_t> number(count, kUnused);
  for (const auto& triangle : triangles) {
    for (const std::uint32_t vertex : triangle)
      number[vertex] = 0;
  }
  std::vector<std::uint32_t> used;
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
    if (number[vertex] == kUnused) continue;
    number[vertex] = static_cast<std::uint32_t>(used.size());
    used.push_back(vertex);
  }
  for (auto& triangle : triangles) {
    for (std::uint32_t& vertex : triangle)
      vertex = number[vertex];
  }
  return used;
}

/// Marks of the triangles of a level from flags of the exact triangles: `values` has one for each,
/// and a corner takes the largest around it.
std::vector<std::uint8_t> shared_by_corners(const Mesh& mesh,
                                            const std::vector<std::uint8_t>& values,
                                            const DisplayLevel& level) {
  std::vector<std::uint8_t> around(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0) continue;
    for (const std::uint32_t vertex : mesh.triangles[i])
      around[vertex] = std::max(around[vertex], values[i]);
  }
  std::vector<std::uint8_t> shared(level.triangles.size());
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const auto& [a, b, c] = level.triangles[i];
    shared[i] =
        std::min({around[level.vertices[a]], around[level.vertices[b]], around[level.vertices[c]]});
  }
  return shared;
}

void add_vectors(ArrayPacker& packer,
                 const char* name,
                 const std::vector<Eigen::Vector3f>& vectors) {
  packer.add(
      name, "float32", reinterpret_cast<const float*>(vectors.data()), vectors.size() * kCorners);
}

}  // namespace

DisplayLevel display_level(const Mesh& mesh, std::size_t most, const Run& run) {
  DisplayLevel level;
  if (mesh.triangles.size() <= most) {
    level.exact = true;
    return level;
  }
  run.check();
  const auto* positions = reinterpret_cast<const float*>(mesh.vertices_mm.data());
  constexpr std::size_t kStride = sizeof(Eigen::Vector3f);
  constexpr float kAnyError = 1.0F;  // of the size of the mesh: the number of triangles decides
  float error = 0.0F;
  level.triangles.resize(mesh.triangles.size());
  const std::size_t indices = meshopt_simplify(level.triangles.front().data(),
                                               mesh.triangles.front().data(),
                                               mesh.triangles.size() * kCorners,
                                               positions,
                                               mesh.vertices_mm.size(),
                                               kStride,
                                               most * kCorners,
                                               kAnyError,
                                               0,
                                               &error);
  run.check();
  level.triangles.resize(indices / kCorners);
  level.error_mm = static_cast<double>(
      error * meshopt_simplifyScale(positions, mesh.vertices_mm.size(), kStride));
  level.vertices = renumber(level.triangles, mesh.vertices_mm.size());
  return level;
}

std::string encode_level(const Mesh& mesh,
                         const std::vector<Eigen::Vector3f>& normals,
                         const DisplayLevel& level,
                         int revision) {
  ArrayPacker packer;
  packer.set_values({{"revision", revision}, {"error_mm", level.error_mm}});
  const auto add_triangles = [&](const std::vector<Mesh::Triangle>& triangles) {
    packer.add("triangles",
               "uint32",
               reinterpret_cast<const std::uint32_t*>(triangles.data()),
               triangles.size() * kCorners);
  };
  if (level.exact) {
    add_vectors(packer, "positions", mesh.vertices_mm);
    add_vectors(packer, "normals", normals);
    add_triangles(mesh.triangles);
  } else {
    add_vectors(packer, "positions", values_of_level(mesh.vertices_mm, level));
    add_vectors(packer, "normals", values_of_level(normals, level));
    add_triangles(level.triangles);
  }
  if (!mesh.sigma_mm.empty()) {
    const auto sigma = values_of_level(mesh.sigma_mm, level);
    packer.add("sigma_mm", "float32", sigma.data(), sigma.size());
  }
  if (!mesh.views.empty()) {
    const auto views = values_of_level(mesh.views, level);
    packer.add("views", "uint16", views.data(), views.size());
  }
  if (!mesh.vertex_marks.empty() || !mesh.triangle_marks.empty()) {
    std::vector<std::uint8_t> marks(mesh.triangles.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
      marks[i] = static_cast<std::uint8_t>(mark_of(mesh, i));
    if (!level.exact) marks = shared_by_corners(mesh, marks, level);
    packer.add("marks", "uint8", marks.data(), marks.size());
  }
  return packer.pack();
}

Selection selection_of_level(const Mesh& mesh,
                             const Selection& selection,
                             const DisplayLevel& level) {
  if (level.exact || selection.empty()) return selection;
  return shared_by_corners(mesh, selection, level);
}

DisplayMeasurement measure_project_display(const ProjectFolder& project,
                                           const CaptureSettings& settings,
                                           const CaptureSetup& setup,
                                           const Run& run) {
  const Rig rig = read_rig(project.rig(), run, RigContent::StartValues);
  CaptureOptions options;
  options.camera = settings.camera;
  DisplayMeasurement found;
  {
    OpenedDevices opened(project.rig(), rig, setup.drivers(), setup, run);
    found = measure_display(opened.devices(), rig, options, run);
  }
  const std::string text = with_display(read_text_file(project.rig()), rig, found);
  keep_rig(project, RigChange::Display);
  write_text_file(project.rig(), text, Durability::Synced);
  return found;
}

}  // namespace frangia
