#include "frangia/calibrate/board/board_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/pattern/pattern.h"

namespace frangia {
namespace {

/// Weights of the frames whose weighted sum is the mean intensity: they sum to one, and the cosine
/// and the sine of the shifts vanish. The solution of least norm has the least noise.
Eigen::VectorXd mean_weights(const std::vector<double>& shifts_rad) {
  const auto count = static_cast<Eigen::Index>(shifts_rad.size());
  Eigen::MatrixXd conditions(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double shift = shifts_rad[static_cast<std::size_t>(i)];
    conditions.col(i) << 1.0, std::cos(shift), std::sin(shift);
  }
  // The pseudo-inverse by the eigenvectors of the normal matrix; shifts may determine less than
  // three.
  constexpr double kLeast = 1e-12;
  const SymmetricEigen<3> normal =
      symmetric_eigen(Eigen::Matrix3d(conditions * conditions.transpose()));
  Eigen::Vector3d multipliers = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = normal.vectors.col(i);
    if (normal.values[i] > kLeast * normal.values[2])
      multipliers += direction * (direction.x() / normal.values[i]);
  }
  return conditions.transpose() * multipliers;
}

void add_frame(const Frame& frame, double weight, Image<float>& sum) {
  std::visit(
      [&](const auto& image) {
        const auto counts = image.pixels();
        auto out = sum.pixels();
        for (std::size_t i = 0; i < counts.size(); ++i)
          out[i] += static_cast<float>(weight) * static_cast<float>(counts[i]);
      },
      frame);
}

/// The light that the frames of Gray codes share: every pixel is bright in one of them, and dark in
/// one.
Image<float> image_of_codes(std::span<const FrameStack> stacks, int width, int height) {
  Image<float> least(width, height, std::numeric_limits<float>::infinity());
  Image<float> most(width, height, 0.0F);
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind != PatternKind::Gray || stack.exposure != 0) continue;
    for (const Frame& frame : stack.frames) {
      std::visit(
          [&](const auto& image) {
            for (std::size_t i = 0; i < image.pixels().size(); ++i) {
              const auto counts = static_cast<float>(image.pixels()[i]);
              least.pixels()[i] = std::min(least.pixels()[i], counts);
              most.pixels()[i] = std::max(most.pixels()[i], counts);
            }
          },
          frame);
    }
  }
  for (std::size_t i = 0; i < most.pixels().size(); ++i)
    most.pixels()[i] = 0.5F * (most.pixels()[i] + least.pixels()[i]);
  return most;
}

}  // namespace

Image<float> board_image(std::span<const FrameStack> stacks) {
  require(!stacks.empty() && !stacks.front().frames.empty(), "a view holds no frames");
  const Frame& first = stacks.front().frames.front();
  Image<float> image(width_of(first), height_of(first), 0.0F);
  std::vector<const FrameStack*> fringes;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind == PatternKind::White) {
      add_frame(stack.frames.front(), 1.0, image);
      return image;
    }
    if (stack.pattern.kind == PatternKind::Fringe && stack.exposure == 0) fringes.push_back(&stack);
  }
  if (fringes.empty()) {
    require(std::any_of(stacks.begin(),
                        stacks.end(),
                        [](const FrameStack& stack) {
                          return stack.pattern.kind == PatternKind::Gray && stack.exposure == 0;
                        }),
            "scan.toml has no pattern of kind \"white\", \"fringe\" or \"gray\", so the board "
            "cannot be seen");
    return image_of_codes(stacks, image.width(), image.height());
  }
  for (const FrameStack* stack : fringes) {
    const Eigen::VectorXd weights = mean_weights(stack->pattern.shifts_rad);
    for (std::size_t i = 0; i < stack->frames.size(); ++i) {
      add_frame(stack->frames[i],
                weights[static_cast<Eigen::Index>(i)] / static_cast<double>(fringes.size()),
                image);
    }
  }
  return image;
}

}  // namespace frangia
