#include "frangia/decode/told_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/parallel.h"
#include "frangia/core/srgb.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

const FrameStack* find_kind(std::span<const FrameStack> stacks, PatternKind kind) {
  const auto found = std::find_if(stacks.begin(), stacks.end(), [&](const FrameStack& stack) {
    return stack.pattern.kind == kind && stack.exposure == 0 && !stack.frames.empty();
  });
  return found == stacks.end() ? nullptr : &*found;
}

/// Light of a frame without fringes, as shares of full scale.
Vector3f light_of(const FrameStack& stack, int x, int y) {
  if (!stack.color.empty()) return stack.color(x, y);
  const auto counts = static_cast<float>(counts_at(stack.frames.front(), x, y));
  return Vector3f::Constant(counts / static_cast<float>(stack.white_level));
}

/// Mean light of the frames of a pattern on one row: the mean of fringes, or of the extremes of a
/// code.
void mean_light(const FrameStack& stack, int y, std::vector<float>& light) {
  struct Extent {
    int least = std::numeric_limits<int>::max();
    int most = 0;
    int sum = 0;
  };
  std::vector<Extent> extents(light.size());
  for (const Frame& frame : stack.frames) {
    std::visit(
        [&](const auto& image) {
          for (std::size_t x = 0; x < extents.size(); ++x) {
            const int counts = image(static_cast<int>(x), y);
            Extent& extent = extents[x];
            extent.least = std::min(extent.least, counts);
            extent.most = std::max(extent.most, counts);
            extent.sum += counts;
          }
        },
        frame);
  }
  const bool fringes = stack.pattern.kind == PatternKind::Fringe;
  const auto frames = static_cast<float>(stack.frames.size());
  const auto white = static_cast<float>(stack.white_level);
  for (std::size_t x = 0; x < extents.size(); ++x) {
    const Extent& extent = extents[x];
    light[x] = (fringes ? static_cast<float>(extent.sum) / frames
                        : 0.5F * static_cast<float>(extent.least + extent.most)) /
               white;
  }
}

/// Screen values of evenly spaced lights from 0 to 1. The spacing is a quarter of a screen value
/// where the curve is steepest.
class ScreenValues {
 public:
  explicit ScreenValues(FrameColors colors) : values_(kSteps + 1) {
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double light = static_cast<double>(i) / kSteps;
      values_[i] = colors == FrameColors::Linear
                       ? srgb_from_linear(light)
                       : static_cast<std::uint8_t>(std::lround(255.0 * light));
    }
  }
  [[nodiscard]] std::uint8_t of(float light) const {
    const float clipped = light > 0.0F ? std::min(light, 1.0F) : 0.0F;
    return values_[static_cast<std::size_t>(clipped * kSteps + 0.5F)];
  }

 private:
  static constexpr std::size_t kSteps = 16'384;
  std::vector<std::uint8_t> values_;
};

/// Returns the color of each pixel of a view as a screen shows it (sRGB): that of the frame of kind
/// white less the one of kind ambient. Without a white frame it is that of a coloured ambient one,
/// or else, in grey, the mean of the fringes, or of the brightest and the darkest frame of a Gray
/// code, less the ambient frame.
///
/// @shape    w x h as the frames
/// @missing  empty when `colors` is None, or no such frame exists
Image<Rgb> view_color(std::span<const FrameStack> stacks, FrameColors colors) {
  if (colors == FrameColors::None) return {};
  const FrameStack* white = find_kind(stacks, PatternKind::White);
  const FrameStack* ambient = find_kind(stacks, PatternKind::Ambient);
  const FrameStack* pattern = nullptr;
  if (white == nullptr && ambient != nullptr && !ambient->color.empty()) {
    white = ambient;
    ambient = nullptr;
  } else if (white == nullptr) {
    pattern = find_kind(stacks, PatternKind::Fringe);
    if (pattern == nullptr) pattern = find_kind(stacks, PatternKind::Gray);
    if (pattern == nullptr) return {};
  }
  const Frame& like = white != nullptr ? white->frames.front() : pattern->frames.front();
  Image<Rgb> color(width_of(like), height_of(like), Uninitialized{});
  const ScreenValues values(colors);
  parallel_rows(color.height(), [&](int y) {
    std::vector<float> means(white == nullptr ? static_cast<std::size_t>(color.width()) : 0);
    if (white == nullptr) mean_light(*pattern, y, means);
    for (int x = 0; x < color.width(); ++x) {
      Vector3f light = white != nullptr
                           ? light_of(*white, x, y)
                           : Vector3f(Vector3f::Constant(means[static_cast<std::size_t>(x)]));
      if (ambient != nullptr) light -= light_of(*ambient, x, y);
      color(x, y) = {values.of(light[0]), values.of(light[1]), values.of(light[2])};
    }
  });
  return color;
}

}  // namespace

void ToldView::tell(const Run& run) const {
  for (const DecodeMessage& message : messages)
    message.warning ? run.warn(message.sentence) : run.note(message.sentence);
}

ToldView decode_told(const Scan& scan,
                     std::size_t view,
                     std::span<const FrameStack> stacks,
                     const DecodePlan& plan,
                     const Image<Eigen::Vector2f>& rays,
                     const DecodeOptions& options,
                     const std::stop_token& stop) {
  ToldView out;
  // Frames are named by the reader; the decoder does not know which view they are.
  const std::string prefix = scan.views[view].folder.string() + ": ";
  Run run;
  run.stop = stop;
  run.on_warning = [&](const std::string& sentence) {
    out.messages.push_back({true, prefix + sentence});
  };
  run.on_note = [&](const std::string& sentence) {
    out.messages.push_back({false, prefix + sentence});
  };
  out.view = decode_view(stacks, plan, scan.rig, rays, options_of_view(options, view), run);
  out.view.color = view_color(stacks, options.colors);
  return out;
}

}  // namespace frangia
