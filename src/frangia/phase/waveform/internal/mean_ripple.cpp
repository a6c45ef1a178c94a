#include "frangia/phase/waveform/internal/mean_ripple.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace frangia {

MeanRipple fit_mean_ripple(const FringeBins& bins, int multiple) {
  Eigen::Matrix2d all_normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d all_right = Eigen::Vector2d::Zero();
  std::vector<std::pair<Eigen::Matrix2d, Eigen::Vector2d>> tiles;
  for (Eigen::Index tile = 0; tile < bins.tile_count.cols(); ++tile) {
    const Eigen::ArrayXd count = bins.tile_count.col(tile);
    const double pixels = count.sum();
    if (pixels < kMinTilePixels) continue;
    const double mean = bins.tile_log_mean.col(tile).sum() / pixels;
    const auto wave = [&](int bin) {
      return Eigen::Vector2d(std::cos(multiple * bin_phase(bin)),
                             -std::sin(multiple * bin_phase(bin)));
    };
    Eigen::Vector2d mean_wave = Eigen::Vector2d::Zero();
    for (int bin = 0; bin < kPhaseBins; ++bin)
      mean_wave += count(bin) / pixels * wave(bin);
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      const Eigen::Vector2d row = wave(bin) - mean_wave;
      normal += count(bin) * row * row.transpose();
      right += row * (bins.tile_log_mean(bin, tile) - count(bin) * mean);
    }
    tiles.emplace_back(normal, right);
    all_normal += normal;
    all_right += right;
  }
  const Eigen::Vector2d found = all_normal.ldlt().solve(all_right);
  double variance = 0.0;
  for (const auto& [normal, right] : tiles) {
    const Eigen::Vector2d without =
        Eigen::Matrix2d(all_normal - normal).ldlt().solve(Eigen::Vector2d(all_right - right));
    variance += 0.5 * (without - found).squaredNorm();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(tiles.size(), 2));
  return {{found(0), found(1)}, std::sqrt(variance * (count - 1.0) / count)};
}

}  // namespace frangia
