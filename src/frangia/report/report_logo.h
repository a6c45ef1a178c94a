#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frangia {

/// The picture at the head of a report.
struct ReportLogo {
  std::string media_type;   ///< image/png or image/jpeg
  std::vector<char> bytes;  ///< of the file
};

/// Reads a logo.
///
/// @errors   Error(Input) that names the file when it is neither PNG nor JPEG, or above 2 MB
[[nodiscard]] ReportLogo read_logo(const std::filesystem::path& path);

}  // namespace frangia
