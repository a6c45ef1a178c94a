#include "frangia/range/find_rim.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/beside.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/continues_surface.h"
#include "frangia/range/is_step.h"

namespace frangia {
namespace {

enum Verdict : std::uint8_t { Dropped, GivenBack, BehindStep };
using Verdicts = std::vector<std::uint8_t>;

/// Gives back the pixels that lie where those in the grid lead, and puts them there.
void give_back(RangeGrid& grid,
               const SoundPixels& sound,
               const std::vector<RangePixel>& dropped,
               Verdicts& verdicts) {
  parallel_chunks(dropped.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (verdicts[i] == Dropped && continues_surface(sound, dropped[i])) verdicts[i] = GivenBack;
    }
  });
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (verdicts[i] != GivenBack) continue;
    grid.depth_mm(dropped[i].x, dropped[i].y) = dropped[i].depth_mm;
    grid.sigma_mm(dropped[i].x, dropped[i].y) = dropped[i].sigma_mm;
  }
}

/// Whether a pixel lies behind the one `step` beside it by more than the surfaces on both sides
/// slope, and by more than a crease would make of them.
bool is_behind(const SoundPixels& seen, const Eigen::Vector2i& at, const Eigen::Vector2i& step) {
  constexpr float kLeast = 1.5F;  // pixels
  constexpr float kSigmas = 8.0F;
  const auto& depth = seen.range.depth_mm;
  const auto depth_at = [&](int k) {
    const Eigen::Vector2i p = at + k * step;
    const bool inside = p.minCoeff() >= 0 && p.x() < depth.width() && p.y() < depth.height();
    return inside ? depth(p.x(), p.y()) : kMissing;
  };
  const float jump = depth_at(0) - depth_at(1);
  if (!(jump > 0.0F)) return false;
  const Eigen::Vector2i next = at + step;
  const float pixel_mm =
      (seen.rays(at.x(), at.y()) - seen.rays(next.x(), next.y())).norm() * depth_at(0);
  const float noise = seen.range.sigma_mm(at.x(), at.y());
  return is_step({jump, depth_at(-1) - depth_at(0), depth_at(1) - depth_at(2)},
                 kLeast * pixel_mm + kSigmas * noise);
}

bool is_behind_step(const SoundPixels& seen, const RangePixel& pixel) {
  const Eigen::Vector2i at(pixel.x, pixel.y);
  return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& step) {
    return is_behind(seen, at, {step[0], step[1]});
  });
}

}  // namespace

std::vector<RangePixel> find_rim(const RangeGrid& sound,
                                 const Image<Eigen::Vector2f>& rays,
                                 const std::vector<RangePixel>& dropped,
                                 const RimOptions& options) {
  require(same_size(sound.depth_mm, rays), "find_rim: range and rays differ in size");
  RangeGrid grid = sound;
  const auto slope = static_cast<float>(std::tan(rad_from_deg(options.max_incidence_deg)));
  const SoundPixels seen{grid, rays, slope};
  Verdicts verdicts(dropped.size(), Dropped);
  for (int round = 0; round < options.depth_px; ++round)
    give_back(grid, seen, dropped, verdicts);
  parallel_chunks(dropped.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (verdicts[i] == GivenBack && is_behind_step(seen, dropped[i])) verdicts[i] = BehindStep;
    }
  });
  std::vector<RangePixel> rim;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (verdicts[i] == GivenBack) rim.push_back(dropped[i]);
  }
  return rim;
}

}  // namespace frangia
