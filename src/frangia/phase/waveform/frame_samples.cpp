#include "frangia/phase/waveform/frame_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/image.h"

namespace frangia {

Eigen::ArrayXXf sample_frames(const FrameStack& stack, std::size_t wanted) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const double all = static_cast<double>(width) * height;
  // The same stride along x and y, so that no fringe direction is preferred.
  const int stride = std::max(
      1, static_cast<int>(std::sqrt(all / static_cast<double>(std::max<std::size_t>(wanted, 1)))));
  const auto frames = static_cast<Eigen::Index>(stack.frames.size());
  const Eigen::Index most =
      Eigen::Index{(width + stride - 1) / stride} * ((height + stride - 1) / stride);
  Eigen::ArrayXXf counts(most, frames);
  Eigen::Array<bool, Eigen::Dynamic, 1> kept =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(most, true);
  for (Eigen::Index k = 0; k < frames; ++k) {
    std::visit(
        [&](const auto& image) {
          Eigen::Index row = 0;
          for (int y = 0; y < height; y += stride) {
            for (int x = 0; x < width; x += stride, ++row) {
              counts(row, k) = static_cast<float>(image(x, y));
              kept(row) = kept(row) && image(x, y) < stack.white_level;
            }
          }
        },
        stack.frames[static_cast<std::size_t>(k)]);
  }
  Eigen::Index rows = 0;
  for (Eigen::Index row = 0; row < most; ++row) {
    if (kept(row)) counts.row(rows++) = counts.row(row);
  }
  counts.conservativeResize(rows, frames);
  return counts;
}

FrameStack sample_rows(const FrameStack& stack, std::size_t wanted, int together) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const int bands = std::max(1, height / together);
  together = std::min(together, height);
  const auto most = static_cast<int>(std::clamp<std::size_t>(
      wanted / (static_cast<std::size_t>(width) * static_cast<std::size_t>(together)),
      1,
      static_cast<std::size_t>(bands)));
  const int stride = std::max(1, bands / most);
  FrameStack out{.pattern = stack.pattern,
                 .frames = {},
                 .white_level = stack.white_level,
                 .exposure = stack.exposure};
  const int kept = (bands + stride - 1) / stride * together;
  for (const Frame& frame : stack.frames) {
    std::visit(
        [&](const auto& image) {
          std::remove_cvref_t<decltype(image)> some(width, kept, Uninitialized{});
          for (int y = 0; y < kept; ++y) {
            const auto* row = &image(0, y / together * stride * together + y % together);
            std::copy(row, row + width, &some(0, y));
          }
          out.frames.emplace_back(std::move(some));
        },
        frame);
  }
  return out;
}

FrameStack sample_pixels(const FrameStack& stack, std::span<const std::uint32_t> pixels) {
  FrameStack out{.pattern = stack.pattern,
                 .frames = {},
                 .white_level = stack.white_level,
                 .exposure = stack.exposure};
  for (const Frame& frame : stack.frames) {
    std::visit(
        [&](const auto& image) {
          std::remove_cvref_t<decltype(image)> some(
              static_cast<int>(pixels.size()), 1, Uninitialized{});
          for (std::size_t i = 0; i < pixels.size(); ++i)
            some.pixels()[i] = image.pixels()[pixels[i]];
          out.frames.emplace_back(std::move(some));
        },
        frame);
  }
  return out;
}

FrameStack sample_box(const FrameStack& stack, const PixelBox& box) {
  FrameStack out{.pattern = stack.pattern,
                 .frames = {},
                 .white_level = stack.white_level,
                 .exposure = stack.exposure};
  for (const Frame& frame : stack.frames) {
    require(box.left >= 0 && box.top >= 0 && box.right <= width_of(frame) &&
                box.bottom <= height_of(frame),
            "sample_box: the box leaves the frames");
    std::visit(
        [&](const auto& image) {
          std::remove_cvref_t<decltype(image)> cut(box.width(), box.height(), Uninitialized{});
          for (int y = 0; y < cut.height(); ++y)
            std::copy_n(&image(box.left, box.top + y), cut.width(), &cut(0, y));
          out.frames.emplace_back(std::move(cut));
        },
        frame);
  }
  return out;
}

FrameStack sample_grid(const FrameStack& stack, int step) {
  FrameStack out{.pattern = stack.pattern,
                 .frames = {},
                 .white_level = stack.white_level,
                 .exposure = stack.exposure};
  for (const Frame& frame : stack.frames)
    std::visit([&](const auto& image) { out.frames.emplace_back(every_nth_pixel(image, step)); },
               frame);
  return out;
}

}  // namespace frangia
