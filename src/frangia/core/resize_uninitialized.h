#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// Resizes `image` without initializing it; the caller must write every pixel. An image that
/// already has this size keeps its memory, because touching new memory for the first time costs
/// more than most work on it.
template <typename T>
void resize_uninitialized(int width, int height, Image<T>& image) {
  if (image.width() != width || image.height() != height)
    image = Image<T>(width, height, Uninitialized{});
}

}  // namespace frangia
