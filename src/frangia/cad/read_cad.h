#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "frangia/cad/cad_model.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/run.h"

namespace frangia {

/// How a CAD file is read.
struct CadOptions {
  std::optional<double> units;  ///< length of its unit, mm, for a file that states none
  std::uint64_t allow_memory = kAllowMemoryBytes;  ///< memory that reading may take, bytes
  /// Processor time that reading may take, s; a large file may take 20 s for each MB.
  double allow_time_s = 120.0;
  bool pmi = false;  ///< also the semantic product and manufacturing information of a STEP file
};

/// Whether the extension of a path is that of a CAD file: .step, .stp, .igs or .iges.
[[nodiscard]] bool is_cad_file(const std::filesystem::path& path);

/// Reads the faces of a STEP or IGES file and tessellates them within 5e-5 of their size.
///
/// A second process reads the file and tries what is done with its faces, so that one which the
/// library for it cannot digest ends that process alone; what it answers is checked. Faces that no
/// solid joins are sewn where their edges meet within 0.01 mm. Warns of parts that could not be
/// translated.
/// @units    mm; other units of the file are converted
/// @errors   Error(Input) that names the file, when it is no such file, is cut short, has no faces,
///           states no unit of length (and no `units` is given), needs too much memory or time, or
///           when the program is built without OpenCASCADE; Error(Cancelled)
/// @source   ISO 10303-21; IGES 5.3
[[nodiscard]] std::unique_ptr<CadModel> read_cad(const std::filesystem::path& path,
                                                 const CadOptions& options = {},
                                                 const Run& run = {});

}  // namespace frangia
