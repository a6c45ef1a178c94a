#include "frangia/service/export_size.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr std::size_t kSmallSample = 2000;  // triangles

/// A patch of connected triangles, whose vertices are shared as in the whole mesh.
Mesh patch_of(const Mesh& mesh, std::size_t triangles) {
  Mesh patch = mesh;
  std::vector<std::uint8_t> keep(mesh.triangles.size());
  std::fill_n(keep.begin(), std::min(triangles, keep.size()), std::uint8_t{1});
  keep_triangles(patch, keep);
  return patch;
}

/// A folder that ends with this object.
class SampleFolder {
 public:
  SampleFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "frangia-size-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw Error(ErrorKind::File, fmt::format("{}: cannot be created", pattern));
    path_ = pattern;
  }
  SampleFolder(const SampleFolder&) = delete;
  SampleFolder& operator=(const SampleFolder&) = delete;
  SampleFolder(SampleFolder&&) = delete;
  SampleFolder& operator=(SampleFolder&&) = delete;
  ~SampleFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

double bytes_of(const Mesh& mesh, const std::string& format, const WriteOptions& options) {
  const SampleFolder folder;
  const auto path = folder.path() / ("sample." + format);
  write_mesh(path, mesh, options);
  return static_cast<double>(std::filesystem::file_size(path));
}

}  // namespace

std::size_t export_size(const Mesh& mesh,
                        const std::string& format,
                        std::size_t triangles,
                        const WriteOptions& options) {
  require(!mesh.triangles.empty(), "the surface has no triangles to export; undo, or scan again");
  const std::size_t count = mesh.triangles.size();
  const Mesh large = patch_of(mesh, 2 * kSmallSample);
  const double all = bytes_of(large, format, options);
  if (count <= 2 * kSmallSample) return static_cast<std::size_t>(all);
  const Mesh small = patch_of(large, kSmallSample);
  const double part = bytes_of(small, format, options);
  // What a file adds for a triangle and for a vertex is about the same in all formats, so the size
  // follows both; a small patch has more vertices, at its edge, than the mesh.
  const auto elements = [](const Mesh& one) {
    return static_cast<double>(one.triangles.size() + one.vertices_mm.size());
  };
  const double per_element = (all - part) / (elements(large) - elements(small));
  const double share = static_cast<double>(triangles) / static_cast<double>(count);
  const double wanted = share * elements(mesh);
  return static_cast<std::size_t>(std::llround(all + per_element * (wanted - elements(large))));
}

}  // namespace frangia
