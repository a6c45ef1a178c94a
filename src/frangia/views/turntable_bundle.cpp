#include "frangia/views/turntable_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr float kSameSide = 0.7F;  // cosine between normals of one surface
constexpr std::size_t kChunk = 512;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// How points of one view go into another, and how that changes with the unknowns.
struct Turn {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d centre;
  Eigen::Vector3d axis;
  Eigen::Matrix<double, 3, 2> sideways;

  Turn(const TableState& state, std::size_t from, std::size_t to)
      : rotation(Eigen::AngleAxisd(state.angles_rad[to] - state.angles_rad[from], state.table.axis)
                     .matrix()),
        centre(state.table.point_mm),
        axis(state.table.axis),
        sideways(across(state.table)) {}

  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const {
    return centre + rotation * (point - centre);
  }
  /// Of normal . point by the two tilts, the two shifts, and the angle between the views.
  [[nodiscard]] Eigen::Matrix<double, 1, 5> slope(const Eigen::Vector3d& normal,
                                                  const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = point - centre;
    const Eigen::Vector3d turned = rotation * arm;
    Eigen::Matrix<double, 1, 5> row;
    row.head<2>() =
        normal.transpose() * (rotation * cross_matrix(arm) - cross_matrix(turned)) * sideways;
    row.segment<2>(2) = (normal - rotation.transpose() * normal).transpose() * sideways;
    row[4] = normal.dot(axis.cross(turned));
    return row;
  }
};

/// One chunk of a view's spots against all other views.
struct Summer {
  std::span<const PlaneMap> maps;
  const FastLens& lens;
  const TableState& state;
  double gate_mm;
  BundleSums sums;

  Summer(std::span<const PlaneMap> all, const FastLens& camera, const TableState& now, double gate)
      : maps(all), lens(camera), state(now), gate_mm(gate) {
    const auto unknowns = static_cast<Eigen::Index>(all.size() + 3);
    sums.hessian = Eigen::MatrixXd::Zero(unknowns, unknowns);
    sums.gradient = Eigen::VectorXd::Zero(unknowns);
    sums.met.assign(all.size(), 0);
    sums.faced.assign(all.size(), 0);
  }

  void add(std::size_t from, std::span<const PlaneMap::Spot> spots) {
    std::vector<Turn> turns;
    for (std::size_t to = 0; to < maps.size(); ++to)
      turns.emplace_back(state, from, to);
    for (const PlaneMap::Spot& spot : spots) {
      bool faced = false;
      bool met = false;
      for (std::size_t to = 0; to < maps.size(); ++to) {
        if (to == from) continue;
        const double distance = add_pair(spot, turns[to], from, to);
        faced = faced || !std::isnan(distance);
        met = met || distance < gate_mm;
      }
      sums.faced[from] += faced ? 1 : 0;
      sums.met[from] += met ? 1 : 0;
    }
  }

  /// Returns how far apart they are; NaN when the other view does not look there.
  double add_pair(const PlaneMap::Spot& spot, const Turn& turn, std::size_t from, std::size_t to) {
    const Eigen::Vector3d point = turn.apply(spot.point_mm.cast<double>());
    const Eigen::Vector3d facing = turn.rotation * spot.normal.cast<double>();
    if (facing.dot(point) >= 0.0) return std::nan("");
    const auto seen = point.cast<float>();
    float u = 0.0F;
    float v = 0.0F;
    lens.project(seen.x(), seen.y(), seen.z(), u, v);
    const auto stride = static_cast<float>(maps[to].stride);
    const float column = std::round(u / stride);
    const float row = std::round(v / stride);
    const Image<PlaneMap::Spot>& targets = maps[to].spots;
    if (!(column >= 0.0F && row >= 0.0F && column < static_cast<float>(targets.width()) &&
          row < static_cast<float>(targets.height()))) {
      return std::nan("");
    }
    const PlaneMap::Spot& target = targets(static_cast<int>(column), static_cast<int>(row));
    const Eigen::Vector3d facing_it = target.normal.cast<double>();
    if (target.sigma_mm == 0.0F || facing_it.dot(facing) < kSameSide) return std::nan("");
    // Along the mean of both normals the distance is that of the surfaces, curved or not: what one
    // plane leaves its surface by on one side, the other leaves its own by on the other.
    const Eigen::Vector3d normal = (facing_it + facing).normalized();
    const double distance = normal.dot(point - target.point_mm.cast<double>());
    if (!(std::abs(distance) < gate_mm)) return std::abs(distance);

    const double ratio = distance / gate_mm;
    const double trust = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    const double weight = trust / (std::pow(static_cast<double>(spot.sigma_mm), 2) +
                                   std::pow(static_cast<double>(target.sigma_mm), 2));
    const Eigen::Matrix<double, 1, 5> slope = turn.slope(normal, spot.point_mm.cast<double>());
    add_row(slope, weight, distance, from, to);
    const std::size_t last = maps.size() - 1;
    if (last > 1 && std::min(from, to) == 0 && std::max(from, to) == last) {
      const double by_last = to == last ? slope[4] : -slope[4];
      sums.closing_weight += weight * by_last * by_last;
      sums.closing_pull += weight * by_last * distance;
    }
    sums.squares += weight * distance * distance;
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    return std::abs(distance);
  }

  void add_row(const Eigen::Matrix<double, 1, 5>& slope,
               double weight,
               double distance,
               std::size_t from,
               std::size_t to) {
    // The axis, then the angles of both views, turned against each other; view 0 has no unknown.
    std::array<Eigen::Index, 6> places{
        0, 1, 2, 3, static_cast<Eigen::Index>(to) + 3, static_cast<Eigen::Index>(from) + 3};
    const std::array<double, 6> values{slope[0], slope[1], slope[2], slope[3], slope[4], -slope[4]};
    for (std::size_t i = 0; i < 6; ++i) {
      if (places[i] == 3 && i >= 4) continue;
      sums.gradient[places[i]] += weight * values[i] * distance;
      for (std::size_t j = 0; j < 6; ++j) {
        if (places[j] == 3 && j >= 4) continue;
        sums.hessian(places[i], places[j]) += weight * values[i] * values[j];
      }
    }
  }
};

}  // namespace

Eigen::Matrix<double, 3, 2> across(const Turntable& table) {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Index thinnest = 0;
  table.axis.cwiseAbs().minCoeff(&thinnest);
  least[thinnest] = 1.0;
  Eigen::Matrix<double, 3, 2> sides;
  sides.col(0) = table.axis.cross(least).normalized();
  sides.col(1) = table.axis.cross(sides.col(0));
  return sides;
}

BundleSums sum_bundle(std::span<const std::vector<PlaneMap::Spot>> spots,
                      std::span<const PlaneMap> maps,
                      const FastLens& lens,
                      const TableState& state,
                      const BundleOptions& options) {
  struct Chunk {
    std::size_t view;
    std::size_t first;
  };
  std::vector<Chunk> chunks;
  for (std::size_t view = 0; view < spots.size(); ++view) {
    for (std::size_t first = 0; first < spots[view].size(); first += kChunk)
      chunks.push_back({view, first});
  }
  std::vector<BundleSums> parts(chunks.size());
  parallel_chunks(chunks.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const Chunk& chunk = chunks[begin];
    Summer summer(maps, lens, state, options.gate_mm);
    const std::span<const PlaneMap::Spot> own(spots[chunk.view]);
    summer.add(chunk.view, own.subspan(chunk.first, std::min(kChunk, own.size() - chunk.first)));
    parts[begin] = std::move(summer.sums);
  });
  BundleSums all = Summer(maps, lens, state, options.gate_mm).sums;
  for (const BundleSums& part : parts) {
    all.hessian += part.hessian;
    all.gradient += part.gradient;
    all.squares += part.squares;
    all.closing_weight += part.closing_weight;
    all.closing_pull += part.closing_pull;
    all.distances_mm.insert(
        all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
    for (std::size_t view = 0; view < maps.size(); ++view) {
      all.met[view] += part.met[view];
      all.faced[view] += part.faced[view];
    }
  }
  return all;
}

TableState moved(const TableState& state, const Eigen::VectorXd& step) {
  const Eigen::Matrix<double, 3, 2> sides = across(state.table);
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
  return next;
}

}  // namespace frangia
