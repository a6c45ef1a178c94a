#include "frangia/phase/blur/undo_sharpening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include <Eigen/Dense>

#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// A filter as the pixel itself and a sum of filters along rows, then columns.
struct SeparableFilter {
  float center = 1.0F;
  Eigen::MatrixXf along;  ///< one column per filter, weights of the pixels from -reach to reach
  Eigen::MatrixXf across;

  [[nodiscard]] int reach() const { return static_cast<int>(along.rows() / 2); }
};

/// The inverse of a mask 1 + a (1 - G), with the spectrum G of its blur: 1 / (1 + a) of the pixel
/// and a smooth rest, of which a few products of one row and one column hold nearly all.
SeparableFilter inverse_of(const CameraSharpening& sharpening) {
  constexpr int kFrequencies = 64;
  constexpr int kMostReach = 24;
  constexpr double kNegligible = 1e-3;  // of the whole filter
  const std::vector<double> weights = blur_weights(sharpening.radius_px);
  Eigen::VectorXd spectrum(kFrequencies);
  Eigen::MatrixXd waves(kMostReach + 1, kFrequencies);
  for (int i = 0; i < kFrequencies; ++i) {
    const double rad = kTwoPi * i / kFrequencies;
    spectrum[i] = weights.front();
    for (std::size_t k = 1; k < weights.size(); ++k)
      spectrum[i] += 2.0 * weights[k] * std::cos(static_cast<double>(k) * rad);
    for (int x = 0; x <= kMostReach; ++x)
      waves(x, i) = std::cos(x * rad) / kFrequencies;
  }
  const double a = sharpening.amount;
  const Eigen::MatrixXd rest =
      (1.0 + a - a * (spectrum * spectrum.transpose()).array()).inverse() - 1.0 / (1.0 + a);
  const Eigen::MatrixXd quarter = waves * rest * waves.transpose();
  int reach = kMostReach;
  while (reach > 1 && quarter.row(reach).cwiseAbs().sum() < 0.1 * kNegligible)
    --reach;
  const int size = 2 * reach + 1;
  Eigen::MatrixXd whole(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x)
      whole(y, x) = quarter(std::abs(y - reach), std::abs(x - reach));
  }
  whole *= a / (1.0 + a) / whole.sum();  // even light stays as it is
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(whole);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < size; ++i)
    if (std::abs(solver.eigenvalues()[i]) > kNegligible) kept.push_back(i);
  SeparableFilter filter{.center = static_cast<float>(1.0 / (1.0 + a)),
                         .along = Eigen::MatrixXf(size, static_cast<Eigen::Index>(kept.size())),
                         .across = Eigen::MatrixXf(size, static_cast<Eigen::Index>(kept.size()))};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    filter.along.col(column) = solver.eigenvectors().col(kept[i]).cast<float>();
    filter.across.col(column) =
        (solver.eigenvalues()[kept[i]] * solver.eigenvectors().col(kept[i])).cast<float>();
  }
  return filter;
}

/// Adds what one row and one column of a filter give. The image goes on beyond its border as it
/// ends there.
void add_filtered(const Image<float>& image,
                  const Eigen::VectorXf& along,
                  const Eigen::VectorXf& across,
                  Image<float>& sum) {
  const auto reach = static_cast<int>(along.size() / 2);
  const int width = image.width();
  const int height = image.height();
  Image<float> rows(width, height, 0.0F);
  parallel_rows(height, [&](int y) {
    for (int k = -reach; k <= reach; ++k) {
      const float weight = along[k + reach];
      for (int x = 0; x < width; ++x)
        rows(x, y) += weight * image(std::clamp(x + k, 0, width - 1), y);
    }
  });
  parallel_rows(height, [&](int y) {
    for (int k = -reach; k <= reach; ++k) {
      const float weight = across[k + reach];
      const int from = std::clamp(y + k, 0, height - 1);
      for (int x = 0; x < width; ++x)
        sum(x, y) += weight * rows(x, from);
    }
  });
}

template <typename Count>
Image<Count> filtered(const Image<Count>& frame, const SeparableFilter& filter, int white_level) {
  Image<float> image(frame.width(), frame.height(), Uninitialized{});
  Image<float> sum(frame.width(), frame.height(), Uninitialized{});
  for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
    image.pixels()[i] = static_cast<float>(frame.pixels()[i]);
    sum.pixels()[i] = filter.center * image.pixels()[i];
  }
  for (Eigen::Index i = 0; i < filter.along.cols(); ++i)
    add_filtered(image, filter.along.col(i), filter.across.col(i), sum);
  Image<Count> out(frame.width(), frame.height(), Uninitialized{});
  for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
    const float light = std::clamp(
        std::round(sum.pixels()[i]), 0.0F, static_cast<float>(std::max(0, white_level - 1)));
    const Count seen = frame.pixels()[i];
    out.pixels()[i] = seen <= 0 || seen >= white_level ? seen : static_cast<Count>(light);
  }
  return out;
}

}  // namespace

FrameStack without_sharpening(const FrameStack& stack, const CameraSharpening& sharpening) {
  const SeparableFilter filter = inverse_of(sharpening);
  FrameStack out = stack;
  for (Frame& frame : out.frames) {
    frame = std::visit(
        [&](const auto& image) -> Frame { return filtered(image, filter, stack.white_level); },
        frame);
  }
  return out;
}

}  // namespace frangia
