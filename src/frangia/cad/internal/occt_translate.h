#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "frangia/cad/cad_pmi.h"

class STEPControl_Reader;
class TopoDS_Shape;

namespace frangia {

/// How a CAD file is translated.
struct CadRequest {
  std::optional<double> unit_mm;  ///< of a file that states none
  bool pmi = false;               ///< also its product and manufacturing information
};

/// What a CAD file says beside its shape.
struct CadTranslation {
  std::string error;  ///< why it is refused, without the name of the file; empty: it is not
  std::string unit;   ///< in words
  std::vector<std::string> warnings;  ///< without the name of the file
  CadPmi pmi{};                       ///< empty unless it is asked for
};

/// Reads a CAD file, tessellates its faces and writes them in OpenCASCADE's binary form, in mm.
/// May crash or print on a malicious file.
[[nodiscard]] CadTranslation translate_cad(const std::filesystem::path& path,
                                           const CadRequest& asked,
                                           std::ostream& shape);

/// Reads the shape of a STEP file and its product and manufacturing information, which names faces
/// by their number in the shape, from 1. May crash or print on a malicious file.
///
/// What is wrong with the file is `said.error`, and the shape is null then. A file that states no
/// unit of length is refused, because its tolerances have none either.
[[nodiscard]] TopoDS_Shape read_step_with_pmi(const std::string& path, CadTranslation& said);

/// The unit of length that a STEP file states, in words; empty: none.
[[nodiscard]] std::string stated_unit(STEPControl_Reader& reader);

/// The warning of roots of a file of which no shape came; empty: of each came one.
[[nodiscard]] std::string left_out_text(int roots, int done);

}  // namespace frangia
