#include "frangia/inspect/internal/patch_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia::inspect {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kAlong = 0.866F;   // cosine of 30 degrees, as of DeviationStatus::SharpEdge
constexpr float kSquare = 0.999F;  // cosine: a point below its foot, as of ReferenceEdge

/// A measured point: a vertex, or a part of a triangle that is larger than a patch.
struct MeasuredPoint {
  Vector3f foot;    ///< on the nominal surface
  Vector3f normal;  ///< of the nominal surface there
  double deviation_mm = 0.0;
  PointSigma sigma;
};

}  // namespace

/// Finds the points of a mesh for a filter.
class PointFinder {
 public:
  PointFinder(const Mesh& mesh,
              const Deviations& deviations,
              const RayScene& reference,
              const PatchGrid& grid,
              const SurfacePatches& patches,
              const EdgeStrips& strips,
              const Run& run,
              PatchFilter& out)
      : mesh_(mesh),
        deviations_(deviations),
        reference_(reference),
        grid_(grid),
        patches_(patches),
        strips_(strips),
        normals_(vertex_normals(mesh)),
        reference_boundary_(boundary_flags(reference.mesh())),
        run_(run),
        out_(out) {}

  void add_all() {
    find_most_noise();
    find_most_parts();
    std::vector<double> thirds(mesh_.vertices_mm.size(), 0.0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      add_triangle(t, thirds);
    for (std::uint32_t v = 0; v < thirds.size(); ++v) {
      if (!(thirds[v] > 0.0)) continue;
      add({deviations_.foot_mm[v],
           facing(v),
           static_cast<double>(deviations_.deviation_mm[v]),
           sigma_of(v)},
          thirds[v]);
    }
  }

 private:
  [[nodiscard]] bool is_compared(std::uint32_t vertex) const {
    return deviations_.status[vertex] == DeviationStatus::Compared;
  }

  [[nodiscard]] static float longest_edge(const std::array<Vector3f, 3>& at) {
    return std::max({(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()});
  }

  [[nodiscard]] std::array<Vector3f, 3> corners(std::size_t triangle) const {
    std::array<Vector3f, 3> at;
    for (std::size_t i = 0; i < 3; ++i)
      at.at(i) = mesh_.vertices_mm[mesh_.triangles[triangle].at(i)];
    return at;
  }

  /// Shares a bounded number of parts among the triangles that are larger than a patch: damaged
  /// coordinates make them as many as the mesh has, and of any size.
  void find_most_parts() {
    constexpr double kParts = 2e6;  // each takes some 40 bytes
    double large = 0.0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      large += static_cast<double>(longest_edge(corners(t))) > patches_.diameter_mm ? 1.0 : 0.0;
    most_parts_ = std::max(1.0, std::sqrt(kParts / std::max(1.0, large)));
  }

  /// What makes a vertex much noisier than most has to do with its place, as an edge or the end of
  /// the data, and errors of neighbors there are alike: the rest is not averaged.
  void find_most_noise() {
    constexpr double kOfTypical = 3.0;
    if (deviations_.u_mm.empty()) return;
    const auto& noises = mesh_.sigma_noise_mm.empty() ? mesh_.sigma_mm : mesh_.sigma_noise_mm;
    std::vector<float> known;
    for (std::uint32_t v = 0; v < noises.size(); ++v)
      if (is_compared(v) && std::isfinite(noises[v])) known.push_back(noises[v]);
    if (!known.empty())
      most_noise_mm_ = kOfTypical * static_cast<double>(median_in_place(std::span<float>(known)));
  }
  /// The parts of the uncertainty of a deviation, that of a vertex which was not compared, too; 0
  /// where none is known.
  [[nodiscard]] PointSigma sigma_of(std::uint32_t vertex) const {
    if (deviations_.u_mm.empty()) return {};
    const auto& noises = mesh_.sigma_noise_mm.empty() ? mesh_.sigma_mm : mesh_.sigma_noise_mm;
    const double u = is_compared(vertex) ? static_cast<double>(deviations_.u_mm[vertex])
                                         : std::hypot(static_cast<double>(mesh_.sigma_mm[vertex]),
                                                      deviations_.largest_pose_u_mm,
                                                      deviations_.largest_temperature_u_mm);
    const double all = std::min(u, static_cast<double>(noises[vertex]));
    const double noise = std::min(all, most_noise_mm_);
    const auto rest = [](double whole, double part) {
      return std::sqrt(std::max(0.0, whole * whole - part * part));
    };
    return {noise, rest(all, noise), rest(u, all)};
  }

  /// Normal of the nominal surface at the foot of a vertex.
  [[nodiscard]] Vector3f facing(std::uint32_t vertex) const {
    const float deviation = deviations_.deviation_mm[vertex];
    if (static_cast<double>(std::abs(deviation)) < 1e-2 * patches_.diameter_mm)
      return normals_[vertex];
    return ((mesh_.vertices_mm[vertex] - deviations_.foot_mm[vertex]) / deviation).normalized();
  }

  void add_triangle(std::size_t number, std::vector<double>& thirds) {
    const Mesh::Triangle& triangle = mesh_.triangles[number];
    const std::array<Vector3f, 3> at = corners(number);
    const Vector3f cross = (at[1] - at[0]).cross(at[2] - at[0]);
    const auto area = 0.5 * static_cast<double>(cross.norm());
    const float longest = longest_edge(at);
    const double step = patches_.diameter_mm;
    if (static_cast<double>(longest) <= step) {
      for (const std::uint32_t v : triangle)
        if (is_compared(v)) thirds[v] += area / 3.0;
      return;
    }
    if (mark_of(mesh_, number) == Mark::Synthesized || !(area > 0.0)) return;
    const int parts = static_cast<int>(
        std::min(most_parts_, std::ceil(2.0 * static_cast<double>(longest) / step)));
    const double share = area / (static_cast<double>(parts) * parts);
    const Vector3f normal = cross.normalized();
    for (int i = 0; i < parts; ++i) {
      run_.check();
      for (int j = 0; j < parts - i; ++j) {
        add_part(triangle, normal, (i + 1.0 / 3.0) / parts, (j + 1.0 / 3.0) / parts, share);
        if (j + 1 < parts - i)
          add_part(triangle, normal, (i + 2.0 / 3.0) / parts, (j + 2.0 / 3.0) / parts, share);
      }
    }
  }

  /// A part of a triangle is compared by itself: its corners may lie at edges, which are not.
  void add_part(
      const Mesh::Triangle& triangle, const Vector3f& normal, double b, double c, double area) {
    const std::array<double, 3> weights{1.0 - b - c, b, c};
    Vector3d at = Vector3d::Zero();
    PointSigma sigma;
    for (std::size_t i = 0; i < 3; ++i) {
      at += weights.at(i) * mesh_.vertices_mm[triangle.at(i)].cast<double>();
      const PointSigma corner = sigma_of(triangle.at(i));
      sigma.noise_mm += weights.at(i) * corner.noise_mm;
      sigma.place_mm += weights.at(i) * corner.place_mm;
      sigma.systematic_mm += weights.at(i) * corner.systematic_mm;
    }
    const auto near = reference_.nearest(at);
    if (!near) return;
    const Vector3f nominal = normal_of(near->triangle);
    // A triangle that turns farther rounds an edge, and does not measure the face below it.
    if (nominal.dot(normal) < kAlong) return;
    const double deviation = near->signed_distance_mm;
    const bool apart = std::abs(deviation) > 1e-2 * patches_.diameter_mm;
    const Vector3f facing =
        apart ? ((at - near->point_mm) / deviation).cast<float>().normalized() : nominal;
    if (apart && facing.dot(nominal) < kSquare && is_at_boundary(near->triangle)) return;
    add({near->point_mm.cast<float>(), facing, deviation, sigma}, area);
  }

  [[nodiscard]] Vector3f normal_of(std::uint32_t triangle) const {
    const auto& [a, b, c] = reference_.mesh().triangles[triangle];
    const auto& at = reference_.mesh().vertices_mm;
    return (at[b] - at[a]).cross(at[c] - at[a]).normalized();
  }

  /// Whether a triangle of the reference is where it ends: what lies beyond has its foot there.
  [[nodiscard]] bool is_at_boundary(std::uint32_t triangle) const {
    const auto& corners = reference_.mesh().triangles[triangle];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return reference_boundary_[v] != 0;
    });
  }

  void add(const MeasuredPoint& point, double area) {
    const auto number = static_cast<std::uint32_t>(out_.points_.size());
    out_.points_.push_back({point.deviation_mm, point.sigma});
    const bool in_strip = strips_.hold(point.foot, point.normal);
    grid_.within(point.foot, 0.5 * patches_.diameter_mm, [&](std::uint32_t patch, float) {
      if (in_strip && patches_.at_edge[patch] == 0) return;
      if (point.normal.dot(patches_.normal[patch]) >= kSameFace)
        out_.points_of_[patch].emplace_back(number, area);
    });
  }

  const Mesh& mesh_;
  const Deviations& deviations_;
  const RayScene& reference_;
  const PatchGrid& grid_;
  const SurfacePatches& patches_;
  const EdgeStrips& strips_;
  std::vector<Vector3f> normals_;
  std::vector<std::uint8_t> reference_boundary_;
  double most_noise_mm_ = std::numeric_limits<double>::infinity();
  const Run& run_;
  double most_parts_ = 1.0;  ///< of a triangle, along an edge
  PatchFilter& out_;
};

PatchFilter::PatchFilter(const Mesh& mesh,
                         const Deviations& deviations,
                         const RayScene& reference,
                         const PatchGrid& grid,
                         const SurfacePatches& patches,
                         const EdgeStrips& strips,
                         const Run& run)
    : points_of_(patches.size()) {
  PointFinder(mesh, deviations, reference, grid, patches, strips, run, *this).add_all();
}

std::pair<PatchMean, double> PatchFilter::average(std::size_t patch) const {
  const auto u_of = [&](std::uint32_t point) {
    const PointSigma& sigma = points_[point].sigma;
    return std::hypot(sigma.noise_mm, sigma.place_mm, sigma.systematic_mm);
  };
  std::vector<double> known;
  for (const auto& [point, area] : points_of_[patch])
    if (std::isfinite(u_of(point))) known.push_back(u_of(point));
  const double typical_mm = known.empty() ? kMissing : median_in_place(std::span<double>(known));
  PatchMean mean;
  double total = 0.0;
  double squares = 0.0;
  double weights_squared = 0.0;
  double deviations_squared = 0.0;
  for (const auto& [point, area] : points_of_[patch]) {
    const Point& one = points_[point];
    const double u = u_of(point);
    if (std::isnan(u) && !known.empty()) continue;
    const double weight = u > typical_mm ? area * typical_mm * typical_mm / (u * u) : area;
    total += weight;
    mean.deviation_mm += weight * one.deviation_mm;
    squares += weight * weight * one.sigma.noise_mm * one.sigma.noise_mm;
    weights_squared += weight * weight;
    deviations_squared += weight * one.deviation_mm * one.deviation_mm;
    mean.one_point_mm += weight * one.sigma.noise_mm;
    mean.place_mm += weight * one.sigma.place_mm;
    mean.systematic_mm += weight * one.sigma.systematic_mm;
  }
  for (double* sum : {&mean.deviation_mm, &mean.one_point_mm, &mean.place_mm, &mean.systematic_mm})
    *sum /= total;
  mean.noise_mm = std::sqrt(squares) / total;
  mean.scatter_mm2 =
      std::max(0.0, deviations_squared / total - mean.deviation_mm * mean.deviation_mm);
  mean.point_share = weights_squared / (total * total);
  return {mean, total};
}

}  // namespace frangia::inspect
