#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frangia/cad/read_cad.h"
#include "frangia/files/read_mesh.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// What `frangia inspect` was asked for. What the plan states as well is empty or 0 where the
/// command line is silent (`plan_of`).
struct InspectArguments {
  std::vector<std::filesystem::path> meshes;  ///< more than one for a batch
  std::filesystem::path plan;
  std::filesystem::path plan_from;   ///< CAD file whose PMI becomes the plan
  std::filesystem::path write_plan;  ///< file for the plan, as it is inspected by
  std::filesystem::path report;
  std::filesystem::path qif;
  std::filesystem::path batch;
  std::vector<std::string> sections;
  bool blade = false;
  std::filesystem::path reference;
  std::optional<double> unit_mm;     ///< of the reference
  std::string align;                 ///< one of `kAlignments`
  std::vector<double> points;        ///< six for a pair: on the mesh, then on the reference, mm
  std::size_t start = 0;             ///< of poses that fit alike, counted from 1
  std::vector<double> tolerance_mm;  ///< one: plus and minus; two: lower and upper
  std::filesystem::path scan;
  std::filesystem::path picture;
  std::string show = "deviation";
  std::vector<double> from_deg{35.0, 20.0};
  double scale_mm = 0.0;  ///< 0: chosen
  double within_mm = InspectOptions{}.within_mm;
  double max_angle_deg = 75.0;
  bool legend = true;
  bool features = false;
  bool thickness = false;
  bool fail_out_of_tolerance = false;
  double expansion_ppm_per_k = 0.0;
  double temperature_u_k = 0.0;
  std::vector<std::filesystem::path> outputs;
  double allow_time_s = CadOptions{}.allow_time_s;  ///< for reading a CAD file
  int width_px = RenderOptions{}.width_px;
  int height_px = RenderOptions{}.height_px;
  ReadOptions read;
};

}  // namespace frangia
