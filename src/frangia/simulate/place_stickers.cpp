#include "frangia/simulate/place_stickers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/surface_samples.h"

namespace frangia {
namespace {

/// Whether the surface is flat within a radius.
bool is_flat(const RayScene& surface, const SurfaceSample& sample, double radius_mm) {
  constexpr int kAround = 16;
  constexpr double kFlat_mm = 0.02;
  const Eigen::Vector3d side = sample.normal.unitOrthogonal();
  const Eigen::Vector3d other = sample.normal.cross(side);
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAround;
    const Eigen::Vector3d above = sample.point_mm + radius_mm * sample.normal +
                                  radius_mm * (std::cos(angle) * side + std::sin(angle) * other);
    const auto hit = surface.first_hit(above, -sample.normal);
    if (!hit || std::abs(hit->distance - radius_mm) > kFlat_mm) return false;
  }
  return true;
}

}  // namespace

double sticker_albedo(const TargetSet& targets,
                      const std::vector<Sticker>& stickers,
                      const Eigen::Vector3d& point_mm) {
  constexpr double kInk = 0.06;  // reflectance of black laser print
  constexpr double kPaper = 1.0;
  constexpr double kFace_mm = 0.05;
  for (const Sticker& sticker : stickers) {
    const Eigen::Vector3d away = point_mm - sticker.center_mm;
    const double reach_mm = 0.5 * sticker_diameter_mm(targets, sticker.code >= 0);
    if (away.squaredNorm() > reach_mm * reach_mm || std::abs(away.dot(sticker.normal)) > kFace_mm)
      continue;
    const Eigen::Vector3d down = sticker.right.cross(sticker.normal);
    return is_target_dark(targets, sticker.code, away.dot(sticker.right), away.dot(down)) ? kInk
                                                                                          : kPaper;
  }
  return static_cast<double>(kMissing);
}

std::vector<Sticker> place_stickers(const Mesh& part,
                                    const TargetSet& targets,
                                    std::size_t discs,
                                    std::size_t coded,
                                    std::uint64_t seed,
                                    const Run& run) {
  constexpr std::size_t kPlaces = 4000;
  constexpr double kRoom = 1.15;  // of the radius: a sticker does not reach the edge of its face
  constexpr double kApart = 1.3;  // mean diameters of two stickers
  check_targets(targets);
  const RayScene surface(part, run);
  const auto places = sample_surface(part, kPlaces, seed);
  std::vector<Sticker> stickers;
  // What is left between a sticker at a point and the others, beyond what they need.
  const auto room_mm = [&](const Eigen::Vector3d& point_mm, double size_mm) {
    double least = 1e6;
    for (const Sticker& sticker : stickers) {
      const double other_mm = sticker_diameter_mm(targets, sticker.code >= 0);
      least = std::min(least,
                       (sticker.center_mm - point_mm).norm() - 0.5 * kApart * (size_mm + other_mm));
    }
    return least;
  };
  std::vector<SurfaceSample> flat;  // places for the present kind
  for (std::size_t i = 0; i < discs + coded; ++i) {
    run.check();
    const bool is_coded = i >= discs;
    const double size_mm = sticker_diameter_mm(targets, is_coded);
    const double radius_mm = 0.5 * kRoom * size_mm;
    if (i == 0 || i == discs) {
      flat.clear();
      std::copy_if(places.begin(), places.end(), std::back_inserter(flat), [&](const auto& place) {
        return is_flat(surface, place, radius_mm);
      });
    }
    const SurfaceSample* best = nullptr;
    double farthest = 0.0;
    for (const SurfaceSample& place : flat) {
      const double away = room_mm(place.point_mm, size_mm);
      if (away <= farthest) continue;
      farthest = away;
      best = &place;
    }
    if (best == nullptr) {
      throw Error(
          ErrorKind::Input,
          fmt::format("the part has flat places for {} stickers only, not for {}; take fewer "
                      "or smaller ones",
                      i,
                      discs + coded));
    }
    // Any turn: nobody sticks them straight.
    const double turn = 2.0 * std::numbers::pi * uniform_from(hash(hash(seed), i));
    const Eigen::Vector3d side = best->normal.unitOrthogonal();
    Sticker sticker;
    sticker.code = is_coded ? static_cast<int>(i - discs) : -1;
    sticker.center_mm = best->point_mm;
    sticker.normal = best->normal;
    sticker.right = std::cos(turn) * side + std::sin(turn) * best->normal.cross(side);
    stickers.push_back(sticker);
  }
  return stickers;
}

}  // namespace frangia
