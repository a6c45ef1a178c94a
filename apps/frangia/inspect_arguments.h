#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/cad/read_cad.h"
#include "frangia/files/read_mesh.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_verdict.h"
#include "frangia/uncertainty/conformity.h"

#include "inspect_alignment.h"

namespace frangia {

/// What `frangia inspect` was asked for.
struct InspectArguments {
  std::vector<std::filesystem::path> meshes;  ///< more than one for a batch
  std::filesystem::path mesh;                 ///< the one that is inspected
  std::filesystem::path plan;
  std::filesystem::path report;
  std::filesystem::path qif;
  std::filesystem::path batch;
  std::vector<std::string> sections;
  bool blade = false;
  std::filesystem::path reference;
  std::filesystem::path scan;
  std::filesystem::path picture;
  std::string show = "deviation";
  std::vector<double> from_deg{35.0, 20.0};
  double scale_mm = 0.0;  ///< 0: chosen
  double within_mm = 0.2;
  double max_angle_deg = 75.0;
  bool legend = true;
  bool features = false;
  bool thickness = false;
  bool fail_out_of_tolerance = false;
  AlignmentArguments alignment;
  SurfaceRule surface;  ///< of the plan; the limits are those of `alignment`
  double expansion_ppm_per_k = 0.0;
  double temperature_u_k = 0.0;
  std::vector<std::filesystem::path> outputs;
  double allow_time_s = CadOptions{}.allow_time_s;  ///< for reading a CAD file
  int width_px = RenderOptions{}.width_px;
  int height_px = RenderOptions{}.height_px;
  ReadOptions read;
};

/// What the verb found, for machines and for people.
// NOLINTNEXTLINE(bugprone-exception-escape): a JSON value checks itself when it moves
struct InspectAnswer {
  nlohmann::ordered_json json;
  std::string text;
  Conformity verdict = Conformity::Undecided;  ///< of the deviations from the reference
};

}  // namespace frangia
