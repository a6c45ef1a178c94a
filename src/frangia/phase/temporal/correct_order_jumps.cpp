#include "frangia/phase/temporal/correct_order_jumps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_forest.h"
#include "frangia/phase/internal/jumpless_regions.h"

namespace frangia {
namespace {

/// Least number of pixel pairs at a border at which only the order jumps. A wrong order by noise
/// concerns single pixels, which have at most four.
constexpr std::size_t kMinPairs = 8;

/// Least number of such pairs for each pair at which the surface has a step.
constexpr double kMinRatio = 2.0;

/// A region of more than this share of the size of its neighbour is discarded instead of corrected,
/// because either may be wrong.
constexpr double kMaxSize = 0.5;

/// Two neighbouring pixels between which the absolute phase jumps and the wrapped one does not.
struct Jump {
  std::uint32_t from;
  std::uint32_t to;      ///< the pixel to the right or below
  std::uint32_t stride;  ///< to - from
  int fringes;           ///< the jump of the order
};

/// Returns whether the difference of two pixels lies within the range of the adjacent differences.
bool is_smooth(double before, double here, double behind, const JumpOptions& options) {
  const auto tolerance = static_cast<double>(options.tolerance_rad);
  return std::abs(here) <= static_cast<double>(options.max_jump_rad) &&
         here >= std::min(before, behind) - tolerance &&
         here <= std::max(before, behind) + tolerance;
}

std::vector<Jump> find_jumps(const Image<float>& phase, const JumpOptions& options) {
  const int width = phase.width();
  const int height = phase.height();
  std::vector<std::vector<Jump>> rows(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    const auto look = [&](int x, int dx, int dy) {
      if (x - dx < 0 || y - dy < 0 || x + 2 * dx >= width || y + 2 * dy >= height) return;
      const double from = phase(x, y);
      const double to = phase(x + dx, y + dy);
      if (!(std::abs(to - from) > kPi)) return;
      const double before = wrap_rad(from - static_cast<double>(phase(x - dx, y - dy)));
      const double behind = wrap_rad(static_cast<double>(phase(x + 2 * dx, y + 2 * dy)) - to);
      if (std::isnan(before) || std::isnan(behind)) return;
      const auto fringes = static_cast<int>(std::lround((to - from) / kTwoPi));
      if (!is_smooth(before, to - from - kTwoPi * fringes, behind, options)) return;
      const int at = y * width + x;
      const auto index = static_cast<std::uint32_t>(at);
      const auto stride = static_cast<std::uint32_t>(dy * width + dx);
      rows[static_cast<std::size_t>(y)].push_back({index, index + stride, stride, fringes});
    };
    for (int x = 0; x < width; ++x) {
      look(x, 1, 0);
      look(x, 0, 1);
    }
  });
  std::vector<Jump> jumps;
  for (const auto& row : rows)
    jumps.insert(jumps.end(), row.begin(), row.end());
  return jumps;
}

/// What the coarse phases say about a jump.
enum class Cause : std::uint8_t {
  Unknown,     ///< a coarse phase is missing
  WrongOrder,  ///< the coarse phases go on smoothly
  Step         ///< they jump as far as the fine one
};

/// Compares the coarse phases one pixel before and one behind each jump; those at the jump itself
/// may be mixed where there is a step.
std::vector<Cause> causes_of(const std::vector<Jump>& jumps,
                             const AbsolutePhase& phase,
                             const CoarsePhases& coarse) {
  std::vector<std::uint32_t> pixels;
  for (const Jump& jump : jumps) {
    pixels.push_back(jump.from - jump.stride);
    pixels.push_back(jump.to + jump.stride);
  }
  const std::vector<WrappedPhase> maps = coarse(pixels);
  std::vector<Cause> causes;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const double fine = static_cast<double>(phase.phase_rad.pixels()[pixels[2 * i + 1]]) -
                        static_cast<double>(phase.phase_rad.pixels()[pixels[2 * i]]);
    double wrong_order = 0.0;
    double step = 0.0;
    for (const WrappedPhase& map : maps) {
      const double ratio = map.pattern.fringes_per_unit() / phase.pattern.fringes_per_unit();
      const auto at = [&](const Image<float>& image, std::size_t k) {
        return static_cast<double>(image.pixels()[2 * i + k]);
      };
      const double difference = at(map.phase_rad, 1) - at(map.phase_rad, 0);
      const double variance = std::pow(at(map.sigma_rad, 0), 2) + std::pow(at(map.sigma_rad, 1), 2);
      step += std::pow(wrap_rad(difference - ratio * fine), 2) / variance;
      wrong_order +=
          std::pow(wrap_rad(difference - ratio * (fine - kTwoPi * jumps[i].fringes)), 2) / variance;
    }
    const Cause likelier = wrong_order < step ? Cause::WrongOrder : Cause::Step;
    const bool known = std::isfinite(wrong_order) && std::isfinite(step);
    causes.push_back(known ? likelier : Cause::Unknown);
  }
  return causes;
}

/// A border of two regions at which the order jumps: pairs of pixels by cause.
struct OrderBorder {
  std::size_t wrong_order = 0;
  std::size_t step = 0;
};

/// Joins regions across the borders at which only the order jumps, from the longest.
FringeForest join_over_jumps(const std::vector<Jump>& jumps,
                             const std::vector<Cause>& causes,
                             const JumplessRegions& regions) {
  struct Key {
    std::int32_t larger;
    std::int32_t smaller;
    int fringes;  ///< to add to the smaller one
    bool operator<(const Key& other) const {
      return std::tie(larger, smaller, fringes) <
             std::tie(other.larger, other.smaller, other.fringes);
    }
  };
  std::map<Key, OrderBorder> borders;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const std::int32_t from = regions.label[jumps[i].from];
    const std::int32_t to = regions.label[jumps[i].to];
    if (from == to || causes[i] == Cause::Unknown) continue;
    const Key key = from < to ? Key{from, to, -jumps[i].fringes} : Key{to, from, jumps[i].fringes};
    OrderBorder& border = borders[key];
    ++(causes[i] == Cause::WrongOrder ? border.wrong_order : border.step);
  }
  std::vector<std::pair<Key, OrderBorder>> safe;
  for (const auto& [key, border] : borders) {
    if (border.wrong_order >= kMinPairs &&
        static_cast<double>(border.wrong_order) >= kMinRatio * static_cast<double>(border.step))
      safe.emplace_back(key, border);
  }
  std::stable_sort(safe.begin(), safe.end(), [](const auto& a, const auto& b) {
    return a.second.wrong_order > b.second.wrong_order;
  });
  FringeForest forest(regions.size.size());
  for (const auto& [key, border] : safe) {
    forest.join(
        static_cast<std::size_t>(key.larger), static_cast<std::size_t>(key.smaller), key.fringes);
  }
  return forest;
}

void discard(std::size_t i, AbsolutePhase& phase) {
  phase.phase_rad.pixels()[i] = phase.sigma_rad.pixels()[i] = kMissing;
  phase.status.pixels()[i] = PixelStatus::UncertainOrder;
  if (!phase.systematic_rad.empty()) phase.systematic_rad.pixels()[i] = kMissing;
}

}  // namespace

OrderJumpResult correct_order_jumps(const CoarsePhases& coarse,
                                    AbsolutePhase& phase,
                                    const OrderJumpOptions& options) {
  OrderJumpResult out;
  const std::vector<Jump> jumps = find_jumps(phase.phase_rad, options.smooth);
  if (jumps.size() < kMinPairs) return out;
  const std::vector<Cause> causes = causes_of(jumps, phase, coarse);
  const auto wrong = std::count(causes.begin(), causes.end(), Cause::WrongOrder);
  if (static_cast<std::size_t>(wrong) < kMinPairs) return out;
  const JumplessRegions regions = find_jumpless_regions(phase.phase_rad);
  FringeForest forest = join_over_jumps(jumps, causes, regions);
  std::size_t measured = 0;
  std::size_t changed = 0;
  for (std::size_t region = 0; region < regions.size.size(); ++region) {
    measured += regions.size[region];
    if (forest.root(region).fringes != 0) changed += regions.size[region];
  }
  if (static_cast<double>(changed) > options.max_share * static_cast<double>(measured)) return out;
  for (std::size_t i = 0; i < regions.label.size(); ++i) {
    if (regions.label[i] < 0) continue;
    const auto region = static_cast<std::size_t>(regions.label[i]);
    const auto [root, fringes] = forest.root(region);
    if (fringes == 0) continue;
    if (static_cast<double>(regions.size[region]) >
        kMaxSize * static_cast<double>(regions.size[root])) {
      discard(i, phase);
      ++out.discarded;
    } else {
      phase.phase_rad.pixels()[i] += static_cast<float>(kTwoPi * fringes);
      ++out.corrected;
    }
  }
  return out;
}

}  // namespace frangia
