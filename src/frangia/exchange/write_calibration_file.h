#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/durable_file.h"
#include "frangia/core/enum_names.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The programs whose calibration files are written.
enum class CalibrationLayout {
  OpenCv,    ///< .yml, .yaml, .xml, .json: keys of stereo_calib, M1 D1 M2 D2 R T
  SlStudio,  ///< .xml: Kc kc Kp kp Rp Tp
  Scan3d,    ///< .yml of scan3d-capture: cam_K cam_kc proj_K proj_kc R T
  Matlab,    ///< .json: the structure of toStruct(stereoParams)
  Colmap     ///< .txt: cameras.txt
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(CalibrationLayout /*any*/) {
  return EnumNames<CalibrationLayout, 5>{{{CalibrationLayout::OpenCv, "opencv"},
                                          {CalibrationLayout::SlStudio, "slstudio"},
                                          {CalibrationLayout::Scan3d, "scan3d"},
                                          {CalibrationLayout::Matlab, "matlab"},
                                          {CalibrationLayout::Colmap, "colmap"}}};
}

/// The layout that the ending of a file means: OpenCv for .yml, .yaml and .xml, Matlab for .json,
/// Colmap for .txt.
///
/// @errors   Error(Input) that names the file, for another ending
[[nodiscard]] CalibrationLayout layout_of(const std::filesystem::path& file);

/// Writes camera and projector of a rig for another program, in that program's convention.
///
/// @errors   Error(Input) when the projector is angular, or when the program cannot hold the
///          distortion; Error(File)
void write_calibration_file(const std::filesystem::path& file,
                            const Rig& rig,
                            CalibrationLayout layout,
                            Durability durability = Durability::Synced);

}  // namespace frangia
