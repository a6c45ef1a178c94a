#include "frangia/registration/register_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/solve_symmetric.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {
namespace {

constexpr float kSameSide = 0.7F;  // cosine between normals of one surface
constexpr std::size_t kSurfels = 3000;

struct Sums {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  std::vector<double> distances_mm;
  std::size_t matched = 0;
  std::size_t surfels = 0;
};

struct Poses {
  std::vector<SurfelMap> maps;
  std::vector<std::vector<SurfelMap::Surfel>> surfels;
  std::vector<Eigen::Isometry3d> rig_from_world;
  FastCameraModel model;
  double gate_mm = 0.0;
};

/// The unit of a row's slope by a small move and turn of a point's view.
Eigen::Matrix<double, 6, 1> jacobian_row(const Eigen::Vector3d& normal,
                                         const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 6, 1> row;
  row << normal, point.cross(normal);
  return row;
}

void add_row(Sums& sums,
             const std::pair<std::size_t, std::size_t>& views,
             const Eigen::Matrix<double, 12, 1>& row,
             double weight,
             double distance) {
  const std::array<std::size_t, 2> view{views.first, views.second};
  for (std::size_t a = 0; a < 2; ++a) {
    if (view.at(a) == 0) continue;  // held
    const auto at = static_cast<Eigen::Index>(6 * (view.at(a) - 1));
    const auto part = row.segment<6>(static_cast<Eigen::Index>(6 * a));
    sums.gradient.segment<6>(at) += weight * distance * part;
    for (std::size_t b = 0; b < 2; ++b) {
      if (view.at(b) == 0) continue;
      const auto to = static_cast<Eigen::Index>(6 * (view.at(b) - 1));
      sums.hessian.block<6, 6>(at, to) +=
          weight * part * row.segment<6>(static_cast<Eigen::Index>(6 * b)).transpose();
    }
  }
}

/// The surfel of another view that a point of the world falls on, or null.
const SurfelMap::Surfel* target_of(const Poses& poses,
                                   std::size_t to,
                                   const Eigen::Vector3d& seen) {
  if (!(seen.z() > 0.0)) return nullptr;
  const Eigen::Vector3f point = seen.cast<float>();
  float u = 0.0F;
  float v = 0.0F;
  poses.model.project(point.x(), point.y(), point.z(), u, v);
  const auto stride = static_cast<float>(poses.maps[to].stride);
  const Image<SurfelMap::Surfel>& targets = poses.maps[to].surfels;
  const float column = std::round(u / stride);
  const float row = std::round(v / stride);
  const bool within = column >= 0.0F && row >= 0.0F &&
                      column < static_cast<float>(targets.width()) &&
                      row < static_cast<float>(targets.height());
  if (!within) return nullptr;
  const SurfelMap::Surfel& target = targets(static_cast<int>(column), static_cast<int>(row));
  return target.sigma_mm > 0.0F ? &target : nullptr;
}

/// Whether a surfel lies on a surface that view `to` saw; if so its pair is added.
bool add_pair(Sums& sums,
              const Poses& poses,
              const SurfelMap::Surfel& surfel,
              std::size_t from,
              std::size_t to) {
  const Eigen::Isometry3d world_from = poses.rig_from_world[from].inverse();
  const Eigen::Vector3d point = world_from * surfel.point_mm.cast<double>();
  const Eigen::Vector3d facing = world_from.linear() * surfel.normal.cast<double>();
  const SurfelMap::Surfel* target = target_of(poses, to, poses.rig_from_world[to] * point);
  if (target == nullptr) return false;
  const Eigen::Isometry3d world_to = poses.rig_from_world[to].inverse();
  const Eigen::Vector3d facing_it = world_to.linear() * target->normal.cast<double>();
  if (facing_it.dot(facing) < static_cast<double>(kSameSide)) return false;
  const Eigen::Vector3d normal = (facing + facing_it).normalized();
  const Eigen::Vector3d foot = world_to * target->point_mm.cast<double>();
  const double distance = normal.dot(point - foot);
  if (!(std::abs(distance) < poses.gate_mm)) return false;
  const double ratio = distance / poses.gate_mm;
  const double tukey_weight = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
  const double weight = tukey_weight / (std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                                        std::pow(static_cast<double>(target->sigma_mm), 2));
  Eigen::Matrix<double, 12, 1> row;
  row << jacobian_row(normal, point), -jacobian_row(normal, foot);
  add_row(sums, {from, to}, row, weight, distance);
  sums.distances_mm.push_back(std::abs(distance));
  return true;
}

Sums sum_all(const Poses& poses) {
  const auto unknowns = static_cast<Eigen::Index>(6 * (poses.maps.size() - 1));
  Sums sums{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns), {}, 0, 0};
  for (std::size_t from = 0; from < poses.maps.size(); ++from) {
    for (const SurfelMap::Surfel& surfel : poses.surfels[from]) {
      bool matched = false;
      for (std::size_t to = 0; to < poses.maps.size(); ++to)
        matched = (to != from && add_pair(sums, poses, surfel, from, to)) || matched;
      sums.matched += matched ? 1U : 0U;
      ++sums.surfels;
    }
  }
  return sums;
}

void move(Poses& poses, const Eigen::VectorXd& step) {
  for (std::size_t view = 1; view < poses.rig_from_world.size(); ++view) {
    const auto part = step.segment<6>(static_cast<Eigen::Index>(6 * (view - 1)));
    const Eigen::Vector3d turn = part.tail<3>();
    Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
      by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    by.translation() = part.head<3>();
    poses.rig_from_world[view] = poses.rig_from_world[view] * by.inverse();
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

Poses make_poses(const ViewStore& views,
                 std::vector<SurfelMap> maps,
                 const CameraModel& camera,
                 double reach_mm) {
  Poses poses{std::move(maps), {}, {}, FastCameraModel(camera), reach_mm};
  for (std::size_t i = 0; i < views.size(); ++i) {
    poses.surfels.push_back(pick_surfels(poses.maps[i], kSurfels));
    poses.rig_from_world.push_back(views.rig_from_object(i));
  }
  return poses;
}

}  // namespace

PosesReport register_poses(ViewStore& views,
                           std::vector<SurfelMap> maps,
                           const CameraModel& camera,
                           const RegisterPosesOptions& options,
                           const Run& run) {
  require(maps.size() == views.size(), "register_poses: each view needs its map");
  PosesReport report;
  if (views.size() < 2) return report;
  Poses poses = make_poses(views, std::move(maps), camera, options.reach_mm);
  constexpr double kTukey = 4.685 * 1.4826;
  constexpr double kFewest = 0.05;  // of all surfels: fewer pairs are chance
  for (int i = 0; i < options.max_iterations; ++i) {
    run.check();
    Sums sums = sum_all(poses);
    if (static_cast<double>(sums.matched) < kFewest * static_cast<double>(sums.surfels)) {
      run.warn("the scans do not overlap where they are said to be: their poses are kept");
      return report;
    }
    if (i == 0) report.rms_before_mm = rms(sums.distances_mm);
    report.rms_after_mm = rms(sums.distances_mm);
    report.overlap = static_cast<double>(sums.matched) / static_cast<double>(sums.surfels);
    // What overlaps nothing stays where it is.
    sums.hessian.diagonal().array() += 1e-9 * sums.hessian.diagonal().maxCoeff();
    const Eigen::VectorXd step = -solve_symmetric(sums.hessian, sums.gradient);
    move(poses, step);
    report.iterations = i + 1;
    const double gate = std::min(poses.gate_mm, kTukey * median(sums.distances_mm));
    const bool gate_converged = gate > 0.95 * poses.gate_mm;
    poses.gate_mm = gate;
    if (gate_converged && step.dot(sums.hessian * step) < 1e-2) break;
  }
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, poses.rig_from_world[i]);
  return report;
}

std::string PosesReport::text() const {
  return fmt::format(
      "scans agree to {:.3g} mm RMS (before: {:.3g} mm), {:.0f} % of their points overlap",
      rms_after_mm,
      rms_before_mm,
      100.0 * overlap);
}

}  // namespace frangia
