#pragma once

#include <string>
#include <vector>

#include "frangia/calibrate/board/measure_light.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Throws an input error that names scan.toml.
[[noreturn]] void fail_artifact(const Scan& scan, const std::string& sentence);

/// Distance of sites, px, of which there are `sites` along the longer side of the image.
[[nodiscard]] int site_step(const CameraModel& model, int sites);

/// Windows that overlap just so far that the value of a quadratic in a window has the variance of
/// the mean of `step_px` squared pixels: the sites together then hold the information of all
/// pixels, and their standard deviations state it, though neighbors are correlated.
[[nodiscard]] MeasureLightOptions site_options(int step_px);

/// Sites of all views, measured with the same rig.
[[nodiscard]] std::vector<std::vector<LightSite>> measure_sites(const Scan& scan,
                                                                const Rig& rig,
                                                                const MeasureLightOptions& options,
                                                                const Run& run);

}  // namespace frangia
