#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/reconstruct/internal/register_setups.h"
#include "frangia/simulate/simulate_scan.h"

#include "support/pose_faults.h"

namespace frangia::testing {

/// A scan of a part in several setups, whose points are known without rendering.
struct ScanInSetups {
  FaultyScan all;  ///< the views of all setups, in their order
  int views = 0;   ///< of each setup
  std::vector<Eigen::Isometry3d> part_poses{Eigen::Isometry3d::Identity()};  ///< by setup

  ScanInSetups(int views_of_setup, int divisor)
      : all(views_of_setup, divisor), views(views_of_setup) {}

  /// The part stands otherwise for as many views again.
  void add_setup(const Eigen::Isometry3d& part_pose) {
    for (int i = 0; i < views; ++i) {
      TrueView view = all.views[static_cast<std::size_t>(i)];
      view.part = part_pose;
      all.views.push_back(view);
      all.stated_angles_rad.push_back(all.stated_angles_rad[static_cast<std::size_t>(i)]);
    }
    part_poses.push_back(part_pose);
  }

  /// Part poses as they are measured by hand: off by an angle about an axis at random through the
  /// middle of the part, and by a way at random.
  [[nodiscard]] std::map<int, Eigen::Isometry3d> stated_poses(double off_rad,
                                                              double off_mm,
                                                              std::uint32_t seed,
                                                              const Eigen::Vector3d& middle) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    const auto direction = [&] {
      return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized().eval();
    };
    std::map<int, Eigen::Isometry3d> stated;
    for (std::size_t setup = 1; setup < part_poses.size(); ++setup) {
      const Eigen::Vector3d axis = direction();
      const Eigen::Vector3d way = off_mm * direction();
      const Eigen::Isometry3d turn = Eigen::Translation3d(middle + way) *
                                     Eigen::AngleAxisd(off_rad, axis) *
                                     Eigen::Translation3d(-middle);
      stated[static_cast<int>(setup)] = part_poses[setup] * turn;
    }
    return stated;
  }

  /// The setups, each measured and registered by itself.
  [[nodiscard]] std::vector<MeasuredSetup> measured(const RayScene& part, const Run& run) const {
    std::vector<MeasuredSetup> setups;
    for (std::size_t setup = 0; setup < part_poses.size(); ++setup) {
      MeasuredSetup one{static_cast<int>(setup), {}, {}, {}};
      one.measured.coarsest = all.pattern;
      const std::size_t first = setup * static_cast<std::size_t>(views);
      for (std::size_t view = first; view < first + static_cast<std::size_t>(views); ++view) {
        one.measured.reference().add(all.take(part, view));
        one.measured.stations.push_back({all.stated_angles_rad[view], std::to_string(view), 0});
      }
      TurntableStations given{*all.stated.turntable, one.measured.stations};
      given.rig = &all.stated;
      given.pattern = &all.pattern;
      one.registration =
          register_views(one.measured.reference(), all.stated.reference().model, given, {}, run);
      setups.push_back(std::move(one));
    }
    return setups;
  }
};

/// Setups that were joined.
struct JoinedScan {
  MeasuredSetup joined;
  SurfaceError error;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

inline JoinedScan joined(const ScanInSetups& scan,
                         const RayScene& part,
                         const RegisterSetupsOptions& options,
                         int block_px = 4) {
  JoinedScan out;
  Run run;
  run.on_warning = [&](const std::string& sentence) { out.warnings.push_back(sentence); };
  run.on_note = [&](const std::string& sentence) { out.notes.push_back(sentence); };
  out.joined = register_setups(scan.measured(part, run), scan.all.stated, options, run);
  FaultyScan seen = scan.all;
  seen.views.clear();
  for (const Station& station : out.joined.measured.stations)
    seen.views.push_back(scan.all.views[std::stoul(station.name)]);
  const ViewMotions motions =
      out.joined.registration ? out.joined.registration->motions : ViewMotions{};
  out.error =
      SurfaceErrors(seen, part, out.joined.measured.reference(), block_px, ErrorFrom::Surface)
          .over(motions);
  return out;
}

}  // namespace frangia::testing
