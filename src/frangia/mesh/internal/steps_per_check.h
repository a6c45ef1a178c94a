#pragma once

#include <cstddef>

namespace frangia {

/// The number of vertices or triangles that an operation handles between two checks for a request
/// to stop: about 10 ms.
constexpr std::size_t kStepsPerCheck = 16'384;

}  // namespace frangia
