#include "frangia/registration/internal/turntable_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 512;  // surfels; fixed, so that sums do not depend on threads

/// Sums one chunk of a view's surfels over all other views.
struct BundleAccumulator {
  std::span<const SurfelMap> maps;
  const FastCameraModel& model;
  const TableState& state;
  BundleOptions options;
  std::size_t closing;
  BundleSums sums;
  std::vector<PairTally> tallies;  ///< by other view, of the view whose surfels are added

  BundleAccumulator(std::span<const SurfelMap> all,
                    const FastCameraModel& camera,
                    const TableState& now,
                    const BundleOptions& how)
      : maps(all), model(camera), state(now), options(how), closing(now.closing_view()) {
    const Eigen::Index unknowns = now.unknowns();
    sums.hessian = Eigen::MatrixXd::Zero(unknowns, unknowns);
    sums.gradient = Eigen::VectorXd::Zero(unknowns);
    sums.matched.assign(all.size(), 0);
    sums.observed.assign(all.size(), 0);
    tallies.resize(all.size());
  }

  void add(std::size_t from, std::span<const SurfelMap::Surfel> surfels) {
    std::vector<ViewTransfer> transfers;
    for (std::size_t to = 0; to < maps.size(); ++to)
      transfers.emplace_back(state, from, to);
    for (const SurfelMap::Surfel& surfel : surfels) {
      bool observed = false;
      bool matched = false;
      for (std::size_t to = 0; to < maps.size(); ++to) {
        if (to == from || to == options.left_out) continue;
        const double distance = add_pair(surfel, transfers[to], from, to);
        observed = observed || !std::isnan(distance);
        matched = matched || distance < options.gate_mm;
      }
      sums.observed[from] += observed ? 1 : 0;
      sums.matched[from] += matched ? 1 : 0;
    }
  }

  /// Returns the absolute distance of a pair; NaN when the other view measured nothing there.
  double add_pair(const SurfelMap::Surfel& surfel,
                  const ViewTransfer& transfer,
                  std::size_t from,
                  std::size_t to) {
    const Eigen::Vector3d point = transfer.apply(surfel.point_mm.cast<double>());
    const SurfelMap::Surfel* target = surfel_at(maps[to], model, point);
    if (target == nullptr) return std::nan("");
    const Eigen::Vector3d facing = transfer.rotation() * surfel.normal.cast<double>();
    const SurfelPair pair(point, facing, *target);
    tallies[to].violations += pair.violates_free_space(options.free_space_margin_mm) ? 1U : 0U;
    if (facing.dot(point) >= 0.0 || !pair.faces_alike()) return std::nan("");
    const double distance = pair.distance_mm();
    if (!(std::abs(distance) < options.gate_mm)) return std::abs(distance);
    ++tallies[to].agree;
    const double weight = tukey_weight(distance, options.gate_mm) /
                          (std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                           std::pow(static_cast<double>(target->sigma_mm), 2));
    const PairJacobian jacobian = transfer.jacobian(pair.normal, surfel.point_mm.cast<double>());
    add_row(jacobian, weight, distance, from, to);
    if (closing > 1 && std::min(from, to) == 0 && std::max(from, to) == closing) {
      const double by_last = to == closing ? jacobian.angle_to : jacobian.angle_from;
      sums.closing_weight += weight * by_last * by_last;
      sums.closing_gradient += weight * by_last * distance;
    }
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    return std::abs(distance);
  }

  /// The unknowns that a pair depends on.
  struct Row {
    std::array<Eigen::Index, 18> indices{};
    std::array<double, 18> values{};
    std::size_t count = 0;

    void add(Eigen::Index index, double value) {
      indices.at(count) = index;
      values.at(count++) = value;
    }
  };

  [[nodiscard]] Row row_of(const PairJacobian& by, std::size_t from, std::size_t to) const {
    Row row;
    for (Eigen::Index i = 0; i < 2; ++i) {
      row.add(i, by.tilt[i]);
      row.add(i + 2, by.shift[i]);
    }
    if (to != 0) row.add(static_cast<Eigen::Index>(to) + 3, by.angle_to);
    if (from != 0) row.add(static_cast<Eigen::Index>(from) + 3, by.angle_from);
    const std::size_t setup_to = state.setup_of(to);
    const std::size_t setup_from = state.setup_of(from);
    if (setup_to == setup_from) return row;
    for (Eigen::Index i = 0; i < 6; ++i) {
      if (setup_to != 0) row.add(state.index_of_setup(setup_to) + i, by.setup_to[i]);
      if (setup_from != 0) row.add(state.index_of_setup(setup_from) + i, by.setup_from[i]);
    }
    return row;
  }

  void add_row(
      const PairJacobian& by, double weight, double distance, std::size_t from, std::size_t to) {
    const Row row = row_of(by, from, to);
    for (std::size_t i = 0; i < row.count; ++i) {
      sums.gradient[row.indices[i]] += weight * row.values[i] * distance;
      for (std::size_t j = 0; j < row.count; ++j)
        sums.hessian(row.indices[i], row.indices[j]) += weight * row.values[i] * row.values[j];
    }
  }
};

}  // namespace

BundleSums sum_bundle(std::span<const std::vector<SurfelMap::Surfel>> surfels,
                      std::span<const SurfelMap> maps,
                      const FastCameraModel& model,
                      const TableState& state,
                      const BundleOptions& options) {
  struct Chunk {
    std::size_t view;
    std::size_t first;
  };
  std::vector<Chunk> chunks;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    if (view == options.left_out) continue;
    for (std::size_t first = 0; first < surfels[view].size(); first += kChunk)
      chunks.push_back({view, first});
  }
  std::vector<BundleSums> parts(chunks.size());
  std::vector<std::vector<PairTally>> tallies(chunks.size());
  parallel_chunks(chunks.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const Chunk& chunk = chunks[begin];
    BundleAccumulator accumulator(maps, model, state, options);
    const std::span<const SurfelMap::Surfel> own(surfels[chunk.view]);
    accumulator.add(chunk.view,
                    own.subspan(chunk.first, std::min(kChunk, own.size() - chunk.first)));
    parts[begin] = std::move(accumulator.sums);
    tallies[begin] = std::move(accumulator.tallies);
  });
  BundleSums all = BundleAccumulator(maps, model, state, options).sums;
  all.pairs.resize(maps.size() * maps.size());
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    for (std::size_t to = 0; to < maps.size(); ++to) {
      PairTally& pair = all.pairs[chunks[chunk].view * maps.size() + to];
      pair.agree += tallies[chunk][to].agree;
      pair.violations += tallies[chunk][to].violations;
    }
  }
  for (const BundleSums& part : parts) {
    all.hessian += part.hessian;
    all.gradient += part.gradient;
    all.closing_weight += part.closing_weight;
    all.closing_gradient += part.closing_gradient;
    all.distances_mm.insert(
        all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
    for (std::size_t view = 0; view < maps.size(); ++view) {
      all.matched[view] += part.matched[view];
      all.observed[view] += part.observed[view];
    }
  }
  return all;
}

}  // namespace frangia
