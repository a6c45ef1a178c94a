#pragma once

#include <array>
#include <vector>

#include "frangia/simulate/internal/view_renderer.h"

namespace frangia {

/// The channels of a white or ambient frame while it is rendered, as three grey stacks.
struct ColorFrames {
  std::array<FrameStack, 3> channels;
};

/// Whether the frames of a pattern are rendered in color.
[[nodiscard]] bool is_rendered_in_color(const Pattern& pattern, const SimulateOptions& options);

/// Fills row y of the three channels; `row` is the light of the grey frames.
void fill_color_row(const ViewRenderer& renderer,
                    int y,
                    const LitRow& row,
                    const std::vector<Shot>& shots,
                    ColorFrames& frames);

/// Sets the color of a stack, and its frame to the luminance.
void set_color(const ColorFrames& frames, FrameStack& stack);

}  // namespace frangia
