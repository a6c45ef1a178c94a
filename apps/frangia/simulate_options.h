#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "frangia/files/read_mesh.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/simulate_scan.h"

#include "simulated_frame_faults.h"

namespace frangia {

/// The options of `frangia simulate`. Angles in degrees, as everywhere on screen.
struct SimulateArguments {
  std::string part;
  std::string rig = "digital";
  std::filesystem::path output;
  int views = 8;
  std::vector<double> setup_tilts_deg;
  PatternPlan patterns;
  SimulateOptions options;
  bool no_noise = false;
  bool label = false;
  double step_jitter_deg = 0.0;
  double angle_error_deg = 0.0;
  double axis_tilt_deg = 0.0;
  std::string calibration;
  bool on_turntable = false;
  const CLI::Option* samples = nullptr;
  std::vector<int> corners = {10, 7};
  double square_mm = 0.0;
  const CLI::Option* fringes_per_degree = nullptr;
  ReadOptions read;
  SimulatedFrameFaults frame_faults;
  std::size_t discs = 0;
  std::size_t coded_targets = 0;
  double target_mm = 4.0;
  std::string slide_part;
  std::string lost_step;
};

/// Adds the options to the verb.
void add_simulate_options(CLI::App& verb, SimulateArguments& arguments);

/// Reads the motions that are given for one view of a scan.
///
/// @errors   Error(Input) for a text that is not VIEW:AMOUNT, or a view that the scan does not have
void read_motion_faults(SimulateArguments& arguments, std::size_t views);

}  // namespace frangia
