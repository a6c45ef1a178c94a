#include "frangia/registration/internal/turntable_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr float kSameSide = 0.7F;  // cosine between normals of one surface
constexpr std::size_t kChunk = 512;

/// How the distance of a pair changes with the unknowns.
struct PairJacobian {
  Eigen::Matrix<double, 2, 1> tilt, shift;
  double angle_to = 0.0;
  double angle_from = 0.0;
  Eigen::Matrix<double, 6, 1> setup_to, setup_from;
};

/// How points of one view go into another, and how that changes with the unknowns: back to the
/// table at angle 0, to the part's place in the other setup, and on to the other angle.
struct ViewTransfer {
  Eigen::Matrix3d back, forth;
  Eigen::Isometry3d across_setups;
  Eigen::Matrix3d rotation;  ///< of all three
  Eigen::Vector3d center;
  Eigen::Vector3d axis;
  Eigen::Matrix<double, 3, 2> sideways;

  ViewTransfer(const TableState& state, std::size_t from, std::size_t to)
      : back(Eigen::AngleAxisd(-state.angles_rad[from], state.table.axis).matrix()),
        forth(Eigen::AngleAxisd(state.angles_rad[to], state.table.axis).matrix()),
        across_setups(state.part_pose(state.setup_of(to)) *
                      state.part_pose(state.setup_of(from)).inverse()),
        rotation(forth * across_setups.linear() * back),
        center(state.table.point_mm),
        axis(state.table.axis),
        sideways(perpendicular_directions(state.table)) {}

  /// `point` relative to the table's point, on the table at angle 0.
  [[nodiscard]] Eigen::Vector3d in_other_setup(const Eigen::Vector3d& point) const {
    return across_setups * (back * (point - center) + center) - center;
  }
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const {
    return center + forth * in_other_setup(point);
  }
  [[nodiscard]] PairJacobian jacobian(const Eigen::Vector3d& normal,
                                      const Eigen::Vector3d& point) const {
    const Eigen::Vector3d seen = point - center;
    const Eigen::Vector3d start = back * seen;
    const Eigen::Vector3d end = in_other_setup(point);
    const Eigen::Vector3d arrived = forth * end;
    const Eigen::Vector3d at_end = forth.transpose() * normal;
    const Eigen::Vector3d at_start = across_setups.linear().transpose() * at_end;
    const Eigen::Vector3d at_seen = back.transpose() * at_start;
    const Eigen::Vector3d turned = arrived.cross(normal);
    PairJacobian by;
    by.tilt = sideways.transpose() *
              (turned - end.cross(at_end) + start.cross(at_start) - seen.cross(at_seen));
    by.shift = sideways.transpose() * (normal - at_end + at_start - at_seen);
    by.angle_to = axis.dot(turned);
    by.angle_from = -axis.dot(start.cross(at_start));
    by.setup_to << at_end, end.cross(at_end);
    by.setup_from << -at_start, -start.cross(at_start);
    return by;
  }
};

/// One chunk of a view's surfels against all other views.
struct BundleAccumulator {
  std::span<const SurfelMap> maps;
  const FastCameraModel& model;
  const TableState& state;
  BundleOptions options;
  std::size_t closing;
  BundleSums sums;
  std::vector<PairTally> tallies;  ///< of the view whose surfels are added, by other view

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
    std::vector<ViewTransfer> turns;
    for (std::size_t to = 0; to < maps.size(); ++to)
      turns.emplace_back(state, from, to);
    for (const SurfelMap::Surfel& surfel : surfels) {
      bool observed = false;
      bool matched = false;
      for (std::size_t to = 0; to < maps.size(); ++to) {
        if (to == from || to == options.left_out) continue;
        const double distance = add_pair(surfel, turns[to], from, to);
        observed = observed || !std::isnan(distance);
        matched = matched || distance < options.gate_mm;
      }
      sums.observed[from] += observed ? 1 : 0;
      sums.matched[from] += matched ? 1 : 0;
    }
  }

  /// Returns how far apart they are; NaN when the other view does not look there.
  double add_pair(const SurfelMap::Surfel& surfel,
                  const ViewTransfer& turn,
                  std::size_t from,
                  std::size_t to) {
    const Eigen::Vector3d point = turn.apply(surfel.point_mm.cast<double>());
    const Eigen::Vector3d facing = turn.rotation * surfel.normal.cast<double>();
    if (!(point.z() > 0.0)) return std::nan("");
    const auto seen = point.cast<float>();
    float u = 0.0F;
    float v = 0.0F;
    model.project(seen.x(), seen.y(), seen.z(), u, v);
    const auto stride = static_cast<float>(maps[to].stride);
    const float column = std::round(u / stride);
    const float row = std::round(v / stride);
    const Image<SurfelMap::Surfel>& targets = maps[to].surfels;
    if (!(column >= 0.0F && row >= 0.0F && column < static_cast<float>(targets.width()) &&
          row < static_cast<float>(targets.height()))) {
      return std::nan("");
    }
    const SurfelMap::Surfel& target = targets(static_cast<int>(column), static_cast<int>(row));
    const Eigen::Vector3d facing_it = target.normal.cast<double>();
    if (target.sigma_mm == 0.0F) return std::nan("");
    const Eigen::Vector3d away = point - target.point_mm.cast<double>();
    const bool before = facing_it.dot(away) > options.free_space_margin_mm &&
                        -away.z() > options.free_space_margin_mm;
    tallies[to].violations += before ? 1 : 0;
    if (facing.dot(point) >= 0.0 || facing_it.dot(facing) < kSameSide) return std::nan("");
    // Along the mean of both normals the distance is that of the surfaces, curved or not: what one
    // plane leaves its surface by on one side, the other leaves its own by on the other.
    const Eigen::Vector3d normal = (facing_it + facing).normalized();
    const double distance = normal.dot(away);
    if (!(std::abs(distance) < options.gate_mm)) return std::abs(distance);
    ++tallies[to].agree;
    const double ratio = distance / options.gate_mm;
    const double tukey_weight = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    const double weight = tukey_weight / (std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                                          std::pow(static_cast<double>(target.sigma_mm), 2));
    const PairJacobian jacobian = turn.jacobian(normal, surfel.point_mm.cast<double>());
    add_row(jacobian, weight, distance, from, to);
    if (closing > 1 && std::min(from, to) == 0 && std::max(from, to) == closing) {
      const double by_last = to == closing ? jacobian.angle_to : jacobian.angle_from;
      sums.closing_weight += weight * by_last * by_last;
      sums.closing_gradient += weight * by_last * distance;
    }
    sums.squares += weight * distance * distance;
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

std::size_t TableState::closing_view() const {
  std::size_t last = 0;
  for (std::size_t view = 0; view < angles_rad.size(); ++view)
    if (setup_of(view) == 0) last = view;
  return last;
}

Eigen::Matrix<double, 3, 2> perpendicular_directions(const Turntable& table) {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Index thinnest = 0;
  table.axis.cwiseAbs().minCoeff(&thinnest);
  least[thinnest] = 1.0;
  Eigen::Matrix<double, 3, 2> sides;
  sides.col(0) = table.axis.cross(least).normalized();
  sides.col(1) = table.axis.cross(sides.col(0));
  return sides;
}

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
    all.squares += part.squares;
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

TableState apply_update(const TableState& state, const Eigen::VectorXd& step) {
  const Eigen::Matrix<double, 3, 2> sides = perpendicular_directions(state.table);
  TableState next = state;
  const Eigen::Vector3d tilt = sides * step.head<2>();
  if (tilt.norm() > 0.0) {
    next.table.axis = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * state.table.axis;
    next.table.axis.normalize();
  }
  next.table.point_mm += sides * step.segment<2>(2);
  for (std::size_t view = 1; view < state.angles_rad.size(); ++view) {
    next.angles_rad[view] += step[static_cast<Eigen::Index>(view) + 3];
  }
  const Eigen::Vector3d& center = state.table.point_mm;  // not yet moved, as the jacobian have it
  for (std::size_t setup = 1; setup <= state.part_poses.size(); ++setup) {
    const auto part = step.segment<6>(state.index_of_setup(setup));
    const Eigen::Vector3d turn = part.tail<3>();
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
      move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    move.translation() = center + part.head<3>() - move.linear() * center;
    next.part_poses[setup - 1] = move * state.part_poses[setup - 1];
  }
  return next;
}

}  // namespace frangia
