#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "frangia/core/run.h"
#include "frangia/range/drop_mixed_edges.h"
#include "frangia/scan/decode_view.h"
#include "frangia/scan/finish_mesh.h"
#include "frangia/scan/scan_folder.h"
#include "frangia/surface/mesh.h"
#include "frangia/surface/paste_views.h"
#include "frangia/views/anchor_by_views.h"
#include "frangia/views/collect_points.h"
#include "frangia/views/find_platter.h"
#include "frangia/views/reconcile_views.h"
#include "frangia/views/register_views.h"

namespace frangia {

struct ReconstructOptions {
  DecodeOptions decode;
  EdgeOptions edges;
  AnchorByViewsOptions anchor_by_views;
  ReconcileOptions reconcile;
  bool register_views = true;  ///< refine the turntable's axis and angles by what the views saw
  RegisterOptions registration;
  bool keep_platter = false;  ///< else the top of the turntable is found and left out
  PlatterOptions platter;
  double clip_below_mm = -std::numeric_limits<double>::infinity();  ///< height, object frame
  double clip_radius_mm = std::numeric_limits<double>::infinity();  ///< from the axis
  PasteOptions paste;
  FinishOptions finish;
  bool keep_raw = false;  ///< the registered points, too
};

struct Reconstruction {
  Mesh mesh;
  PointCloud raw;                                  ///< empty unless asked for
  std::size_t points = 0;                          ///< measured, in all views
  std::size_t views = 0;                           ///< that held any
  std::optional<RegistrationReport> registration;  ///< none when it was not asked for or impossible
  double platter_height_mm = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none was left out
};

/// The whole path of light: frames, phase, range, views, surface.
///
/// units    mm, object frame
/// missing  a view without a lit pixel is left out with a warning
/// errors   Error(Input) when no view has a lit pixel, and all that the stages throw
[[nodiscard]] Reconstruction reconstruct(const Scan& scan,
                                         const ReconstructOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
