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

/// How the distance of a pair changes with the unknowns.
struct Slopes {
  Eigen::Matrix<double, 2, 1> tilt, shift;
  double angle_to = 0.0;
  double angle_from = 0.0;
  Eigen::Matrix<double, 6, 1> round_to, round_from;
};

/// How points of one view go into another, and how that changes with the unknowns: back to the
/// table at angle 0, to the part's place in the other round, and on to the other angle.
struct Turn {
  Eigen::Matrix3d back, forth;
  Eigen::Isometry3d across_rounds;
  Eigen::Matrix3d rotation;  ///< of all three
  Eigen::Vector3d centre;
  Eigen::Vector3d axis;
  Eigen::Matrix<double, 3, 2> sideways;

  Turn(const TableState& state, std::size_t from, std::size_t to)
      : back(Eigen::AngleAxisd(-state.angles_rad[from], state.table.axis).matrix()),
        forth(Eigen::AngleAxisd(state.angles_rad[to], state.table.axis).matrix()),
        across_rounds(state.placing(state.round_of(to)) *
                      state.placing(state.round_of(from)).inverse()),
        rotation(forth * across_rounds.linear() * back),
        centre(state.table.point_mm),
        axis(state.table.axis),
        sideways(across(state.table)) {}

  /// `point` relative to the table's point, on the table at angle 0.
  [[nodiscard]] Eigen::Vector3d placed(const Eigen::Vector3d& point) const {
    return across_rounds * (back * (point - centre) + centre) - centre;
  }
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const {
    return centre + forth * placed(point);
  }
  [[nodiscard]] Slopes slopes(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) const {
    const Eigen::Vector3d seen = point - centre;
    const Eigen::Vector3d start = back * seen;
    const Eigen::Vector3d end = placed(point);
    const Eigen::Vector3d arrived = forth * end;
    const Eigen::Vector3d at_end = forth.transpose() * normal;
    const Eigen::Vector3d at_start = across_rounds.linear().transpose() * at_end;
    const Eigen::Vector3d at_seen = back.transpose() * at_start;
    const Eigen::Vector3d turned = arrived.cross(normal);
    Slopes by;
    by.tilt = sideways.transpose() *
              (turned - end.cross(at_end) + start.cross(at_start) - seen.cross(at_seen));
    by.shift = sideways.transpose() * (normal - at_end + at_start - at_seen);
    by.angle_to = axis.dot(turned);
    by.angle_from = -axis.dot(start.cross(at_start));
    by.round_to << at_end, end.cross(at_end);
    by.round_from << -at_start, -start.cross(at_start);
    return by;
  }
};

/// One chunk of a view's spots against all other views.
struct Summer {
  std::span<const PlaneMap> maps;
  const FastLens& lens;
  const TableState& state;
  BundleOptions options;
  std::size_t closing;
  BundleSums sums;
  std::vector<PairTally> tallies;  ///< of the view whose spots are added, by other view

  Summer(std::span<const PlaneMap> all,
         const FastLens& camera,
         const TableState& now,
         const BundleOptions& how)
      : maps(all), lens(camera), state(now), options(how), closing(now.closing_view()) {
    const Eigen::Index unknowns = now.unknowns();
    sums.hessian = Eigen::MatrixXd::Zero(unknowns, unknowns);
    sums.gradient = Eigen::VectorXd::Zero(unknowns);
    sums.met.assign(all.size(), 0);
    sums.faced.assign(all.size(), 0);
    tallies.resize(all.size());
  }

  void add(std::size_t from, std::span<const PlaneMap::Spot> spots) {
    std::vector<Turn> turns;
    for (std::size_t to = 0; to < maps.size(); ++to)
      turns.emplace_back(state, from, to);
    for (const PlaneMap::Spot& spot : spots) {
      bool faced = false;
      bool met = false;
      for (std::size_t to = 0; to < maps.size(); ++to) {
        if (to == from || to == options.left_out) continue;
        const double distance = add_pair(spot, turns[to], from, to);
        faced = faced || !std::isnan(distance);
        met = met || distance < options.gate_mm;
      }
      sums.faced[from] += faced ? 1 : 0;
      sums.met[from] += met ? 1 : 0;
    }
  }

  /// Returns how far apart they are; NaN when the other view does not look there.
  double add_pair(const PlaneMap::Spot& spot, const Turn& turn, std::size_t from, std::size_t to) {
    const Eigen::Vector3d point = turn.apply(spot.point_mm.cast<double>());
    const Eigen::Vector3d facing = turn.rotation * spot.normal.cast<double>();
    if (!(point.z() > 0.0)) return std::nan("");
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
    if (target.sigma_mm == 0.0F) return std::nan("");
    const Eigen::Vector3d away = point - target.point_mm.cast<double>();
    const bool before = facing_it.dot(away) > options.through_mm && -away.z() > options.through_mm;
    tallies[to].against += before ? 1 : 0;
    if (facing.dot(point) >= 0.0 || facing_it.dot(facing) < kSameSide) return std::nan("");
    // Along the mean of both normals the distance is that of the surfaces, curved or not: what one
    // plane leaves its surface by on one side, the other leaves its own by on the other.
    const Eigen::Vector3d normal = (facing_it + facing).normalized();
    const double distance = normal.dot(away);
    if (!(std::abs(distance) < options.gate_mm)) return std::abs(distance);
    ++tallies[to].agree;
    const double ratio = distance / options.gate_mm;
    const double trust = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    const double weight = trust / (std::pow(static_cast<double>(spot.sigma_mm), 2) +
                                   std::pow(static_cast<double>(target.sigma_mm), 2));
    const Slopes slopes = turn.slopes(normal, spot.point_mm.cast<double>());
    add_row(slopes, weight, distance, from, to);
    if (closing > 1 && std::min(from, to) == 0 && std::max(from, to) == closing) {
      const double by_last = to == closing ? slopes.angle_to : slopes.angle_from;
      sums.closing_weight += weight * by_last * by_last;
      sums.closing_pull += weight * by_last * distance;
    }
    sums.squares += weight * distance * distance;
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    return std::abs(distance);
  }

  /// The unknowns that a pair depends on.
  struct Row {
    std::array<Eigen::Index, 18> places{};
    std::array<double, 18> values{};
    std::size_t count = 0;

    void add(Eigen::Index place, double value) {
      places.at(count) = place;
      values.at(count++) = value;
    }
  };

  [[nodiscard]] Row row_of(const Slopes& by, std::size_t from, std::size_t to) const {
    Row row;
    for (Eigen::Index i = 0; i < 2; ++i) {
      row.add(i, by.tilt[i]);
      row.add(i + 2, by.shift[i]);
    }
    if (to != 0) row.add(static_cast<Eigen::Index>(to) + 3, by.angle_to);
    if (from != 0) row.add(static_cast<Eigen::Index>(from) + 3, by.angle_from);
    const std::size_t round_to = state.round_of(to);
    const std::size_t round_from = state.round_of(from);
    if (round_to == round_from) return row;
    for (Eigen::Index i = 0; i < 6; ++i) {
      if (round_to != 0) row.add(state.place_of_round(round_to) + i, by.round_to[i]);
      if (round_from != 0) row.add(state.place_of_round(round_from) + i, by.round_from[i]);
    }
    return row;
  }

  void add_row(const Slopes& by, double weight, double distance, std::size_t from, std::size_t to) {
    const Row row = row_of(by, from, to);
    for (std::size_t i = 0; i < row.count; ++i) {
      sums.gradient[row.places[i]] += weight * row.values[i] * distance;
      for (std::size_t j = 0; j < row.count; ++j)
        sums.hessian(row.places[i], row.places[j]) += weight * row.values[i] * row.values[j];
    }
  }
};

}  // namespace

std::size_t TableState::closing_view() const {
  std::size_t last = 0;
  for (std::size_t view = 0; view < angles_rad.size(); ++view)
    if (round_of(view) == 0) last = view;
  return last;
}

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
    if (view == options.left_out) continue;
    for (std::size_t first = 0; first < spots[view].size(); first += kChunk)
      chunks.push_back({view, first});
  }
  std::vector<BundleSums> parts(chunks.size());
  std::vector<std::vector<PairTally>> tallies(chunks.size());
  parallel_chunks(chunks.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const Chunk& chunk = chunks[begin];
    Summer summer(maps, lens, state, options);
    const std::span<const PlaneMap::Spot> own(spots[chunk.view]);
    summer.add(chunk.view, own.subspan(chunk.first, std::min(kChunk, own.size() - chunk.first)));
    parts[begin] = std::move(summer.sums);
    tallies[begin] = std::move(summer.tallies);
  });
  BundleSums all = Summer(maps, lens, state, options).sums;
  all.pairs.resize(maps.size() * maps.size());
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    for (std::size_t to = 0; to < maps.size(); ++to) {
      PairTally& pair = all.pairs[chunks[chunk].view * maps.size() + to];
      pair.agree += tallies[chunk][to].agree;
      pair.against += tallies[chunk][to].against;
    }
  }
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
  const Eigen::Vector3d& centre = state.table.point_mm;  // not yet moved, as the slopes have it
  for (std::size_t round = 1; round <= state.placings.size(); ++round) {
    const auto part = step.segment<6>(state.place_of_round(round));
    const Eigen::Vector3d turn = part.tail<3>();
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
      move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    move.translation() = centre + part.head<3>() - move.linear() * centre;
    next.placings[round - 1] = move * state.placings[round - 1];
  }
  return next;
}

}  // namespace frangia
