#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace frangia {

/// What a CAD file says beside its shape.
struct CadTranslation {
  std::string error;  ///< why it is refused, without the name of the file; empty: it is not
  std::string unit;   ///< in words
  std::vector<std::string> warnings;  ///< without the name of the file
};

/// Reads a CAD file, tessellates its faces and writes them in OpenCASCADE's binary form, in mm.
/// May crash or print on a malicious file.
[[nodiscard]] CadTranslation translate_cad(const std::filesystem::path& path,
                                           const std::optional<double>& unit_mm,
                                           std::ostream& shape);

}  // namespace frangia
