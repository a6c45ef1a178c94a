#include "frangia/fusion/color_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/srgb.h"

namespace frangia {
namespace {

/// Cosine of the largest angle between a vertex normal and the ray to the camera: pixels that see
/// the surface at a steeper angle are stretched over many vertices.
constexpr double kMinCosine = 0.1;

/// Distance from the edge of the measured area over which the weight of a view rises from 0, so
/// that no seam shows where a view ends; px.
constexpr int kRamp_px = 24;

/// A view sees a vertex if the depths of the pixels around it differ by less than this many pixel
/// sizes along the surface, plus as many standard deviations.
constexpr double kMaxDistance_px = 3.0;

using Eigen::Vector3d;
using Eigen::Vector4f;

constexpr std::size_t kVerticesPerChunk = 4096;

/// Distance of each measured pixel from the nearest one without a point or across a depth step, in
/// steps to one of the eight neighbours, up to `limit`. Two passes over the image.
Image<std::uint8_t> steps_from_edge(const Image<float>& depth_mm, float pixel_size, int limit) {
  constexpr float kStep_px = 10.0F;  // in depth, of neighbouring pixels of one surface
  const int width = depth_mm.width();
  const int height = depth_mm.height();
  const auto depth_at = [&](int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height ? std::nanf("") : depth_mm(x, y);
  };
  Image<std::uint8_t> steps(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float z = depth_mm(x, y);
      const float allowed = kStep_px * pixel_size * z;
      const bool inner = std::abs(depth_at(x - 1, y) - z) < allowed &&
                         std::abs(depth_at(x + 1, y) - z) < allowed &&
                         std::abs(depth_at(x, y - 1) - z) < allowed &&
                         std::abs(depth_at(x, y + 1) - z) < allowed;
      steps(x, y) = inner ? static_cast<std::uint8_t>(limit) : std::uint8_t{0};
    }
  });
  const auto lower = [&](int x, int y, int dx, int dy) {
    const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < width && y + dy < height;
    const int near = inside ? steps(x + dx, y + dy) : 0;
    steps(x, y) = static_cast<std::uint8_t>(std::min<int>(steps(x, y), near + 1));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const auto& [dx, dy] : {std::array{-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
        lower(x, y, dx, dy);
    }
  }
  for (int y = height - 1; y >= 0; --y) {
    for (int x = width - 1; x >= 0; --x) {
      for (const auto& [dx, dy] : {std::array{1, 0}, {1, 1}, {0, 1}, {-1, 1}})
        lower(x, y, dx, dy);
    }
  }
  return steps;
}

/// Light of each screen value.
std::array<float, 256> lights_of_screen_values() {
  std::array<float, 256> lights{};
  for (std::size_t i = 0; i < lights.size(); ++i)
    lights.at(i) = static_cast<float>(linear_from_srgb(static_cast<std::uint8_t>(i)));
  return lights;
}

/// One view with what blending needs of it.
class ColoredView {
 public:
  ColoredView(View view, const CameraModel& camera)
      : view_(std::move(view)),
        camera_(camera),
        pixel_size_(1.0 / camera.focal_px.mean()),
        steps_(steps_from_edge(view_.range.depth_mm, static_cast<float>(pixel_size_), kRamp_px)) {}

  /// Weighted light and weight with which the view contributes to a vertex; zero if it does not see
  /// it.
  [[nodiscard]] Vector4f sample(const Vector3d& vertex_mm, const Vector3d& normal) const {
    const Vector3d p = view_.rig_from_object * vertex_mm;
    if (!(p.z() > 0.0)) return Vector4f::Zero();
    const double cosine = -(view_.rig_from_object.linear() * normal).dot(p.normalized());
    if (!(cosine > kMinCosine)) return Vector4f::Zero();
    const Eigen::Vector2d pixel = camera_.project(p);
    const bool inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 &&
                        pixel.x() < view_.color.width() - 1.0 &&
                        pixel.y() < view_.color.height() - 1.0;
    if (!inside) return Vector4f::Zero();
    const int x = static_cast<int>(pixel.x());
    const int y = static_cast<int>(pixel.y());
    const auto fx = static_cast<float>(pixel.x() - x);
    const auto fy = static_cast<float>(pixel.y() - y);
    const std::array<float, 4> shares{
        (1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy, fx * fy};
    const auto allowed = static_cast<float>(kMaxDistance_px * pixel_size_ * p.z() / cosine);
    Vector4f sum = Vector4f::Zero();
    float ramp = 0.0F;
    for (int i = 0; i < 4; ++i) {
      const int column = x + (i & 1);
      const int row = y + (i >> 1);
      const float sigma = view_.range.sigma_mm(column, row);
      const float away = std::abs(view_.range.depth_mm(column, row) - static_cast<float>(p.z()));
      if (!(away <= allowed + static_cast<float>(kMaxDistance_px) * sigma))
        return Vector4f::Zero();  // also where the pixel has no point
      const float share = shares.at(static_cast<std::size_t>(i));
      sum += share * light_at(column, row);
      ramp += share * static_cast<float>(steps_(column, row));
    }
    const double nearness = cosine / p.z();
    constexpr float kLeast = 0.01F;  // at the edge itself, where no other view may see the vertex
    return static_cast<float>(nearness * nearness) * std::max(ramp, kLeast) * sum;
  }

 private:
  [[nodiscard]] Vector4f light_at(int x, int y) const {
    static const std::array<float, 256> kLights = lights_of_screen_values();
    const PixelColor& color = view_.color(x, y);
    return {kLights.at(color[0]), kLights.at(color[1]), kLights.at(color[2]), 1.0F};
  }

  View view_;
  const CameraModel& camera_;
  double pixel_size_;  ///< at unit distance
  Image<std::uint8_t> steps_;
};

/// Spreads colors over the triangles to vertices without one, from neighbour to neighbour.
void spread(const Mesh& mesh, std::vector<Vector4f>& sums) {
  const auto has_color = [&](std::uint32_t vertex) { return sums[vertex].w() > 0.0F; };
  std::vector<std::uint32_t> open;  // triangles with a corner that has no color
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (!has_color(a) || !has_color(b) || !has_color(c)) open.push_back(t);
  }
  std::vector<Vector4f> next(open.empty() ? 0 : sums.size(), Vector4f::Zero());
  std::vector<std::uint32_t> reached;
  while (!open.empty()) {
    reached.clear();
    for (const std::uint32_t t : open) {
      for (const std::uint32_t to : mesh.triangles[t]) {
        if (has_color(to)) continue;
        for (const std::uint32_t from : mesh.triangles[t]) {
          if (has_color(from)) next[to] += sums[from] / sums[from].w();
        }
        if (next[to].w() > 0.0F) reached.push_back(to);
      }
    }
    if (reached.empty()) return;
    for (const std::uint32_t vertex : reached)
      sums[vertex] = next[vertex];
    std::erase_if(open, [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return has_color(a) && has_color(b) && has_color(c);
    });
  }
}

/// Adds the weighted light of all views of one camera to each vertex.
void add_views(std::vector<Vector4f>& sums,
               const Mesh& mesh,
               const std::vector<Eigen::Vector3f>& normals,
               const CameraViews& all,
               const Run& run) {
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    run.check();
    View points = all.views.load_colored_points(i);
    if (points.color.empty()) continue;
    const ColoredView view(std::move(points), all.camera);
    parallel_chunks(sums.size(), kVerticesPerChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        sums[v] += view.sample(mesh.vertices_mm[v].cast<double>(), normals[v].cast<double>());
    });
  }
}

}  // namespace

void color_vertices(Mesh& mesh, std::span<const CameraViews> cameras, const Run& run) {
  const bool has_color = std::any_of(
      cameras.begin(), cameras.end(), [](const CameraViews& all) { return all.views.has_color(); });
  if (!has_color || mesh.vertices_mm.empty()) return;
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  std::vector<Vector4f> sums(mesh.vertices_mm.size(), Vector4f::Zero());
  for (const CameraViews& all : cameras)
    add_views(sums, mesh, normals, all, run);
  spread(mesh, sums);
  mesh.colors.assign(sums.size(), kUnknownColor);
  parallel_chunks(sums.size(), kVerticesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (!(sums[v].w() > 0.0F)) continue;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const float light = sums[v][static_cast<Eigen::Index>(channel)] / sums[v].w();
        mesh.colors[v].at(channel) = srgb_from_linear(static_cast<double>(light));
      }
    }
  });
}

void color_vertices(Mesh& mesh, const ViewStore& views, const CameraModel& camera, const Run& run) {
  const std::array<CameraViews, 1> one{{{views, camera}}};
  color_vertices(mesh, one, run);
}

}  // namespace frangia
