#include "frangia/calibrate/board/find_markers.h"

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/calibrate/board/internal/read_markers.h"
#include "frangia/core/error.h"

namespace frangia {

std::vector<FoundMarker> find_markers(const Image<float>& counts, const std::string& dictionary) {
  const auto known = find_aruco_dictionary(dictionary);
  require(known.has_value(), "find_markers: the dictionary does not exist");
  std::vector<FoundMarker> found;
  for (const SeenMarker& marker : read_all_markers(display_bytes(opencv_view(counts)), *known)) {
    FoundMarker& one = found.emplace_back();
    one.code = marker.id;
    for (std::size_t i = 0; i < 4; ++i)
      one.corners_px.at(i) = {static_cast<double>(marker.corners.at(i).x),
                              static_cast<double>(marker.corners.at(i).y)};
  }
  return found;
}

}  // namespace frangia
