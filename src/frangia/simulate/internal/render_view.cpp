#include "frangia/simulate/internal/render_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/internal/view_renderer.h"

namespace frangia {
namespace {

/// The channels of a white or ambient frame while it is rendered, as three grey stacks.
struct ColorFrames {
  std::array<FrameStack, 3> channels;
};

template <typename T>
void set_luminance(Image<T>& grey, const Image<Eigen::Vector3f>& color, int white_level) {
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const double light = luminance_of_color(color.pixels()[i].cast<double>());
    grey.pixels()[i] = static_cast<T>(std::lround(light * white_level));
  }
}

/// Whether the frames of a pattern are rendered in color.
bool is_rendered_in_color(const Pattern& pattern, const SimulateOptions& options) {
  return options.color > 0.0 &&
         (pattern.kind == PatternKind::White || pattern.kind == PatternKind::Ambient);
}

/// Fills row y of the three channels; `row` is the light of the grey frames.
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

/// Sets the color of a stack, and its frame to the luminance.
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

void check(const Pattern& pattern, const Rig& rig) {
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::Input, fmt::format("pattern \"{}\" {}", pattern.name, why));
  };
  if (pattern.kind == PatternKind::Line) {
    if (!rig.laser_sheet) fail("is a line, but the rig has no [line]");
    return;
  }
  if (pattern.kind == PatternKind::Ramp || pattern.kind == PatternKind::White ||
      pattern.kind == PatternKind::Ambient)
    return;
  if (pattern.kind == PatternKind::Gray) {
    if (rig.projector.is_angular()) fail("is Gray code, which an angular projector cannot show");
    if (pattern.bits < 1 || !(pattern.stripe_px > 0.0)) fail("needs bits and stripes above 0");
    return;
  }
  if (rig.projector.is_angular() && pattern.source == PatternSource::Projector) {
    if (!(pattern.fringes_per_degree > 0.0)) fail("needs fringes_per_degree above 0");
    if (pattern.direction == FringeDirection::Horizontal) {
      fail("is horizontal, but an angular projector's fringes are vertical");
    }
  } else if (!(pattern.period_px > 0.0)) {
    fail("needs a period_px above 0");
  }
}

std::vector<Shot> shots_of(const Pattern& pattern,
                           const SimulatedView& view,
                           const SimulateOptions& options) {
  std::vector<Shot> shots(static_cast<std::size_t>(pattern.frame_count()));
  for (std::size_t i = 0; i < shots.size(); ++i) {
    shots[i].stream = noise_stream(options.seed, view.index, pattern.name, i);
    shots[i].projector =
        std::max(0.0, 1.0 + options.flicker * normal_from(hash(shots[i].stream, 2)));
    if (pattern.kind != PatternKind::Fringe) continue;
    const double shift = pattern.shifts_rad[i] * (1.0 + options.step_error) +
                         options.step_jitter_rad * normal_from(hash(shots[i].stream, 1));
    shots[i].cos_shift = std::cos(shift);
    shots[i].sin_shift = std::sin(shift);
  }
  return shots;
}

/// Light of the lamps that are on from a frame of the view on, counted over all its patterns.
double lamp_light(const SimulateOptions& options, std::size_t view, std::size_t frame) {
  double light = 0.0;
  for (const LampSwitch& lamp : options.lamps_on)
    if (lamp.view == view && frame >= lamp.frame) light += lamp.light;
  return light;
}

FrameStack empty_stack(const Pattern& pattern, int exposure, const SimulatedScene& scene) {
  FrameStack stack{pattern, {}, scene.known_rig.reference().white_level, exposure};
  const int width = scene.rays.width();
  const int height = scene.rays.height();
  for (int i = 0; i < pattern.frame_count(); ++i) {
    if (scene.options.bits == 8) {
      stack.frames.emplace_back(Image<std::uint8_t>(width, height));
    } else {
      stack.frames.emplace_back(Image<std::uint16_t>(width, height));
    }
  }
  return stack;
}

}  // namespace

std::vector<FrameStack> render_view(const SimulatedScene& scene,
                                    std::span<const Pattern> patterns,
                                    const SimulatedView& view,
                                    const Run& run) {
  std::vector<FrameStack> stacks;
  std::vector<std::vector<Shot>> shots;
  std::map<std::size_t, ColorFrames> colors;  // by the number of their stack
  std::size_t frame = 0;                      // in the order of the capture
  for (const Pattern& pattern : patterns) {
    check(pattern, scene.rig);
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      stacks.push_back(empty_stack(pattern, exposure, scene));
      if (is_rendered_in_color(pattern, scene.options))
        colors[stacks.size() - 1] = {{stacks.back(), stacks.back(), stacks.back()}};
      shots.push_back(shots_of(pattern, view, scene.options));
      for (Shot& shot : shots.back()) {
        shot.lamp = lamp_light(scene.options, view.index, frame++);
        // The cameras see the same light, each with noise of its own.
        constexpr std::uint64_t kCameraStream = 0xCA0;
        if (scene.camera > 0) shot.stream = hash(shot.stream, kCameraStream + scene.camera);
        if (exposure > 0) shot.stream = hash(shot.stream, static_cast<std::uint64_t>(exposure));
        shot.light = stacks.back().gain();
      }
    }
  }
  const ViewRenderer renderer(scene, true_pose(scene, view), view.index);
  constexpr int kBand = 64;  // rows between two reports of progress
  for (int done = 0; done < scene.rays.height(); done += kBand) {
    const int size = std::min(kBand, scene.rays.height() - done);
    parallel_rows(size, [&](int row) {
      if (run.stop.stop_requested()) return;
      const int y = done + row;
      const LitRow light = renderer.sample_row(y);
      for (std::size_t i = 0; i < stacks.size(); ++i) {
        if (const auto color = colors.find(i); color != colors.end()) {
          fill_color_row(renderer, y, light, shots[i], color->second);
          continue;
        }
        if (scene.options.bits == 8) {
          renderer.fill_row<std::uint8_t>(y, light, shots[i], stacks[i]);
        } else {
          renderer.fill_row<std::uint16_t>(y, light, shots[i], stacks[i]);
        }
      }
    });
    run.report(static_cast<double>(done + size) / scene.rays.height());
  }
  for (const auto& [stack, frames] : colors)
    set_color(frames, stacks[stack]);
  return stacks;
}

}  // namespace frangia
