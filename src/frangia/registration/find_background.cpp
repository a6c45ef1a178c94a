#include "frangia/registration/find_background.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/registration/internal/still_pixels.h"

namespace frangia {
namespace {

/// Criteria of a background.
struct BackgroundLimits {
  float steepest = 4.0F;         ///< depth over width of a step within one surface, 76 degrees
  double relative_cell = 0.012;  ///< size of a cell of rings, as a share of the distance: three of
                                 ///< the standard deviations that registration assumes of an axis
  double refuted = 0.1;  ///< share of a surface's pixels that are seen through: a wall is mostly
                         ///< out of sight where the table would turn it to
  double swept = 0.2;  ///< points that moved over those that stand still, at one height and radius
  int round_bins =
      6;  ///< of 15 degrees about the axis, side by side: a surface of revolution. A wall
          ///< has one radius over 45 degrees at 60 mm of 400, and over less farther out
  double supported = 0.5;  ///< pairs of views that see something there, over points: what repeats
                           ///< itself is seen again in one of two directions at least
  double repeated = 1.5;   ///< ... and in both directions, unless it is seen at grazing incidence
  /// Share of the pairs of views in which the place of a surface is out of view, and in which
  /// something is there: a far wall meets itself where the table turns by little.
  double outside = 0.75;
  double met = 0.15;
  double remains = 0.002;  ///< share of the points that must remain for the part
};
constexpr BackgroundLimits kBackgroundLimits;

constexpr int kBins = 24;  // of directions from the axis

/// A height and a radius about the axis.
using RingCell = std::pair<int, int>;

struct Ring {
  std::uint32_t bins = 0;  ///< directions from the axis at which points stand still, by view 0
  int through = 0;
  int support = 0;
  double still = 0.0;    ///< points
  double moved = 0.0;    ///< points that others see through at their own pixel
  bool blocked = false;  ///< by background: whatever turned there would hit it
};

/// The longest run of occupied bins, around the axis.
int longest_run(std::uint32_t bins) {
  int run = 0;
  int longest = 0;
  for (int i = 0; i < 2 * kBins; ++i) {
    run = (bins >> (i % kBins) & 1U) != 0 ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return std::min(longest, kBins);
}

/// What is decided about a pixel.
enum class PixelRole : std::uint8_t { Open, Round, Background };

class BackgroundSearch {
 public:
  explicit BackgroundSearch(ThinViews seen)
      : seen_(std::move(seen)),
        pixels_(seen_.camera.width_px, seen_.camera.height_px),
        roles_(seen_.camera.width_px, seen_.camera.height_px, PixelRole::Open) {}

  Background search(const Run& run) {
    Background out;
    out.step_px = seen_.step_px;
    if (seen_.views.size() < 2) return out;
    parallel_rows(pixels_.height(), [&](int y) {
      for (int x = 0; x < pixels_.width(); ++x)
        pixels_(x, y) = compare_views(seen_, x, y);
    });
    run.check();
    fill_rings();
    decide_surfaces(out);
    add_beside();
    extend();
    return finished(std::move(out));
  }

 private:
  /// Whether depths of neighbouring pixels are on one surface, no steeper than `slope`.
  [[nodiscard]] bool continues(const StillPixel& from, float to_mm, float slope) const {
    const float pixel_mm = from.depth_mm / static_cast<float>(seen_.camera.focal_px.x());
    return std::abs(to_mm - from.depth_mm) <
           equal_within_mm(from.depth_mm, from.sigma_mm) + slope * pixel_mm;
  }

  [[nodiscard]] RingCell cell_of(const Eigen::Vector3d& object, double cell_mm) const {
    return {static_cast<int>(std::floor(object.z() / cell_mm)),
            static_cast<int>(std::floor(object.head<2>().norm() / cell_mm))};
  }
  /// About the axis as view 0 sees it, so that what stands still has one direction.
  [[nodiscard]] Eigen::Vector3d about_axis(int x, int y, float depth_mm) const {
    return seen_.views.front().rig_from_object.inverse() * seen_.point(x, y, depth_mm);
  }

  [[nodiscard]] Ring& ring_of(const Eigen::Vector2i& p) {
    return rings_[cell_of(about_axis(p.x(), p.y(), pixels_(p.x(), p.y()).depth_mm), cell_mm_)];
  }
  /// Whether something moves at the height and radius of a point.
  [[nodiscard]] bool is_swept(const Eigen::Vector2i& p, const StillPixel& at) const {
    const auto ring = rings_.find(cell_of(about_axis(p.x(), p.y(), at.depth_mm), cell_mm_));
    return ring != rings_.end() &&
           ring->second.moved > kBackgroundLimits.swept * ring->second.still;
  }

  /// Sorts all points by height and radius.
  void fill_rings() {
    std::vector<float> depths;
    for (const StillPixel& at : std::as_const(pixels_).pixels())
      if (at.agree > 0) depths.push_back(at.depth_mm);
    if (depths.empty()) return;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    cell_mm_ = kBackgroundLimits.relative_cell * static_cast<double>(*middle);
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        const StillPixel& at = pixels_(x, y);
        if (at.stands) {
          const Eigen::Vector3d object = about_axis(x, y, at.depth_mm);
          Ring& ring = rings_[cell_of(object, cell_mm_)];
          const double turn = std::atan2(object.y(), object.x()) / kTwoPi + 0.5;
          ring.bins |= 1U << std::min(kBins - 1, static_cast<int>(kBins * turn));
          ring.through += at.through;
          ring.support += at.support;
          ring.still += at.agree;
        }
        add_moved(x, y);
      }
    }
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        const StillPixel& at = pixels_(x, y);
        if (!at.stands) continue;
        const Ring& ring = rings_[cell_of(about_axis(x, y, at.depth_mm), cell_mm_)];
        const bool all_about = longest_run(ring.bins) >= kBackgroundLimits.round_bins;
        if (all_about && 4 * ring.through <= ring.support) roles_(x, y) = PixelRole::Round;
      }
    }
  }

  /// Points through whose place another view sees at the same pixel.
  void add_moved(int x, int y) {
    for (const ThinView& one : seen_.views) {
      const float depth_mm = one.range.depth_mm(x, y);
      const bool moved =
          std::any_of(seen_.views.begin(), seen_.views.end(), [&](const ThinView& other) {
            const float noise_mm = std::hypot(one.range.sigma_mm(x, y), other.range.sigma_mm(x, y));
            return other.range.depth_mm(x, y) - depth_mm >
                   2.0F * equal_within_mm(depth_mm, noise_mm);
          });
      if (moved) rings_[cell_of(about_axis(x, y, depth_mm), cell_mm_)].moved += 1.0;
    }
  }

  [[nodiscard]] bool is(PixelRole role, const Eigen::Vector2i& at) const {
    return roles_(at.x(), at.y()) == role;
  }

  /// Calls `use` with the pixels beside a pixel.
  template <typename Use>
  void each_neighbour(const Eigen::Vector2i& at, const Use& use) const {
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = at.x() + dx;
      const int y = at.y() + dy;
      if (x >= 0 && y >= 0 && x < pixels_.width() && y < pixels_.height())
        use(Eigen::Vector2i(x, y));
    }
  }

  /// Decides each connected surface that stands still and is not round.
  void decide_surfaces(Background& out) {
    Image<std::uint8_t> seen(pixels_.width(), pixels_.height());
    double undecided = 0.0;
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        std::vector<Eigen::Vector2i> surface;
        const auto take = [&](const Eigen::Vector2i& p) {
          const StillPixel& at = pixels_(p.x(), p.y());
          if (seen(p.x(), p.y()) != 0 || !at.stands || is(PixelRole::Round, p)) return;
          seen(p.x(), p.y()) = 1;
          surface.push_back(p);
        };
        take({x, y});
        for (std::size_t i = 0; i < surface.size(); ++i) {
          const Eigen::Vector2i from = surface[i];
          const StillPixel& at = pixels_(from.x(), from.y());
          each_neighbour(from, [&](const Eigen::Vector2i& to) {
            if (continues(at, pixels_(to.x(), to.y()).depth_mm, kBackgroundLimits.steepest))
              take(to);
          });
        }
        if (!surface.empty()) undecided += decide(surface);
      }
    }
    double points = 0.0;
    for (const ThinView& view : seen_.views)
      points += static_cast<double>(measured_pixels(view.range.depth_mm));
    out.undecided = points > 0.0 ? undecided / points : 0.0;
  }

  static std::size_t measured_pixels(const Image<float>& depth_mm) {
    return static_cast<std::size_t>(std::count_if(depth_mm.pixels().begin(),
                                                  depth_mm.pixels().end(),
                                                  [](float z) { return !std::isnan(z); }));
  }

  /// Marks a surface that is background; returns its points if nothing shows whether it is.
  double decide(const std::vector<Eigen::Vector2i>& surface) {
    constexpr double kFewest = 8.0;  // pixels
    double usual = 0.0;
    double refuted = 0.0;
    double swept = 0.0;
    double points = 0.0;
    int support = 0;
    int outside = 0;
    int turned = 0;
    for (const Eigen::Vector2i& p : surface) {
      const StillPixel& at = pixels_(p.x(), p.y());
      usual += at.usual ? 1.0 : 0.0;
      refuted += at.through > at.support ? 1.0 : 0.0;
      swept += is_swept(p, at) ? 1.0 : 0.0;
      points += at.agree;
      support += at.support;
      outside += at.outside;
      turned += at.turned;
    }
    const auto pixels = static_cast<double>(surface.size());
    if (pixels < kFewest || usual < 0.5 * pixels || swept > 0.5 * pixels) return 0.0;
    const bool is_out =
        outside > kBackgroundLimits.outside * turned && support < kBackgroundLimits.met * turned;
    if (!is_out && refuted < kBackgroundLimits.refuted * pixels)
      return support < kBackgroundLimits.supported * points ? points : 0.0;
    for (const Eigen::Vector2i& p : surface)
      roles_(p.x(), p.y()) = PixelRole::Background;
    return 0.0;
  }

  /// Adds what stands still at the height and radius of background, as a piece of wall that is lit
  /// through a ring and on which no view of its place shows anything.
  void add_beside() {
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        if (roles_(x, y) == PixelRole::Background) ring_of({x, y}).blocked = true;
      }
    }
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        const StillPixel& at = pixels_(x, y);
        const bool repeats = at.support > kBackgroundLimits.repeated * at.agree;
        if (roles_(x, y) != PixelRole::Open || !at.stands || repeats || is_swept({x, y}, at))
          continue;
        if (ring_of({x, y}).blocked) roles_(x, y) = PixelRole::Background;
      }
    }
  }

  /// The farthest point at a pixel, which one view may see alone.
  [[nodiscard]] StillPixel farthest_at(const Eigen::Vector2i& p) const {
    StillPixel out{.depth_mm = 0.0F};
    for (std::size_t k = 0; k < seen_.views.size(); ++k) {
      const RangeGrid& range = seen_.views[k].range;
      const float depth_mm = range.depth_mm(p.x(), p.y());
      if (depth_mm > out.depth_mm)
        out = {.depth_mm = depth_mm, .sigma_mm = range.sigma_mm(p.x(), p.y()), .views = 1U << k};
    }
    if (out.views != 0) turn_into_views(seen_, p.x(), p.y(), out);
    return out;
  }

  /// Adds pixels next to the background: those that stand still and that no other view confirms as
  /// turning (narrow faces and edges), and those of its surface that a single view measured because
  /// the part or its shadow hides them in the others.
  void extend() {
    std::vector<Eigen::Vector2i> border;
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x)
        if (roles_(x, y) == PixelRole::Background) border.emplace_back(x, y);
    }
    for (std::size_t i = 0; i < border.size(); ++i) {
      const Eigen::Vector2i from = border[i];
      const StillPixel near = pixels_(from.x(), from.y());
      each_neighbour(from, [&](const Eigen::Vector2i& to) {
        if (!is(PixelRole::Open, to)) return;
        StillPixel& at = pixels_(to.x(), to.y());
        const bool stands_alone =
            at.stands && at.support < kBackgroundLimits.supported * at.agree && !is_swept(to, at);
        if (!stands_alone) {
          const StillPixel farthest = farthest_at(to);
          const float slope = farthest.support == 0 ? kBackgroundLimits.steepest : 1.0F;
          if (farthest.views == 0 || !continues(near, farthest.depth_mm, slope)) return;
          at = farthest;
        }
        roles_(to.x(), to.y()) = PixelRole::Background;
        border.push_back(to);
      });
    }
  }

  Background finished(Background out) const {
    Image<float> depth_mm(pixels_.width(), pixels_.height(), kMissing);
    std::vector<float> from_axis_mm;
    std::size_t measured = 0;
    std::size_t remaining = 0;
    for (const ThinView& view : seen_.views)
      measured += measured_pixels(view.range.depth_mm);
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        const StillPixel& at = pixels_(x, y);
        const bool is_background = roles_(x, y) == PixelRole::Background;
        const float limit_mm =
            is_background ? at.depth_mm - equal_within_mm(at.depth_mm, at.sigma_mm) : INFINITY;
        for (const ThinView& view : seen_.views)
          remaining += view.range.depth_mm(x, y) < limit_mm ? 1U : 0U;
        if (!is_background) continue;
        depth_mm(x, y) = at.depth_mm;
        from_axis_mm.push_back(static_cast<float>(about_axis(x, y, at.depth_mm).head<2>().norm()));
      }
    }
    const bool part_remains =
        static_cast<double>(remaining) > kBackgroundLimits.remains * static_cast<double>(measured);
    if (from_axis_mm.empty() || !part_remains) return out;
    // A few pixels may be mixed with the part.
    const auto near = from_axis_mm.begin() + static_cast<std::ptrdiff_t>(from_axis_mm.size() / 50);
    std::nth_element(from_axis_mm.begin(), near, from_axis_mm.end());
    out.from_axis_mm = static_cast<double>(*near);
    out.depth_mm = std::move(depth_mm);
    return out;
  }

  ThinViews seen_;
  Image<StillPixel> pixels_;
  Image<PixelRole> roles_;
  std::map<RingCell, Ring> rings_;
  double cell_mm_ = 1.0;
};

}  // namespace

Background find_background(const ViewStore& views,
                           const CameraModel& camera,
                           std::span<const int> setups,
                           const Run& run) {
  require(setups.size() == views.size(), "find_background: needs a setup for each view");
  return BackgroundSearch(thin_views(views, camera, setups)).search(run);
}

}  // namespace frangia
