#include "frangia/registration/pose_contradictions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/compare_groups.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

/// Sides of a patch, in spacings: a fiftieth of the part.
constexpr double kPatch = 1.0;
/// Distance of the points that are counted, in spacings: some ten make a patch.
constexpr double kDense = 0.3;
constexpr std::size_t kSamplesPerChunk = 256;

/// Of a point that contradicts, and at most: beyond five standard deviations it does not matter how
/// far off it is.
constexpr double kLargestMisfit = 25.0;
constexpr double kNothingThere = -1.0;

/// Square of the distance of a point from the surface that a group measured, over its variance: of
/// the view that it agrees with best.
///
/// @missing  `kNothingThere` where no view measured anything there, or something in front of it
double misfit_of(const ViewGroup& group,
                 const Eigen::Vector3d& point,
                 const Eigen::Vector3d& facing,
                 const GroupViews& views,
                 double sigma_mm,
                 double gate_mm) {
  double least = kNothingThere;
  for (const ViewGroup::Member& member : group.members) {
    const Eigen::Vector3d seen = member.rig_from_group * point;
    const Eigen::Vector3d towards = member.rig_from_group.linear() * facing;
    if (towards.dot(seen) >= 0.0) continue;
    const SurfelMap::Surfel* surfel = surfel_at(views.maps[member.view], views.model, seen);
    if (surfel == nullptr) continue;
    const SurfelPair pair(seen, towards, *surfel);
    const double variance =
        std::max(sigma_mm * sigma_mm, 2.0 * std::pow(static_cast<double>(surfel->sigma_mm), 2));
    const double distance_mm = pair.distance_mm();
    double misfit = kNothingThere;
    if (pair.faces_alike() && std::abs(distance_mm) < gate_mm) {
      misfit = std::min(kLargestMisfit, distance_mm * distance_mm / variance);
    } else if (pair.violates_free_space(std::sqrt(kLargestMisfit * variance))) {
      misfit = kLargestMisfit;
    }
    if (misfit != kNothingThere && (least == kNothingThere || misfit < least)) least = misfit;
  }
  return least;
}

}  // namespace

double log_odds_of(const PatchCount& one, const PatchCount& other) {
  constexpr double kClusters = 2.0;  // patches that are not independent of each other
  const auto a = static_cast<double>(one.contradicting);
  const auto b = static_cast<double>(other.contradicting);
  return (b - a) * std::abs(b - a) / (2.0 * kClusters * (a + b + kClusters));
}

PoseContradictions::PoseContradictions(const ViewGroup& to,
                                       const ViewGroup& from,
                                       const GroupViews& views,
                                       double spacing_mm,
                                       const Eigen::Isometry3d& near)
    : to_(to),
      from_(from),
      views_(views),
      spacing_mm_(spacing_mm),
      of_to_(samples_of(to, views, spacing_mm)),
      of_from_(samples_of(from, views, spacing_mm)) {
  constexpr double kGate = 0.3;  // spacings, as in the pose search
  sigma_mm_ =
      compare_groups(to, from, near, views, kGate * spacing_mm).residual_mm / kMedianOfNormal;
}

PoseContradictions::Samples PoseContradictions::samples_of(const ViewGroup& group,
                                                           const GroupViews& views,
                                                           double spacing_mm) {
  Samples samples;
  samples.points = make_group(group.members, views.maps, kDense * spacing_mm).points;
  std::map<std::array<int, 3>, std::uint32_t> patches;
  for (const Eigen::Vector3f& point : samples.points.points_mm) {
    const Eigen::Array3i cell =
        (point.array() / static_cast<float>(kPatch * spacing_mm)).floor().cast<int>();
    const auto next = static_cast<std::uint32_t>(patches.size());
    samples.patch.push_back(patches.try_emplace({cell[0], cell[1], cell[2]}, next).first->second);
  }
  samples.patches = static_cast<std::uint32_t>(patches.size());
  return samples;
}

void PoseContradictions::add(PatchCount& count, const Way& way) const {
  constexpr double kGate = 0.3;       // spacings
  constexpr std::size_t kFewest = 4;  // points of a patch that are compared
  // Mean misfit of the points of a patch, of which noise alone gives 1 ± 0.5.
  constexpr double kContradicts = 4.0;
  const SurfacePoints& points = way.samples.points;
  std::vector<double> misfits(points.size());
  parallel_chunks(points.size(), kSamplesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      misfits[i] = misfit_of(way.target,
                             way.target_from_points * points.points_mm[i].cast<double>(),
                             way.target_from_points.linear() * points.normals[i].cast<double>(),
                             views_,
                             sigma_mm_,
                             kGate * spacing_mm_);
    }
  });
  struct Patch {
    std::size_t points = 0;
    double misfit = 0.0;
  };
  std::vector<Patch> patches(way.samples.patches);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (misfits[i] == kNothingThere) continue;
    Patch& patch = patches[way.samples.patch[i]];
    ++patch.points;
    patch.misfit += misfits[i];
  }
  for (const Patch& patch : patches) {
    if (patch.points < kFewest) continue;
    ++count.compared;
    count.contradicting +=
        patch.misfit > kContradicts * static_cast<double>(patch.points) ? 1U : 0U;
  }
}

PatchCount PoseContradictions::count(const Eigen::Isometry3d& to_from) const {
  PatchCount all;
  add(all, {of_from_, to_from, to_});
  add(all, {of_to_, to_from.inverse(), from_});
  return all;
}

}  // namespace frangia
