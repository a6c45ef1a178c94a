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

/// The views that are compared, in one state.
struct BundleViews {
  std::span<const SurfelMap> maps;
  const FastCameraModel& model;
  const TableState& state;
  const ViewPairs& pairs;
};

/// Sums over one chunk of a view's surfels.
struct ChunkSums {
  std::vector<Eigen::Index> unknowns;  ///< that these surfels depend on, ascending
  Eigen::MatrixXd hessian;             ///< of these unknowns alone
  Eigen::VectorXd gradient;
  Eigen::VectorXd by_offset;  ///< sum of w J
  double closing_weight = 0.0;
  double closing_gradient = 0.0;
  std::vector<float> distances_mm;
  std::vector<float> over_sigma;
  std::size_t matched = 0;
  std::size_t observed = 0;
  std::vector<PairTally> tallies;  ///< by paired view
};

/// The unknowns that the pairs of a view depend on, in ascending order.
std::vector<Eigen::Index> unknowns_of(const BundleViews& views, std::size_t from) {
  std::vector<Eigen::Index> unknowns{0, 1, 2, 3};
  const auto add_view = [&](std::size_t view) {
    if (view != 0) unknowns.push_back(static_cast<Eigen::Index>(view) + 3);
    const std::size_t setup = views.state.setup_of(view);
    if (setup == 0) return;
    for (Eigen::Index i = 0; i < 6; ++i)
      unknowns.push_back(views.state.index_of_setup(setup) + i);
  };
  add_view(from);
  for (const std::size_t to : views.pairs[from])
    add_view(to);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

/// Derivatives of a pair by axis, angles and, between setups, the poses of the part: the columns of
/// `PairJacobian` in their order, of which the first six are those within one setup.
using PairRow = Eigen::Matrix<double, 18, 1>;
constexpr Eigen::Index kWithinSetup = 6;

PairRow row_of(const PairJacobian& by) {
  PairRow row;
  row << by.tilt, by.shift, by.angle_to, by.angle_from, by.setup_to, by.setup_from;
  return row;
}

/// Sums over the pairs with one view, in the columns of a `PairRow`.
struct PairedSums {
  Eigen::Matrix<double, 18, 18> hessian = Eigen::Matrix<double, 18, 18>::Zero();
  PairRow gradient = PairRow::Zero();
  PairRow by_offset = PairRow::Zero();

  /// @shape    `count`: of the columns that may differ from 0
  template <Eigen::Index count>
  void add(const PairRow& by, double weight, double distance) {
    const Eigen::Matrix<double, count, 1> row = by.head<count>();
    const Eigen::Matrix<double, count, 1> weighted = weight * row;
    hessian.topLeftCorner<count, count>() += weighted * row.transpose();
    gradient.head<count>() += distance * weighted;
    by_offset.head<count>() += weighted;
  }
};

/// Sums one chunk of a view's surfels over its paired views.
struct BundleAccumulator {
  const BundleViews& views;
  BundleOptions options;
  std::size_t from;
  std::size_t closing;
  ChunkSums sums;
  std::vector<PairedSums> paired_sums;  ///< by paired view

  BundleAccumulator(const BundleViews& all, const BundleOptions& how, std::size_t view)
      : views(all), options(how), from(view), closing(all.state.closing_view()) {
    sums.unknowns = unknowns_of(all, view);
    const auto count = static_cast<Eigen::Index>(sums.unknowns.size());
    sums.hessian = Eigen::MatrixXd::Zero(count, count);
    sums.gradient = Eigen::VectorXd::Zero(count);
    sums.by_offset = Eigen::VectorXd::Zero(count);
    sums.tallies.resize(all.pairs[view].size());
    paired_sums.resize(all.pairs[view].size());
  }

  void add(std::span<const SurfelMap::Surfel> surfels) {
    const std::vector<std::size_t>& others = views.pairs[from];
    std::vector<ViewTransfer> transfers;
    for (const std::size_t to : others)
      transfers.emplace_back(views.state, from, to);
    for (const SurfelMap::Surfel& surfel : surfels) {
      bool observed = false;
      bool matched = false;
      for (std::size_t i = 0; i < others.size(); ++i) {
        const double distance = add_pair(surfel, transfers[i], i);
        observed = observed || !std::isnan(distance);
        matched = matched || distance < options.gate_mm;
      }
      sums.observed += observed ? 1 : 0;
      sums.matched += matched ? 1 : 0;
    }
    for (std::size_t i = 0; i < others.size(); ++i)
      add_paired(paired_sums[i], others[i]);
  }

  /// Returns the absolute distance of a pair; NaN when the other view measured nothing there.
  double add_pair(const SurfelMap::Surfel& surfel,
                  const ViewTransfer& transfer,
                  std::size_t paired) {
    const std::size_t to = views.pairs[from][paired];
    PairTally& tally = sums.tallies[paired];
    const Eigen::Vector3d point = transfer.apply(surfel.point_mm.cast<double>());
    const SurfelMap::Surfel* target = surfel_at(views.maps[to], views.model, point);
    if (target == nullptr) return std::nan("");
    const Eigen::Vector3d facing = transfer.rotation() * surfel.normal.cast<double>();
    const SurfelPair pair(point, facing, *target);
    const double variance = std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                            std::pow(static_cast<double>(target->sigma_mm), 2);
    tally.violations +=
        pair.violates_free_space(SurfelPair::margin_mm(options.free_space_margin_mm, variance))
            ? 1U
            : 0U;
    if (facing.dot(point) >= 0.0 || !pair.faces_alike()) return std::nan("");
    const double distance = pair.distance_mm();
    if (!(std::abs(distance) < options.gate_mm)) return std::abs(distance);
    const double weight = tukey_weight(distance, options.gate_mm) / variance;
    const PairJacobian jacobian = transfer.jacobian(
        pair.normal,
        surfel.point_mm.cast<double>() - 0.5 * (transfer.rotation().transpose() * pair.offset));
    if (views.state.setup_of(to) == views.state.setup_of(from)) {
      paired_sums[paired].add<kWithinSetup>(row_of(jacobian), weight, distance);
    } else {
      paired_sums[paired].add<PairRow::RowsAtCompileTime>(row_of(jacobian), weight, distance);
    }
    tally.add({1, 0, weight, weight * distance});
    if (closing > 1 && std::min(from, to) == 0 && std::max(from, to) == closing) {
      const double by_last = to == closing ? jacobian.angle_to : jacobian.angle_from;
      sums.closing_weight += weight * by_last * by_last;
      sums.closing_gradient += weight * by_last * distance;
    }
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    sums.over_sigma.push_back(static_cast<float>(std::abs(distance) / std::sqrt(variance)));
    return std::abs(distance);
  }

  /// Adds the sums with one view at the columns of its unknowns; what is held has none.
  void add_paired(const PairedSums& paired, std::size_t to) {
    const TableState& state = views.state;
    std::array<Eigen::Index, 18> columns{0, 1, 2, 3};
    const auto column_of = [&](bool is_held, Eigen::Index unknown) {
      if (is_held) return Eigen::Index{-1};
      const auto at = std::lower_bound(sums.unknowns.begin(), sums.unknowns.end(), unknown);
      return static_cast<Eigen::Index>(at - sums.unknowns.begin());
    };
    columns[4] = column_of(to == 0, static_cast<Eigen::Index>(to) + 3);
    columns[5] = column_of(from == 0, static_cast<Eigen::Index>(from) + 3);
    const std::size_t setup_to = state.setup_of(to);
    const std::size_t setup_from = state.setup_of(from);
    const bool within = setup_to == setup_from;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto more = static_cast<Eigen::Index>(i);
      columns.at(6 + i) = column_of(within || setup_to == 0, state.index_of_setup(setup_to) + more);
      columns.at(12 + i) =
          column_of(within || setup_from == 0, state.index_of_setup(setup_from) + more);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Eigen::Index column = columns.at(i);
      if (column < 0) continue;
      const auto own = static_cast<Eigen::Index>(i);
      sums.gradient[column] += paired.gradient[own];
      sums.by_offset[column] += paired.by_offset[own];
      for (std::size_t j = 0; j < columns.size(); ++j) {
        if (columns.at(j) >= 0)
          sums.hessian(columns.at(j), column) += paired.hessian(static_cast<Eigen::Index>(j), own);
      }
    }
  }
};

/// Adds the sums of a chunk of view `from`, in one of its regions, and releases its distances.
void add_chunk(BundleSums& all,
               std::size_t from,
               std::size_t region,
               const std::vector<std::size_t>& others,
               ChunkSums& part) {
  const auto count = static_cast<Eigen::Index>(part.unknowns.size());
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Index column = part.unknowns[static_cast<std::size_t>(j)];
    all.gradient[column] += part.gradient[j];
    all.region_gradients(column, static_cast<Eigen::Index>(kRegionsPerView * from + region)) +=
        part.by_offset[j];
    for (Eigen::Index i = 0; i < count; ++i)
      all.hessian(part.unknowns[static_cast<std::size_t>(i)], column) += part.hessian(i, j);
  }
  all.closing_weight += part.closing_weight;
  all.closing_gradient += part.closing_gradient;
  all.distances_mm.insert(
      all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
  part.distances_mm = {};
  all.over_sigma.insert(all.over_sigma.end(), part.over_sigma.begin(), part.over_sigma.end());
  part.over_sigma = {};
  all.matched[from] += part.matched;
  all.observed[from] += part.observed;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::size_t pair = from * all.matched.size() + others[i];
    all.regions[kRegionsPerView * pair + region].add(part.tallies[i]);
  }
}

}  // namespace

std::vector<SurfelChunk> chunks_of(std::span<const std::vector<SurfelMap::Surfel>> surfels) {
  constexpr std::size_t kMost = 512;  // fixed, so that sums do not depend on threads
  std::vector<SurfelChunk> chunks;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    const std::size_t count = surfels[view].size();
    for (std::size_t region = 0; region < kRegionsPerView; ++region) {
      const std::size_t end = count * (region + 1) / kRegionsPerView;
      for (std::size_t first = count * region / kRegionsPerView; first < end; first += kMost)
        chunks.push_back({view, region, first, std::min(kMost, end - first)});
    }
  }
  return chunks;
}

BundleSums sum_bundle(std::span<const std::vector<SurfelMap::Surfel>> surfels,
                      std::span<const SurfelMap> maps,
                      const FastCameraModel& model,
                      const TableState& state,
                      const ViewPairs& pairs,
                      const BundleOptions& options) {
  const BundleViews views{maps, model, state, pairs};
  const std::vector<SurfelChunk> chunks = chunks_of(surfels);
  std::vector<ChunkSums> parts(chunks.size());
  parallel_chunks(chunks.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const SurfelChunk& chunk = chunks[begin];
    BundleAccumulator accumulator(views, options, chunk.view);
    const std::span<const SurfelMap::Surfel> own(surfels[chunk.view]);
    accumulator.add(own.subspan(chunk.first, chunk.count));
    parts[begin] = std::move(accumulator.sums);
  });
  BundleSums all;
  all.hessian = Eigen::MatrixXd::Zero(state.unknowns(), state.unknowns());
  all.gradient = Eigen::VectorXd::Zero(state.unknowns());
  all.region_gradients = Eigen::MatrixXd::Zero(
      state.unknowns(), static_cast<Eigen::Index>(kRegionsPerView * maps.size()));
  all.matched.assign(maps.size(), 0);
  all.observed.assign(maps.size(), 0);
  all.regions.resize(kRegionsPerView * maps.size() * maps.size());
  std::size_t distances = 0;
  for (const ChunkSums& part : parts)
    distances += part.distances_mm.size();
  all.distances_mm.reserve(distances);
  all.over_sigma.reserve(distances);
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    const SurfelChunk& of = chunks[chunk];
    add_chunk(all, of.view, of.region, pairs[of.view], parts[chunk]);
  }
  return all;
}

}  // namespace frangia
