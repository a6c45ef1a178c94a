#include "frangia/inspect/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Why a vertex is left out before it is compared.
std::vector<DeviationStatus> initial_status(const Mesh& mesh) {
  std::vector<DeviationStatus> status;
  status.reserve(mesh.vertices_mm.size());
  for (const VertexUse use : vertex_uses(mesh)) {
    switch (use) {
      case VertexUse::Measured:
        status.push_back(DeviationStatus::Compared);
        break;
      case VertexUse::Synthesized:
        status.push_back(DeviationStatus::Synthesized);
        break;
      case VertexUse::MeshEdge:
        status.push_back(DeviationStatus::MeshEdge);
        break;
      case VertexUse::Unused:
        status.push_back(DeviationStatus::Unused);
        break;
    }
  }
  return status;
}

/// Finds deviations of points of one mesh, and keeps what all of them need.
class DeviationFinder {
 public:
  DeviationFinder(const Mesh& mesh, const RayScene& reference, const DeviationOptions& options)
      : mesh_(mesh),
        reference_(reference),
        options_(options),
        normals_(vertex_normals(mesh)),
        reference_boundary_(boundary_flags(reference.mesh())) {
    reference_is_open_ = std::find(reference_boundary_.begin(), reference_boundary_.end(), 1) !=
                         reference_boundary_.end();
    Eigen::AlignedBox3d box;
    for (const auto& vertex : mesh.vertices_mm)
      if (vertex.allFinite()) box.extend(vertex.cast<double>());
    center_ = box.center();
    Eigen::AlignedBox3d all = box;
    for (const auto& vertex : reference.mesh().vertices_mm)
      if (vertex.allFinite()) all.extend(vertex.cast<double>());
    size_mm_ = all.diagonal().norm();
  }

  /// Compares the vertices from `begin` to `end`. The foot of one bounds the search for the next.
  void compare(std::size_t begin, std::size_t end, Deviations& out) const {
    std::optional<NearestPoint> last;
    for (std::size_t i = begin; i < end; ++i) {
      if (out.status[i] != DeviationStatus::Compared) continue;
      const Vector3d point = mesh_.vertices_mm[i].cast<double>();
      const std::optional<NearestPoint> near = foot_of(point, last);
      if (!near) {
        out.status[i] = DeviationStatus::TooFar;
        continue;
      }
      last = near;
      const ExactPoint foot = exact_foot(point, *near);
      out.status[i] = status_of(i, point, foot);
      if (out.status[i] != DeviationStatus::Compared) continue;
      out.deviation_mm[i] = static_cast<float>(foot.signed_distance_mm);
      out.foot_mm[i] = foot.point_mm.cast<float>();
      if (!out.u_mm.empty()) out.u_mm[i] = static_cast<float>(uncertainty(i, point, foot));
    }
  }

  /// A measured edge is rounded or broken by the distance of its points, which no sigma states.
  void leave_out_sharp_edges(std::vector<DeviationStatus>& status) const {
    const auto sharp = sharp_edge_flags(mesh_, normals_);
    for (std::size_t i = 0; i < status.size(); ++i) {
      if (status[i] == DeviationStatus::Compared && sharp[i] != 0)
        status[i] = DeviationStatus::SharpEdge;
    }
  }

  [[nodiscard]] Vector3d normal(std::size_t vertex) const {
    return normals_[vertex].cast<double>();
  }

  [[nodiscard]] double temperature_u_mm(const Vector3d& point, const Vector3d& normal) const {
    return std::abs((point - center_).dot(normal)) * options_.expansion_per_k *
           options_.temperature_u_k;
  }

 private:
  [[nodiscard]] std::optional<NearestPoint> foot_of(const Vector3d& point,
                                                    const std::optional<NearestPoint>& last) const {
    double reach = options_.max_distance_mm;
    if (last) {
      const double bound = (point - last->point_mm).norm() * (1.0 + 1e-6) + 1e-6 * size_mm_;
      reach = std::min(reach, bound);
    }
    return reference_.nearest(point, reach);
  }

  [[nodiscard]] Vector3d reference_normal(std::uint32_t triangle) const {
    const auto& [a, b, c] = reference_.mesh().triangles[triangle];
    const auto& at = reference_.mesh().vertices_mm;
    const Vector3d p = at[a].cast<double>();
    return (at[b].cast<double>() - p).cross(at[c].cast<double>() - p).normalized();
  }

  /// The foot on the surface that the reference approximates, or on its triangles.
  [[nodiscard]] ExactPoint exact_foot(const Vector3d& point, const NearestPoint& near) const {
    if (options_.exact != nullptr) return options_.exact->nearest(point, near);
    return {.point_mm = near.point_mm,
            .normal = reference_normal(near.triangle),
            .distance_mm = near.distance_mm,
            .signed_distance_mm = near.signed_distance_mm,
            .on_boundary = reference_is_open_ && is_on_boundary(near)};
  }

  /// Whether a point of a triangle is on the boundary of the reference.
  [[nodiscard]] bool is_on_boundary(const NearestPoint& near) const {
    const auto& triangle = reference_.mesh().triangles[near.triangle];
    const double on = 1e-7 * size_mm_;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle.at(i);
      const std::uint32_t to = triangle.at((i + 1) % 3);
      if (reference_boundary_[from] == 0) continue;
      const Vector3d a = reference_.mesh().vertices_mm[from].cast<double>();
      if ((near.point_mm - a).norm() < on) return true;
      if (reference_boundary_[to] == 0) continue;
      const Vector3d way = reference_.mesh().vertices_mm[to].cast<double>() - a;
      const double along = (near.point_mm - a).dot(way) / way.squaredNorm();
      if ((near.point_mm - a - along * way).norm() < on) return true;
    }
    return false;
  }

  [[nodiscard]] DeviationStatus status_of(std::size_t vertex,
                                          const Vector3d& point,
                                          const ExactPoint& foot) const {
    if (foot.distance_mm > options_.max_distance_mm) return DeviationStatus::TooFar;
    const double height = std::abs((point - foot.point_mm).dot(foot.normal));
    constexpr double kSquare = 0.999;  // a foot on the boundary may still be below its point
    if (foot.on_boundary && height < kSquare * foot.distance_mm)
      return DeviationStatus::ReferenceEdge;
    // At an edge of the reference any normal between those of its faces is right.
    const bool inside_of_face =
        foot.distance_mm < 1e-9 * size_mm_ || height > kSquare * foot.distance_mm;
    const Vector3d own = normals_[vertex].cast<double>();
    if (inside_of_face && own.dot(foot.normal) < kLeastCosine) return DeviationStatus::OtherSide;
    return DeviationStatus::Compared;
  }

  [[nodiscard]] double uncertainty(std::size_t vertex,
                                   const Vector3d& point,
                                   const ExactPoint& foot) const {
    const Vector3d way = point - foot.point_mm;
    const bool apart = foot.distance_mm > 1e-6 * size_mm_;
    const Vector3d direction = apart ? Vector3d(way / foot.distance_mm) : foot.normal;
    const double own = static_cast<double>(mesh_.sigma_mm[vertex]);
    const double pose = options_.pose ? options_.pose->along(point, direction) : 0.0;
    const double temperature = temperature_u_mm(point, direction);
    return std::sqrt(own * own + pose * pose + temperature * temperature);
  }

  static constexpr double kLeastCosine = -0.2;
  const Mesh& mesh_;
  const RayScene& reference_;
  const DeviationOptions& options_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::uint8_t> reference_boundary_;
  bool reference_is_open_ = false;
  Vector3d center_ = Vector3d::Zero();
  double size_mm_ = 0.0;
};

}  // namespace

void DeviationOptions::check() const {
  require(max_distance_mm > 0.0, "DeviationOptions: max_distance_mm must be above 0");
  require(std::isfinite(expansion_per_k) && expansion_per_k >= 0.0,
          "DeviationOptions: expansion_per_k must be 0 or more");
  require(std::isfinite(temperature_u_k) && temperature_u_k >= 0.0,
          "DeviationOptions: temperature_u_k must be 0 or more");
}

Deviations deviations_of(const Mesh& mesh,
                         const RayScene& reference,
                         const DeviationOptions& options,
                         const Run& run) {
  options.check();
  require(!mesh.empty(), "the mesh has no triangles, only points; give a mesh with triangles");
  require(!reference.mesh().empty(),
          "the reference has no triangles, only points; give a mesh with triangles");
  run.stage("deviation");
  const std::size_t count = mesh.vertices_mm.size();
  Deviations found;
  found.deviation_mm.assign(count, kMissing);
  if (!mesh.sigma_mm.empty()) found.u_mm.assign(count, kMissing);
  found.status = initial_status(mesh);
  found.foot_mm.assign(count, Eigen::Vector3f::Constant(kMissing));
  const DeviationFinder finder(mesh, reference, options);
  if (!mesh.sigma_mm.empty()) finder.leave_out_sharp_edges(found.status);
  constexpr std::size_t kChunk = 4096;
  constexpr std::size_t kBlock = 64 * kChunk;  // between reports of progress
  for (std::size_t done = 0; done < count; done += kBlock) {
    const std::size_t size = std::min(kBlock, count - done);
    interruptible_chunks(size, kChunk, run, [&](std::size_t begin, std::size_t end) {
      finder.compare(done + begin, done + end, found);
    });
    run.report(static_cast<double>(done + size) / static_cast<double>(count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (found.status[i] != DeviationStatus::Compared) continue;
    const Vector3d point = mesh.vertices_mm[i].cast<double>();
    const Vector3d normal = finder.normal(i);
    if (options.pose) {
      const double pose_mm = options.pose->along(point, normal);  // NaN: nothing states it
      if (!(pose_mm <= found.largest_pose_u_mm)) found.largest_pose_u_mm = pose_mm;
    }
    found.largest_temperature_u_mm =
        std::max(found.largest_temperature_u_mm, finder.temperature_u_mm(point, normal));
  }
  return found;
}

namespace {

double u_of(const Deviations& deviations, std::size_t vertex) {
  return deviations.u_mm.empty() ? 0.0 : static_cast<double>(deviations.u_mm[vertex]);
}

}  // namespace

std::vector<Conformity> conformities(const Deviations& deviations, const ToleranceLimits& limits) {
  std::vector<Conformity> decided(deviations.status.size(), Conformity::Undecided);
  for (std::size_t i = 0; i < decided.size(); ++i) {
    if (deviations.status[i] != DeviationStatus::Compared) continue;
    decided[i] =
        conformity_of(static_cast<double>(deviations.deviation_mm[i]), u_of(deviations, i), limits);
  }
  return decided;
}

DeviationSummary summarize(const Mesh& mesh, const Deviations& deviations) {
  DeviationSummary summary;
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<float> known_u;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    ++summary.count.at(static_cast<std::size_t>(deviations.status[i]));
    if (deviations.status[i] != DeviationStatus::Compared) continue;
    const auto value = static_cast<double>(deviations.deviation_mm[i]);
    summary.area_mm2 += areas[i];
    sum += areas[i] * value;
    squares += areas[i] * value * value;
    if (!(summary.min_mm <= value)) {
      summary.min_mm = value;
      summary.min_at_mm = mesh.vertices_mm[i].cast<double>();
    }
    if (!(summary.max_mm >= value)) {
      summary.max_mm = value;
      summary.max_at_mm = mesh.vertices_mm[i].cast<double>();
    }
    if (!deviations.u_mm.empty() && std::isfinite(deviations.u_mm[i]))
      known_u.push_back(deviations.u_mm[i]);
  }
  if (summary.area_mm2 > 0.0) {
    summary.mean_mm = sum / summary.area_mm2;
    summary.rms_mm = std::sqrt(squares / summary.area_mm2);
  }
  if (!known_u.empty())
    summary.median_u_mm = static_cast<double>(median_in_place(std::span<float>(known_u)));
  return summary;
}

std::string left_out_text(const DeviationSummary& summary) {
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < kDeviationStatuses; ++i) {
    std::string name(name_of(static_cast<DeviationStatus>(i)));
    std::replace(name.begin(), name.end(), '_', ' ');
    if (summary.count.at(i) > 0) parts.push_back(fmt::format("{} {}", summary.count.at(i), name));
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<float> deviation_histogram(const Mesh& mesh,
                                       const std::vector<float>& deviation_mm,
                                       double low,
                                       double high,
                                       std::size_t bins) {
  require(bins > 0 && low < high, "a histogram needs intervals, and a lower end below the upper");
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<double> sums(bins, 0.0);
  double total = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const auto value = static_cast<double>(deviation_mm[i]);
    if (std::isnan(value)) continue;
    const double position = (value - low) / (high - low) * static_cast<double>(bins);
    const double inside = std::clamp(position, 0.0, static_cast<double>(bins) - 0.5);
    sums[static_cast<std::size_t>(inside)] += areas[i];
    total += areas[i];
  }
  std::vector<float> shares(bins, 0.0F);
  for (std::size_t i = 0; i < bins && total > 0.0; ++i)
    shares[i] = static_cast<float>(sums[i] / total);
  return shares;
}

}  // namespace frangia
