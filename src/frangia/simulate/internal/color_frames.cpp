#include "frangia/simulate/internal/color_frames.h"

#include <cmath>
#include <cstdint>

#include "frangia/core/random.h"
#include "frangia/simulate/internal/surface_color.h"

namespace frangia {
namespace {

template <typename T>
void set_luminance(Image<T>& grey, const Image<Eigen::Vector3f>& color, int white_level) {
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const double light = luminance_of_color(color.pixels()[i].cast<double>());
    grey.pixels()[i] = static_cast<T>(std::lround(light * white_level));
  }
}

}  // namespace

bool is_rendered_in_color(const Pattern& pattern, const SimulateOptions& options) {
  return options.color > 0.0 &&
         (pattern.kind == PatternKind::White || pattern.kind == PatternKind::Ambient);
}

void fill_color_row(const ViewRenderer& renderer,
                    int y,
                    const LitRow& row,
                    const std::vector<Shot>& shots,
                    ColorFrames& frames) {
  for (std::size_t channel = 0; channel < frames.channels.size(); ++channel) {
    LitRow tinted = row;  // light that other points reflect stays grey
    for (LightSample& sample : tinted.samples) {
      sample.albedo *= sample.tint.at(channel);
      sample.diffuse *= sample.tint.at(channel);
    }
    std::vector<Shot> own = shots;
    for (Shot& shot : own)
      shot.stream = hash(shot.stream, 17 + channel);  // each channel has noise of its own
    FrameStack& stack = frames.channels.at(channel);
    if (stack.frames.front().index() == 0) {
      renderer.fill_row<std::uint8_t>(y, tinted, own, stack);
    } else {
      renderer.fill_row<std::uint16_t>(y, tinted, own, stack);
    }
  }
}

void set_color(const ColorFrames& frames, FrameStack& stack) {
  const Frame& like = stack.frames.front();
  stack.color = Image<Eigen::Vector3f>(width_of(like), height_of(like), Uninitialized{});
  for (int y = 0; y < stack.color.height(); ++y) {
    for (int x = 0; x < stack.color.width(); ++x) {
      for (std::size_t channel = 0; channel < frames.channels.size(); ++channel) {
        const int counts = counts_at(frames.channels.at(channel).frames.front(), x, y);
        stack.color(x, y)[static_cast<Eigen::Index>(channel)] =
            static_cast<float>(counts) / static_cast<float>(stack.white_level);
      }
    }
  }
  std::visit([&](auto& image) { set_luminance(image, stack.color, stack.white_level); },
             stack.frames.front());
}

}  // namespace frangia
