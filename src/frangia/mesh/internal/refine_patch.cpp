#include "frangia/mesh/internal/refine_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace frangia {

using Eigen::Vector3d;

namespace {

constexpr double kGrading = 0.2;       // growth of the coarse edge length per distance inwards
constexpr double kMaxTriangles = 2e6;  // of one patch; larger ones get coarser inwards
constexpr double kMaxExcess = 8.0;     // triangles, as a multiple of what the area requires
constexpr double kEquilateral = 0.4330127018922193;  // sqrt(3) / 4: area over squared edge length
constexpr int kMaxRounds = 40;  // edges halve each round: 40 is more than any patch needs

}  // namespace

PatchRefinement::PatchRefinement(PatchMesh& patch, std::vector<PatchSpacing> spacing)
    : patch_(patch), spacing_(std::move(spacing)) {}

bool PatchRefinement::refine_coarsely(const Run& run) {
  std::uint32_t begin = patch_.count() + 1;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (begin == patch_.count()) return true;
    run.check();
    begin = patch_.count();
    const std::uint32_t triangles = patch_.half_edges() / 3;
    for (std::uint32_t t = 0; t < triangles; ++t)
      split_if_large(t);
  }
  return false;
}

bool PatchRefinement::refine_finely(const PatchSurroundings& around,
                                    double curvature,
                                    const Run& run) {
  const double wanted = target_triangle_count();
  const double coarsening = std::max(1.0, std::sqrt(wanted / kMaxTriangles));
  const double max_triangles =
      kMaxExcess * std::min(wanted, kMaxTriangles) + 3.0 * patch_.half_edges();
  std::uint32_t begin = patch_.count() + 1;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (begin == patch_.count()) return true;
    run.check();
    begin = patch_.count();
    const std::vector<Vector3d> normals = normals_of(patch_, around);
    const std::uint32_t edges = patch_.half_edges();
    for (std::uint32_t edge = 0; edge < edges; ++edge)
      split_if_long(edge, {normals, coarsening, curvature});
    if (patch_.half_edges() / 3.0 > max_triangles) return false;
  }
  return false;
}

double PatchRefinement::target_edge_mm(const PatchSpacing& at) {
  return at.edge_mm + kGrading * at.from_boundary_mm;
}

void PatchRefinement::split_if_large(std::uint32_t triangle) {
  const std::array<std::uint32_t, 3> corners{
      patch_.from(3 * triangle), patch_.from(3 * triangle + 1), patch_.from(3 * triangle + 2)};
  Vector3d middle = Vector3d::Zero();
  for (const std::uint32_t corner : corners)
    middle += patch_.position(corner) / 3.0;
  PatchSpacing mean{0.0, std::numeric_limits<double>::infinity()};
  for (const std::uint32_t corner : corners) {
    const double away = (patch_.position(corner) - middle).norm();
    mean.edge_mm += spacing_[corner].edge_mm / 3.0;
    mean.from_boundary_mm =
        std::min(mean.from_boundary_mm, spacing_[corner].from_boundary_mm + away);
  }
  for (const std::uint32_t corner : corners) {
    const double away = std::sqrt(2.0) * (patch_.position(corner) - middle).norm();
    if (!(away > target_edge_mm(mean)) || !(away > target_edge_mm(spacing_[corner]))) return;
  }
  patch_.split_triangle(triangle, middle);
  spacing_.push_back(mean);
}

/// The number of triangles of the patch at the density around the boundary.
double PatchRefinement::target_triangle_count() const {
  double triangles = 0.0;
  for (std::uint32_t edge = 0; edge < patch_.half_edges(); edge += 3) {
    const Vector3d& a = patch_.position(patch_.from(edge));
    const Vector3d& b = patch_.position(patch_.from(edge + 1));
    const Vector3d& c = patch_.position(patch_.from(edge + 2));
    const double side = spacing_[patch_.from(edge)].edge_mm;
    triangles += 0.5 * (b - a).cross(c - a).norm() / (kEquilateral * side * side);
  }
  return triangles;
}

void PatchRefinement::split_if_long(std::uint32_t edge, const EdgeSplit& split) {
  constexpr double kLong = 1.4;  // about sqrt(2): the halves are too short by the same factor
  const std::vector<Vector3d>& normals = split.normals;
  const std::uint32_t a = patch_.from(edge);
  const std::uint32_t b = patch_.to(edge);
  if (patch_.twin(edge) == PatchMesh::kBoundary || a >= normals.size() || b >= normals.size())
    return;
  const Vector3d way = patch_.position(b) - patch_.position(a);
  const double length = way.norm();
  const PatchSpacing mean{0.5 * (spacing_[a].edge_mm + spacing_[b].edge_mm),
                          0.5 * (spacing_[a].from_boundary_mm + spacing_[b].from_boundary_mm)};
  const double allowed = std::min(split.coarsening * mean.edge_mm, target_edge_mm(mean));
  if (!(length > kLong * allowed)) return;
  const Vector3d leaving = way - normals[a] * normals[a].dot(way);
  const Vector3d arriving = way - normals[b] * normals[b].dot(way);
  Vector3d bulge = split.curvature * (leaving - arriving) / 8.0;
  constexpr double kMaxBulge = 0.15;  // of the edge: an arc of 67 degrees
  if (bulge.norm() > kMaxBulge * length) bulge *= kMaxBulge * length / bulge.norm();
  patch_.split_edge(edge, patch_.position(a) + 0.5 * way + bulge);
  spacing_.push_back(mean);
}

}  // namespace frangia
