#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/ceres.h>
#include <ceres/cost_function.h>
#include <fmt/format.h>

#include "frangia/calibrate/artifact/internal/artifact_light.h"
#include "frangia/calibrate/artifact/internal/artifact_residuals.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/solve_quietly.h"

namespace frangia {
namespace {

/// Relative standard deviation of a stated diameter: a matting spray adds 10 um to 40 mm.
constexpr double kDiameterSigma = 5e-4;

/// Information about camera, projector, pose and pitch from an earlier calibration.
class RigPrior final : public ceres::CostFunction {
 public:
  RigPrior(Eigen::MatrixXd root, const std::array<double, 25>& mean)
      : root_(std::move(root)), mean_(mean) {
    set_num_residuals(static_cast<int>(root_.rows()));
    *mutable_parameter_block_sizes() = {9, 9, 6, 1};
  }
  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const std::vector<int>& sizes = parameter_block_sizes();
    Eigen::VectorXd change(static_cast<Eigen::Index>(mean_.size()));
    Eigen::Index at = 0;
    for (std::size_t block = 0; block < sizes.size(); ++block) {
      const Eigen::MatrixXd columns = root_.middleCols(at, sizes[block]);
      for (int i = 0; i < sizes[block]; ++i)
        change[at + i] = parameters[block][i] - mean_.at(static_cast<std::size_t>(at + i));
      if (jacobians != nullptr && jacobians[block] != nullptr) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            jacobians[block], columns.rows(), columns.cols()) = columns;
      }
      at += sizes[block];
    }
    Eigen::Map<Eigen::VectorXd>(residuals, root_.rows()) = root_ * change;
    return true;
  }

 private:
  Eigen::MatrixXd root_;
  std::array<double, 25> mean_;
};

constexpr double kHuberSigmas = 3.0;
/// Relative standard deviation of a certified length; it only has to be far below that of the data.
constexpr double kCertified = 1e-5;

/// A block of the adjustment and the names of the parameters that are estimated.
struct FreeBlock {
  double* values;
  std::vector<std::string> names;
};

/// Declares a block. Parameters with an empty name are held.
void add_block(ceres::Problem& problem,
               double* values,
               const std::vector<std::string>& names,
               std::vector<FreeBlock>& blocks) {
  const int size = static_cast<int>(names.size());
  problem.AddParameterBlock(values, size);
  std::vector<int> constant;
  FreeBlock block{values, {}};
  for (int i = 0; i < size; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (name.empty()) {
      constant.push_back(i);
    } else {
      block.names.push_back(name);
    }
  }
  if (block.names.empty()) {
    problem.SetParameterBlockConstant(values);
    return;
  }
  if (!constant.empty())
    problem.SetManifold(values, new ceres::SubsetManifold(size, constant));  // NOLINT owned
  blocks.push_back(std::move(block));
}

std::vector<std::string> intrinsic_names(const char* device, bool free) {
  if (!free) return std::vector<std::string>(9);
  std::vector<std::string> names;
  for (const char* name : {"focal_px",
                           "focal_ratio",
                           "principal_x_px",
                           "principal_y_px",
                           "k1",
                           "k2",
                           "p1",
                           "p2",
                           "k3"})
    names.push_back(fmt::format("{}.{}", device, name));
  return names;
}

/// Declares the blocks of the rig.
void add_rig_blocks(const ArtifactProblem& problem,
                    ArtifactParameters& parameters,
                    ceres::Problem& out,
                    std::vector<FreeBlock>& blocks) {
  const bool angular = problem.start.projector.is_angular();
  add_block(out, parameters.camera.data(), intrinsic_names("camera", problem.free_camera), blocks);
  add_block(out,
            parameters.projector.data(),
            intrinsic_names("projector", !angular && problem.free_intrinsics),
            blocks);
  add_block(out,
            parameters.pose.data(),
            {"projector.rotation_x_rad",
             "projector.rotation_y_rad",
             "projector.rotation_z_rad",
             "projector.x_mm",
             angular ? "" : "projector.y_mm",  // along the fringes
             "projector.z_mm"},
            blocks);
  add_block(out, &parameters.pitch_scale, {angular ? "projector.pitch_scale" : ""}, blocks);
  std::vector<std::string> wavefront(Wavefront::kTerms);
  for (std::size_t i = 0; i < Wavefront::kTerms; ++i) {
    if (problem.free_wavefront.at(i)) wavefront[i] = Wavefront::parameter_name(i);
  }
  add_block(out, parameters.wavefront.data(), wavefront, blocks);
  add_block(out,
            parameters.table.data(),
            {"turntable.tilt_1", "turntable.tilt_2", "turntable.shift_1", "turntable.shift_2"},
            blocks);
}

/// Declares the angles and surfaces of all captures, with what is known of them.
void add_capture_blocks(const ArtifactProblem& problem,
                        const ArtifactNoise& noise,
                        ArtifactParameters& parameters,
                        ceres::Problem& out,
                        std::vector<FreeBlock>& blocks) {
  for (std::size_t c = 0; c < problem.captures.size(); ++c) {
    for (std::size_t v = 0; v < parameters.angle_errors[c].size(); ++v) {
      double* angle = &parameters.angle_errors[c][v];
      // The first view of an artifact defines where it stands.
      add_block(out, angle, {v == 0 ? "" : fmt::format("angle.{}.{}", c, v)}, blocks);
      if (v == 0) continue;
      out.AddResidualBlock(
          cost_function(NumberPrior{0, 0.0, 1.0 / noise.angle_rad}, 1, std::array{1}),
          nullptr,
          angle);
    }
    const auto* balls = std::get_if<Balls>(&problem.captures[c].artifact);
    for (std::size_t s = 0; s < parameters.surfaces[c].size(); ++s) {
      double* surface = parameters.surfaces[c][s].data();
      std::vector<std::string> names(4);
      for (std::size_t i = 0; i < (balls == nullptr ? 3 : names.size()); ++i)
        names[i] = fmt::format("surface.{}.{}.{}", c, s, i);
      add_block(out, surface, names, blocks);
      if (balls == nullptr) continue;
      const double weight = 1.0 / kDiameterSigma;
      out.AddResidualBlock(
          cost_function(NumberPrior{3, 0.0, weight}, 1, std::array{4}), nullptr, surface);
    }
    if (balls == nullptr || !balls->spacing_mm) continue;
    const double spacing = *balls->spacing_mm;
    out.AddResidualBlock(
        cost_function(SpacingResidual{spacing, 1.0 / (kCertified * spacing)}, 1, std::array{4, 4}),
        nullptr,
        parameters.surfaces[c][0].data(),
        parameters.surfaces[c][1].data());
  }
}

void add_views(const ArtifactProblem& problem,
               const ArtifactNoise& noise,
               ArtifactParameters& parameters,
               ceres::Problem& out) {
  const auto* angular = std::get_if<AngularModel>(&problem.start.projector.model);
  for (std::size_t c = 0; c < problem.captures.size(); ++c) {
    for (std::size_t v = 0; v < problem.captures[c].views.size(); ++v) {
      const ArtifactView& view = problem.captures[c].views[v];
      for (std::size_t i = 0; i < view.sites.size(); ++i) {
        const LightSite& site = view.sites[i];
        out.AddResidualBlock(
            cost_function(
                LightResidual{turned_surface(problem, c, view, view.surface[i], site.camera_px),
                              angular,
                              site.light,
                              light_weight(site, noise.light)},
                2,
                std::array{9, 9, 6, 1, int{Wavefront::kTerms}, 4, 1, 4}),
            new ceres::HuberLoss(kHuberSigmas),  // NOLINT(*-owning-memory) the problem owns it
            parameters.camera.data(),
            parameters.projector.data(),
            parameters.pose.data(),
            &parameters.pitch_scale,
            parameters.wavefront.data(),
            parameters.table.data(),
            &parameters.angle_errors[c][v],
            parameters.surfaces[c][static_cast<std::size_t>(view.surface[i])].data());
      }
    }
  }
}

/// Composes the adjustment; returns the blocks that are estimated.
std::vector<FreeBlock> compose(const ArtifactProblem& problem,
                               const ArtifactNoise& noise,
                               ArtifactParameters& parameters,
                               ceres::Problem& out) {
  std::vector<FreeBlock> blocks;
  add_rig_blocks(problem, parameters, out, blocks);
  add_capture_blocks(problem, noise, parameters, out, blocks);
  add_views(problem, noise, parameters, out);
  if (problem.prior.rows() > 0) {
    // NOLINTNEXTLINE(*-owning-memory) the problem owns it
    auto* prior = new RigPrior(problem.prior, problem.prior_mean);
    out.AddResidualBlock(prior,
                         nullptr,
                         parameters.camera.data(),
                         parameters.projector.data(),
                         parameters.pose.data(),
                         &parameters.pitch_scale);
  }
  const bool prior_scale = problem.prior.rows() > 0 && problem.free_intrinsics;
  if (problem.options.baseline_mm || (!problem.has_scale && !prior_scale)) {
    // Without a known length the baseline keeps that of the start.
    const double length =
        problem.options.baseline_mm.value_or(problem.start.projector.position_mm.norm());
    out.AddResidualBlock(
        cost_function(LengthResidual{length, 1.0 / (kCertified * length)}, 1, std::array{6}),
        nullptr,
        parameters.pose.data());
  }
  return blocks;
}

}  // namespace

bool adjust_artifacts(const ArtifactProblem& problem,
                      const ArtifactNoise& noise,
                      ArtifactParameters& parameters,
                      const Run& run) {
  ceres::Problem composed;
  static_cast<void>(compose(problem, noise, parameters, composed));
  StopCallback stop(run);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = problem.options.max_iterations;
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-11;
  options.num_threads = 1;  // the same bytes on any machine
  options.callbacks.push_back(&stop);
  const ceres::Solver::Summary summary = solve_quietly(std::move(options), composed);
  run.check();
  return summary.IsSolutionUsable();
}

ArtifactLinearization linearize_artifacts(const ArtifactProblem& problem,
                                          const ArtifactNoise& noise,
                                          const ArtifactParameters& parameters) {
  ArtifactParameters copy = parameters;
  ceres::Problem composed;
  const std::vector<FreeBlock> blocks = compose(problem, noise, copy, composed);
  ceres::Problem::EvaluateOptions options;
  ArtifactLinearization out;
  for (const FreeBlock& block : blocks) {
    options.parameter_blocks.push_back(block.values);
    out.names.insert(out.names.end(), block.names.begin(), block.names.end());
  }
  ceres::CRSMatrix sparse;
  std::vector<double> gradient;
  composed.Evaluate(options, nullptr, nullptr, &gradient, &sparse);
  out.gradient = Eigen::Map<const Eigen::VectorXd>(gradient.data(),
                                                   static_cast<Eigen::Index>(gradient.size()));
  out.normal = Eigen::MatrixXd::Zero(sparse.num_cols, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    const int begin = sparse.rows[static_cast<std::size_t>(row)];
    const int end = sparse.rows[static_cast<std::size_t>(row) + 1];
    for (int i = begin; i < end; ++i) {
      for (int k = begin; k < end; ++k) {
        const auto at = static_cast<std::size_t>(i);
        const auto other = static_cast<std::size_t>(k);
        out.normal(sparse.cols[at], sparse.cols[other]) += sparse.values[at] * sparse.values[other];
      }
    }
  }
  return out;
}

ArtifactParameters artifact_start(const ArtifactProblem& problem) {
  const Rig& rig = problem.start;
  ArtifactParameters out;
  out.camera = intrinsics_block(rig.reference().model);
  if (const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model)) {
    out.projector = intrinsics_block(*pinhole);
  } else {
    const auto& angular = std::get<AngularModel>(rig.projector.model);
    out.pitch_scale = angular.pitch_scale;
    out.wavefront = angular.wavefront.coefficients_rad;
  }
  const Eigen::AngleAxisd turn(rig.projector.rotation);
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const Eigen::Vector3d translation = -(rig.projector.rotation * rig.projector.position_mm);
  for (std::size_t i = 0; i < 3; ++i) {
    out.pose.at(i) = rotation[static_cast<Eigen::Index>(i)];
    out.pose.at(i + 3) = translation[static_cast<Eigen::Index>(i)];
  }
  for (const ArtifactCapture& capture : problem.captures) {
    out.angle_errors.emplace_back(capture.views.size(), 0.0);
    out.surfaces.emplace_back();
    const bool plate = std::holds_alternative<Plate>(capture.artifact);
    for (const Eigen::Vector4d& surface : capture.surfaces) {
      if (plate) {
        out.surfaces.back().push_back({0.0, 0.0, surface[3], 0.0});
      } else {
        out.surfaces.back().push_back({surface[0], surface[1], surface[2], 0.0});
      }
    }
  }
  return out;
}

Rig artifact_rig(const ArtifactProblem& problem, const ArtifactParameters& parameters) {
  Rig rig = problem.start;
  rig.reference().model = with_intrinsics(rig.reference().model, parameters.camera);
  if (auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model)) {
    *pinhole = with_intrinsics(*pinhole, parameters.projector);
  } else {
    auto& angular = std::get<AngularModel>(rig.projector.model);
    angular.pitch_scale = parameters.pitch_scale;
    angular.wavefront.coefficients_rad = parameters.wavefront;
  }
  const Eigen::Isometry3d projector_from_camera = isometry_of(parameters.pose);
  rig.projector.rotation = projector_from_camera.linear();
  rig.projector.position_mm =
      -(rig.projector.rotation.transpose() * projector_from_camera.translation());
  const Eigen::Vector3d axis = problem.start.turntable->axis;
  const Eigen::Vector3d u = axis.unitOrthogonal();
  rig.turntable->axis = tilted(axis, parameters.table[0], parameters.table[1]);
  rig.turntable->point_mm += parameters.table[2] * u + parameters.table[3] * axis.cross(u);
  return rig;
}

Eigen::Vector4d artifact_surface(const ArtifactProblem& problem,
                                 std::size_t capture,
                                 std::size_t surface,
                                 const ArtifactParameters& parameters) {
  const ArtifactCapture& seen = problem.captures[capture];
  const ArtifactParameters::Surface& values = parameters.surfaces[capture][surface];
  if (!std::holds_alternative<Plate>(seen.artifact)) return {values[0], values[1], values[2], 0.0};
  const Eigen::Vector3d normal =
      tilted(Eigen::Vector3d(seen.surfaces[surface].head<3>()), values[0], values[1]);
  return {normal.x(), normal.y(), normal.z(), values[2]};
}

}  // namespace frangia
