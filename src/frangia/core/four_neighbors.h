#pragma once

#include <array>

namespace frangia {

/// Steps in x and y to the four neighbours of a pixel.
inline constexpr std::array<std::array<int, 2>, 4> kFourNeighbors{
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

}  // namespace frangia
