#include "frangia/exchange/internal/read_colmap_cameras.h"

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"

namespace frangia {
namespace {

/// The parameters of a model: how many focal lengths, and how many coefficients of OpenCV's order.
struct ColmapModel {
  std::size_t focal_lengths;
  std::size_t distortion;
  bool radial_only;  ///< k1, k2 without p1 p2
};

const std::map<std::string, ColmapModel>& colmap_models() {
  static const std::map<std::string, ColmapModel> models{{"SIMPLE_PINHOLE", {1, 0, false}},
                                                         {"PINHOLE", {2, 0, false}},
                                                         {"SIMPLE_RADIAL", {1, 1, true}},
                                                         {"RADIAL", {1, 2, true}},
                                                         {"OPENCV", {2, 4, false}},
                                                         {"FULL_OPENCV", {2, 8, false}}};
  return models;
}

ForeignLens colmap_lens_of(const std::string& line, const std::string& place) {
  std::istringstream words(line);
  long long id = 0;
  std::string name;
  ForeignLens lens;
  std::array<int, 2> size{};
  if (!(words >> id >> name >> size[0] >> size[1]) || size[0] < 1 || size[1] < 1 ||
      size[0] > 65535 || size[1] > 65535) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{} is not a camera of COLMAP: CAMERA_ID MODEL WIDTH HEIGHT PARAMS...", place));
  }
  const auto model = colmap_models().find(name);
  if (model == colmap_models().end()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has the model \"{}\"; export one of SIMPLE_PINHOLE, PINHOLE, "
                            "SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV",
                            place,
                            name));
  }
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;)
    numbers.push_back(number);
  const auto& [focal_lengths, coefficients, radial_only] = model->second;
  if (numbers.size() != focal_lengths + 2 + coefficients || !words.eof()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has {} parameters; the model {} has {}",
                            place,
                            numbers.size(),
                            name,
                            focal_lengths + 2 + coefficients));
  }
  const double fx = numbers[0];
  const double fy = numbers[focal_lengths - 1];
  lens.matrix = Eigen::Matrix3d{{fx, 0.0, numbers[focal_lengths] - 0.5},
                                {0.0, fy, numbers[focal_lengths + 1] - 0.5},
                                {0.0, 0.0, 1.0}};
  lens.distortion.assign(numbers.begin() + static_cast<std::ptrdiff_t>(focal_lengths + 2),
                         numbers.end());
  if (radial_only) lens.distortion.resize(4);
  lens.size_px = size;
  return lens;
}

}  // namespace

ForeignCalibration read_colmap_cameras(const std::filesystem::path& file) {
  std::istringstream lines(read_text_file(file));
  std::vector<ForeignLens> lenses;
  int number = 0;
  for (std::string line; lenses.size() < 2 && std::getline(lines, line);) {
    ++number;
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    lenses.push_back(colmap_lens_of(line, fmt::format("{}: line {}", file.string(), number)));
  }
  if (lenses.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it holds no camera; give COLMAP's cameras.txt", file.string()));
  }
  ForeignCalibration found;
  found.program = "COLMAP";
  found.camera = lenses[0];
  if (lenses.size() > 1) found.projector = lenses[1];
  return found;
}

}  // namespace frangia
