#include "frangia/reconstruct/internal/turntable_part.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

using Motion = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Row = Eigen::Matrix<double, 1, 6>;

/// Displacement of a point along a direction by a motion of 1 in each component.
Row row_of(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  Row row;
  row << point.cross(direction).transpose(), direction.transpose();
  return row;
}

/// The shares of the views in some vertices: a row for each view and a column for each vertex.
Eigen::MatrixXf weights_at(const FusedSurface& surface,
                           const std::vector<std::size_t>& vertices,
                           std::size_t views,
                           const Run& run) {
  constexpr std::size_t kChunk = 1024;
  Eigen::MatrixXf weights(static_cast<Eigen::Index>(views),
                          static_cast<Eigen::Index>(vertices.size()));
  interruptible_chunks(vertices.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      surface.weights.shares_at(surface.mesh.vertices_mm[vertices[i]],
                                surface.mesh.normals[vertices[i]],
                                weights.col(static_cast<Eigen::Index>(i)));
    }
  });
  return weights;
}

/// The motion of a vertex: the weighted mean of those of the views.
Motion mean_motion(const ViewMotions& motions,
                   const Eigen::MatrixXf& weights,
                   Eigen::Index column) {
  Motion mean = Motion::Zero(6, motions.front().cols());
  for (std::size_t view = 0; view < motions.size(); ++view) {
    const float weight = weights(static_cast<Eigen::Index>(view), column);
    if (weight > 0.0F) mean += static_cast<double>(weight) * motions[view];
  }
  return mean;
}

/// The rigid motions, one for each change, that fit those of some vertices along their normals.
Motion rigid_part(const Mesh& mesh,
                  const std::vector<std::size_t>& vertices,
                  const Eigen::MatrixXf& weights,
                  const ViewMotions& motions) {
  // Motions along the surface count, too, with a small weight: the normals of a prism do not
  // determine its motion along the axis, and their noise must not. More weight would move a round
  // part along its normals to follow views that turn it by as much as a few millimetres.
  constexpr double kAlong = kOpenMotion * kOpenMotion;
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Motion products = Motion::Zero(6, motions.front().cols());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (!(weights.col(column).sum() > 0.0F)) continue;
    const Row row = row_of(mesh.vertices_mm[vertices[i]].cast<double>(),
                           mesh.normals[vertices[i]].cast<double>());
    Eigen::Matrix<double, 6, 6> square = row.transpose() * row;
    for (int axis = 0; axis < 3; ++axis) {
      const Row along =
          row_of(mesh.vertices_mm[vertices[i]].cast<double>(), Eigen::Vector3d::Unit(axis));
      square += kAlong * along.transpose() * along;
    }
    squares += square;
    products += square * mean_motion(motions, weights, column);
  }
  if (!(squares(5, 5) > 0.0)) return Motion::Zero(6, motions.front().cols());
  return solve_symmetric_columns(squares, products);
}

std::vector<float> parts_of(const Mesh& mesh,
                            const std::vector<std::size_t>& vertices,
                            const Eigen::MatrixXf& weights,
                            const ViewMotions& motions,
                            const Motion& rigid) {
  std::vector<float> parts(vertices.size(), 0.0F);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (!(weights.col(column).sum() > 0.0F)) continue;
    const Row row = row_of(mesh.vertices_mm[vertices[i]].cast<double>(),
                           mesh.normals[vertices[i]].cast<double>());
    parts[i] = static_cast<float>((row * (mean_motion(motions, weights, column) - rigid)).norm());
  }
  return parts;
}

/// Whether the parts matter beside the sigma of the vertices.
bool matters(const Mesh& mesh,
             const std::vector<std::size_t>& vertices,
             const std::vector<float>& parts) {
  constexpr float kShare = 0.2F;  // 2 % of the combined value
  std::vector<float> shares;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const float sigma = mesh.sigma_mm[vertices[i]];
    if (sigma > 0.0F) shares.push_back(parts[i] / sigma);
  }
  if (shares.empty()) return false;
  const auto at = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() * 95 / 100);
  std::nth_element(shares.begin(), at, shares.end());
  return *at > kShare;
}

std::vector<std::size_t> every(std::size_t count, std::size_t step) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < count; i += step)
    numbers.push_back(i);
  return numbers;
}

/// Adds a part to the systematic part of a value.
void add_to(float& systematic, float more) {
  const float before = systematic;
  systematic = combined_sigma(before, more);
}

}  // namespace

bool add_turntable_part(FusedSurface& surface, const ViewMotions& motions, const Run& run) {
  Mesh& mesh = surface.mesh;
  constexpr std::size_t kSome = 2000;      // vertices that represent the part
  constexpr std::size_t kAtOnce = 200000;  // vertices whose weights are in memory
  const std::size_t count = mesh.vertices_mm.size();
  if (motions.empty() || count == 0 || mesh.sigma_mm.size() != count) return false;
  if (mesh.normals.size() != count) mesh.normals = vertex_normals(mesh);
  const std::vector<std::size_t> some = every(count, count / kSome + 1);
  const Eigen::MatrixXf weights = weights_at(surface, some, motions.size(), run);
  const Motion rigid = rigid_part(mesh, some, weights, motions);
  if (!matters(mesh, some, parts_of(mesh, some, weights, motions, rigid))) return false;
  ensure_sigma_parts(mesh);
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    std::vector<std::size_t> next = every(std::min(kAtOnce, count - first), 1);
    for (std::size_t& vertex : next)
      vertex += first;
    const std::vector<float> parts =
        parts_of(mesh, next, weights_at(surface, next, motions.size(), run), motions, rigid);
    for (std::size_t i = 0; i < next.size(); ++i)
      add_to(mesh.sigma_systematic_mm[next[i]], parts[i]);
  }
  combine_sigma_parts(mesh);
  return true;
}

void add_turntable_part(PointCloud& cloud,
                        const std::vector<CameraViews>& cameras,
                        const ViewMotions& motions,
                        const Run& run) {
  if (motions.empty()) return;
  // The mean motion of all points stands for the rigid one.
  struct Part {
    std::size_t view;
    std::size_t begin;
    std::size_t end;
    Eigen::Vector3d center;
  };
  std::vector<Part> views;
  std::size_t next = 0;
  for (const CameraViews& camera : cameras) {
    for (std::size_t view = 0; view < camera.views.size(); ++view) {
      run.check();
      const Image<float> depth = camera.views.load_depth_mm(view);
      const auto points = static_cast<std::size_t>(std::count_if(
          depth.pixels().begin(), depth.pixels().end(), [](float z) { return !std::isnan(z); }));
      const Eigen::Vector3d center = camera.views.rig_from_object(view).inverse().translation();
      views.push_back({view, next, next + points, center});
      next += points;
    }
  }
  if (next != cloud.points_mm.size() || next == 0) return;
  Motion mean = Motion::Zero(6, motions.front().cols());
  for (const Part& part : views) {
    mean +=
        static_cast<double>(part.end - part.begin) / static_cast<double>(next) * motions[part.view];
  }
  cloud.systematic_mm.resize(next);
  for (const Part& part : views) {
    const Motion motion = motions[part.view] - mean;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Eigen::Vector3d point = cloud.points_mm[i].cast<double>();
      const Eigen::Vector3d ray = (point - part.center).normalized();
      add_to(cloud.systematic_mm[i], static_cast<float>((row_of(point, ray) * motion).norm()));
    }
  }
}

ViewMotions motions_of_views(const MeasuredSetup& joined,
                             const Rig& rig,
                             const RegisterOptions& options,
                             const Run& run) {
  if (joined.registration) return joined.registration->motions;
  const std::vector<Station>& stations = joined.measured.stations;
  const bool one_setup = std::all_of(
      stations.begin(), stations.end(), [](const Station& station) { return station.setup == 0; });
  if (!rig.turntable || stations.size() < 2 || !one_setup) return {};
  RegistrationReport alone;
  alone.sigma = sigma_of(*rig.turntable, options, rig.turntable->point_mm.norm());
  run.warn("the views are not registered; " + alone.rig_alone_text());
  return motions_of_rig({*rig.turntable, stations}, alone.sigma);
}

}  // namespace frangia
