#pragma once

#include "frangia/core/image.h"

namespace frangia {

/// Makes `image` one of this size, to be written all over. Where it has the size already its memory
/// is used again: touching new memory for the first time costs more than most work on it.
template <typename T>
void resize_uninitialized(int width, int height, Image<T>& image) {
  if (image.width() != width || image.height() != height)
    image = Image<T>(width, height, Uninitialized{});
}

}  // namespace frangia
