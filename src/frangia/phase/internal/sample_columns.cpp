#include "frangia/phase/internal/sample_columns.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace frangia {

FrameStack sample_columns(const FrameStack& stack, std::size_t wanted) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const auto most = std::max<std::size_t>(1, wanted / static_cast<std::size_t>(height));
  const int stride =
      static_cast<int>(std::max<std::size_t>(1, static_cast<std::size_t>(width) / most));
  const int kept = (width + stride - 1) / stride;
  FrameStack out{.pattern = stack.pattern,
                 .frames = {},
                 .white_level = stack.white_level,
                 .exposure = stack.exposure};
  for (const Frame& frame : stack.frames) {
    std::visit(
        [&](const auto& image) {
          std::remove_cvref_t<decltype(image)> some(height, kept, Uninitialized{});
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < kept; ++x)
              some(y, x) = image(x * stride, y);
          }
          out.frames.emplace_back(std::move(some));
        },
        frame);
  }
  return out;
}

}  // namespace frangia
