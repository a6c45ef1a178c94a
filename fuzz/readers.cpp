#include "readers.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/core/error.h"
#include "frangia/dataset/name_template.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/editor/edit_script.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/range_scan.h"
#include "frangia/frames/grey_image.h"
#include "frangia/frames/image_file.h"
#include "frangia/frames/png.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig_covariance.h"

#include "network_readers.h"

namespace frangia {
namespace {

using Path = std::filesystem::path;

// A rig and a range scan that inputs refer to.
constexpr std::string_view kRig = R"(format = "frangia-rig"
version = 1
[camera]
size_px = [160, 160]
focal_px = [312.5, 312.5]
principal_point_px = [79.5, 79.5]
distortion = [0, 0, 0, 0, 0]
white_level = 255
[projector]
model = "angular"
position_mm = [342.0201433256687, 0, -449.6926207859084]
rotation = [[0.9396926207859084, 0, 0.3420201433256687], [0, 1, 0], [-0.3420201433256687, 0, 0.9396926207859084]]
field_deg = [-12, 12]
[line]
normal = [0.9366721892483976, 0, 0.35020738125946743]
offset_mm = 162.87508131876507
[turntable]
point_mm = [-19.03753267771169, 50, 516]
axis = [0.1644124065790365, -0.882947592858927, -0.43974095650452694]
)";
constexpr std::string_view kRangeScan = R"(ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
)";

void write(const Path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A mesh that a reader returns must be consistent.
void read_mesh_file(const Path& path) {
  check_mesh(find_mesh_format(path)->read(path, {}, {}), path);
}

void read_range_file(const Path& path) {
  check_mesh(read_range_scan(path).mesh, path);
}

void read_scan_file(const Path& path) {
  const Scan scan = read_scan(path.parent_path());
  for (const Pattern& pattern : scan.patterns)
    static_cast<void>(frame_file_name(pattern, 0));
}

/// The correction of a phase by the response in the rig.
void read_response(const Path& path) {
  const Rig rig = read_rig(path);
  if (!rig.projector.response) return;
  const std::vector<double> shifts_rad{
      0.0, 1.5707963267948966, 3.141592653589793, 4.71238898038469};
  static_cast<void>(response_table(*rig.projector.response, least_squares(shifts_rad), shifts_rad));
}

/// A covariance, and the changes of a rig that it states.
void read_covariance(const Path& path) {
  const Rig rig = make_paper_rig({});
  const RigCovariance covariance = read_rig_covariance(path, rig);
  const Eigen::MatrixXd factor = covariance_factor(covariance);
  for (Eigen::Index i = 0; i < factor.cols(); ++i)
    static_cast<void>(change_parameters(rig, covariance.parameters, factor.col(i)));
}

/// Every page of an image, as an import reads it.
void read_image(const Path& path) {
  const ImageFile file(path);
  constexpr std::size_t kMaxPages = 4;
  for (std::size_t page = 0; page < std::min(file.info().pages, kMaxPages); ++page)
    static_cast<void>(grey_image(file.read(page), {GreyFrom::Luminance}));
}

/// The first line is a template of file names, which is given every name of the other lines.
void read_names(const Path& path) {
  std::ifstream lines(path);
  std::string line;
  std::getline(lines, line);
  const NameTemplate names(line.substr(0, 200));
  std::vector<std::string> files;
  while (std::getline(lines, line) && files.size() < 20)
    files.push_back(line.substr(0, 80));
  for (const std::string& file : files)
    static_cast<void>(names.match(file));
  static_cast<void>(NameTemplate(guess_name_template(files)));
}

constexpr std::array<FuzzReader, 31> kReaders{{
    {"3mf", "input.3mf", read_mesh_file},
    {"bmp", "input.bmp", read_image},
    {.name = "command", .file = "", .take = take_command},
    {"conf", "input.conf", [](const Path& path) { static_cast<void>(read_posed_scans(path)); }},
    {"covariance", "input.csv", read_covariance},
    {"dxf", "input.dxf", read_mesh_file},
    {.name = "http", .file = "", .take = take_http},
    {"glb", "input.glb", read_mesh_file},
    {"gltf", "input.gltf", read_mesh_file},
    {"image", "input.png", read_image},
    {"jpeg", "input.jpg", read_image},
    {.name = "live", .file = "", .take = take_live},
    {"manifest",
     "capture/manifest.txt",
     [](const Path& path) {
       CaptureManifest manifest(path.parent_path().parent_path());
       static_cast<void>(manifest.retries());
     }},
    {.name = "message", .file = "", .take = take_message},
    {"names", "input.txt", read_names},
    {"npy", "input.npy", read_image},
    {"obj", "input.obj", read_mesh_file},
    {"off", "input.off", read_mesh_file},
    {"pcd", "input.pcd", read_mesh_file},
    {"ply", "input.ply", read_mesh_file},
    {"pnm", "input.pgm", read_image},
    {"png", "input.png", [](const Path& path) { static_cast<void>(read_png(path)); }},
    {"range", "input.ply", read_range_file},
    {"response", "response.toml", read_response},
    {"algorithm",
     "algorithm.toml",
     [](const Path& path) { static_cast<void>(read_algorithm(path)); }},
    {"rig", "input.toml", [](const Path& path) { static_cast<void>(read_rig(path)); }},
    {"scan", "scan.toml", read_scan_file},
    {"script", "input.json", [](const Path& path) { static_cast<void>(read_edit_script(path)); }},
    {"stl", "input.stl", read_mesh_file},
    {"tiff", "input.tiff", read_image},
    {"xyz", "input.xyz", read_mesh_file},
}};

}  // namespace

std::span<const FuzzReader> fuzz_readers() {
  return kReaders;
}

const FuzzReader* find_fuzz_reader(std::string_view name) {
  const auto* const found = std::find_if(
      kReaders.begin(), kReaders.end(), [&](const auto& reader) { return reader.name == name; });
  return found == kReaders.end() ? nullptr : found;
}

FuzzFolder::FuzzFolder() {
  // In memory where that is possible: a fuzzer writes thousands of inputs a second.
  const Path memory = "/dev/shm";
  std::error_code error;
  const Path base = std::filesystem::is_directory(memory, error)
                        ? memory
                        : std::filesystem::temp_directory_path();
  std::string name = (base / "frangia-fuzz-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category());
  path_ = name;
  std::filesystem::create_directory(path_ / "capture");
  write(path_ / "rig.toml", kRig);
  write(path_ / "a.ply", kRangeScan);
}

FuzzFolder::~FuzzFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void FuzzFolder::run(const FuzzReader& reader, std::string_view bytes) const {
  if (reader.take != nullptr) {
    try {
      reader.take(bytes);
    } catch (const Error&) {  // the reader refused them
    }
    return;
  }
  const Path input = path_ / reader.file;
  write(input, bytes);
  try {
    reader.read(input);
  } catch (const Error&) {  // the reader refused the file
  }
  std::error_code ignored;
  std::filesystem::remove(input, ignored);
}

}  // namespace frangia
