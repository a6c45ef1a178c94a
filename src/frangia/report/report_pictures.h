#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/features/find_features.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/labelled_picture.h"

namespace frangia {

/// The pictures of a report, the one with the worst place first. What is out or undecided, the
/// extremes and the characteristics are labelled. `scale_mm` is the end of the color scales; 0:
/// chosen.
///
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<ReportPicture> report_pictures(const Inspection& part,
                                                         double scale_mm = 0.0,
                                                         const Run& run = {});

/// Pictures of the part in which each feature has its number, its index plus 1, as few as show
/// those that can be seen; up to three. `names` are what the labels say behind the numbers.
/// Pictures of `drawn` are used again with these labels; one more is rendered for what they hide.
///
/// @errors   Error(Cancelled)
[[nodiscard]] std::vector<ReportPicture> feature_pictures(const Mesh& mesh,
                                                          const std::vector<Feature>& features,
                                                          const std::vector<std::string>& names,
                                                          const std::vector<ReportPicture>& drawn,
                                                          const Run& run = {});

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
