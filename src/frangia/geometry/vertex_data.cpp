#include "frangia/geometry/vertex_data.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/clean_mesh.h"

namespace frangia {
namespace {

std::uint32_t last_vertex(const Mesh& mesh) {
  return static_cast<std::uint32_t>(mesh.vertices_mm.size() - 1);
}

template <typename T>
void repeat(std::vector<T>& values, std::uint32_t which) {
  if (!values.empty()) values.push_back(T(values[which]));
}

/// Mean of some vertices' colors, weighted by one over the square of their distance from a point.
VertexColor color_from(const Mesh& mesh,
                       const Eigen::Vector3f& position_mm,
                       std::span<const std::uint32_t> around) {
  if (around.empty()) return kUnknownColor;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const std::uint32_t vertex : around) {
    const double square = (mesh.vertices_mm[vertex] - position_mm).cast<double>().squaredNorm();
    const double weight = 1.0 / std::max(square, 1e-30);
    const VertexColor& color = mesh.colors[vertex];
    sum += weight * Eigen::Vector3d(color[0], color[1], color[2]);
    weights += weight;
  }
  VertexColor mean{};
  for (std::size_t i = 0; i < mean.size(); ++i)
    mean.at(i) =
        static_cast<std::uint8_t>(std::lround(sum[static_cast<Eigen::Index>(i)] / weights));
  return mean;
}

/// Appends `more` to an attribute that one of two meshes may lack.
template <typename T>
void join(std::vector<T>& values, std::size_t count, const std::vector<T>& more, T missing) {
  if (values.empty() && more.empty()) return;
  values.resize(count, missing);
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

const std::vector<float>& noise_mm_of(const Mesh& mesh) {
  return mesh.sigma_noise_mm.empty() ? mesh.sigma_mm : mesh.sigma_noise_mm;
}

void ensure_sigma_parts(Mesh& mesh) {
  if (mesh.sigma_mm.empty() || !mesh.sigma_systematic_mm.empty()) return;
  mesh.sigma_noise_mm = mesh.sigma_mm;
  mesh.sigma_systematic_mm.assign(mesh.sigma_mm.size(), 0.0F);
}

void combine_sigma_parts(Mesh& mesh) {
  mesh.sigma_mm.resize(mesh.sigma_noise_mm.size());
  for (std::size_t i = 0; i < mesh.sigma_mm.size(); ++i)
    mesh.sigma_mm[i] = combined_sigma(mesh.sigma_noise_mm[i], mesh.sigma_systematic_mm[i]);
}

void discard_sigma(Mesh& mesh) {
  for (std::vector<float>* sigma :
       {&mesh.sigma_mm, &mesh.sigma_noise_mm, &mesh.sigma_systematic_mm})
    std::fill(sigma->begin(), sigma->end(), kMissing);
}

VertexColor mix_colors(const VertexColor& a, const VertexColor& b, float t) {
  VertexColor mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const float value = (1.0F - t) * static_cast<float>(a.at(i)) + t * static_cast<float>(b.at(i));
    mixed.at(i) = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
  }
  return mixed;
}

void ensure_marks(Mesh& mesh) {
  mesh.vertex_marks.resize(mesh.vertices_mm.size(), Mark::Measured);
  mesh.triangle_marks.resize(mesh.triangles.size(), Mark::Measured);
}

Mark mark_of(const Mesh& mesh, std::size_t triangle) {
  Mark mark = mesh.triangle_marks.empty() ? Mark::Measured : mesh.triangle_marks[triangle];
  if (mesh.vertex_marks.empty()) return mark;
  for (const std::uint32_t vertex : mesh.triangles[triangle])
    mark = std::max(mark, mesh.vertex_marks[vertex]);
  return mark;
}

std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t from) {
  repeat(mesh.vertices_mm, from);
  repeat(mesh.normals, from);
  repeat(mesh.sigma_mm, from);
  repeat(mesh.sigma_noise_mm, from);
  repeat(mesh.sigma_systematic_mm, from);
  repeat(mesh.views, from);
  repeat(mesh.colors, from);
  repeat(mesh.vertex_marks, from);
  return last_vertex(mesh);
}

std::uint32_t add_interpolated_vertex(Mesh& mesh, std::uint32_t a, std::uint32_t b, float t) {
  const std::uint32_t fresh = copy_vertex(mesh, t < 0.5F ? a : b);
  const auto mean = [&](const auto& values) { return (1.0F - t) * values[a] + t * values[b]; };
  mesh.vertices_mm[fresh] = mean(mesh.vertices_mm);
  if (!mesh.normals.empty()) {
    mesh.normals[fresh] = Eigen::Vector3f(mean(mesh.normals)).stableNormalized();
  }
  set_sigma(mesh, fresh, mean);
  if (!mesh.colors.empty()) mesh.colors[fresh] = mix_colors(mesh.colors[a], mesh.colors[b], t);
  if (!mesh.vertex_marks.empty()) {
    mesh.vertex_marks[fresh] = std::max(mesh.vertex_marks[a], mesh.vertex_marks[b]);
  }
  return fresh;
}

std::uint32_t add_synthesized_vertex(Mesh& mesh,
                                     const Eigen::Vector3f& position_mm,
                                     std::span<const std::uint32_t> around) {
  mesh.vertices_mm.push_back(position_mm);
  if (!mesh.normals.empty()) mesh.normals.emplace_back(Eigen::Vector3f::Zero());
  if (!mesh.views.empty()) mesh.views.push_back(0);
  if (!mesh.colors.empty()) mesh.colors.push_back(color_from(mesh, position_mm, around));
  if (!mesh.vertex_marks.empty()) mesh.vertex_marks.push_back(Mark::Synthesized);
  for (std::vector<float>* sigma :
       {&mesh.sigma_mm, &mesh.sigma_noise_mm, &mesh.sigma_systematic_mm})
    if (!sigma->empty()) sigma->push_back(kMissing);
  set_sigma(mesh, last_vertex(mesh), [&](const std::vector<float>& values) {
    float largest = around.empty() ? kMissing : 0.0F;
    for (const std::uint32_t vertex : around)
      largest = std::max(largest, values[vertex]);
    return largest;
  });
  return last_vertex(mesh);
}

void add_triangle(Mesh& mesh, const Mesh::Triangle& triangle, Mark mark) {
  if (mark != Mark::Measured) ensure_marks(mesh);
  mesh.triangles.push_back(triangle);
  if (!mesh.triangle_marks.empty()) mesh.triangle_marks.push_back(mark);
}

void keep_triangles(Mesh& mesh, std::span<const std::uint8_t> keep) {
  require(keep.size() == mesh.triangles.size(),
          "keep_triangles: there must be one flag for each triangle");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    if (!mesh.triangle_marks.empty()) mesh.triangle_marks[kept] = mesh.triangle_marks[i];
    mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  if (!mesh.triangle_marks.empty()) mesh.triangle_marks.resize(kept);
  remove_unused_vertices(mesh);
}

void append_mesh(Mesh& mesh, const Mesh& other) {
  const bool parts = !mesh.sigma_systematic_mm.empty();
  const bool other_parts = !other.sigma_systematic_mm.empty();
  if (!parts && other_parts) ensure_sigma_parts(mesh);
  if (parts && !other_parts && !other.sigma_mm.empty()) {
    Mesh split = other;
    ensure_sigma_parts(split);
    append_mesh(mesh, split);
    return;
  }
  const std::size_t vertices = mesh.vertices_mm.size();
  const std::size_t all = vertices + other.vertices_mm.size();
  require(all < 0xFFFFFFFFU, "append_mesh: more than 4 billion vertices; decimate first");
  join(mesh.normals, vertices, other.normals, Eigen::Vector3f(Eigen::Vector3f::Zero()));
  join(mesh.sigma_mm, vertices, other.sigma_mm, kMissing);
  join(mesh.sigma_noise_mm, vertices, other.sigma_noise_mm, kMissing);
  join(mesh.sigma_systematic_mm, vertices, other.sigma_systematic_mm, kMissing);
  join(mesh.views, vertices, other.views, std::uint16_t{0});
  join(mesh.colors, vertices, other.colors, VertexColor(kUnknownColor));
  join(mesh.vertex_marks, vertices, other.vertex_marks, Mark::Measured);
  join(mesh.triangle_marks, mesh.triangles.size(), other.triangle_marks, Mark::Measured);
  mesh.vertices_mm.insert(
      mesh.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  const auto shift = static_cast<std::uint32_t>(vertices);
  for (const Mesh::Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  if (!mesh.normals.empty()) mesh.normals.resize(all, Eigen::Vector3f::Zero());
  for (std::vector<float>* sigma :
       {&mesh.sigma_mm, &mesh.sigma_noise_mm, &mesh.sigma_systematic_mm})
    if (!sigma->empty()) sigma->resize(all, kMissing);
  if (!mesh.views.empty()) mesh.views.resize(all, 0);
  if (!mesh.colors.empty()) mesh.colors.resize(all, kUnknownColor);
  if (!mesh.vertex_marks.empty() || !mesh.triangle_marks.empty()) ensure_marks(mesh);
}

void mark_displaced(Mesh& mesh, std::span<const Eigen::Vector3f> before_mm) {
  constexpr float kStill = 1e-5F;  // of the size of the mesh: a vertex without sigma did not move
  constexpr float kRounding = 1e-8F;  // of the size of the mesh
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : before_mm)
    box.extend(vertex);
  const float size_mm = before_mm.empty() ? 0.0F : box.diagonal().norm();
  ensure_marks(mesh);
  for (std::size_t i = 0; i < before_mm.size(); ++i) {
    const float sigma = mesh.sigma_mm.empty() ? kMissing : mesh.sigma_mm[i];
    const float allowed =
        std::isfinite(sigma) ? std::max(sigma, kRounding * size_mm) : kStill * size_mm;
    const bool moved = (mesh.vertices_mm[i] - before_mm[i]).norm() > allowed;
    if (moved) mesh.vertex_marks[i] = std::max(mesh.vertex_marks[i], Mark::Displaced);
  }
}

void recompute_normals(Mesh& mesh) {
  if (!mesh.normals.empty()) mesh.normals = vertex_normals(mesh);
}

namespace {

double median_of_known(const std::vector<float>& sigmas) {
  std::vector<float> known;
  known.reserve(sigmas.size());
  for (const float sigma : sigmas)
    if (std::isfinite(sigma)) known.push_back(sigma);
  return known.empty() ? kMissing : static_cast<double>(median(std::move(known)));
}

}  // namespace

MedianSigma median_sigma(const Mesh& mesh) {
  return {median_of_known(mesh.sigma_mm),
          median_of_known(mesh.sigma_noise_mm),
          median_of_known(mesh.sigma_systematic_mm)};
}

}  // namespace frangia
