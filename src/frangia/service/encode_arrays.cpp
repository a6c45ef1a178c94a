#include "frangia/service/encode_arrays.h"

#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are packed as they are stored");

constexpr std::size_t kAlignment = 4;

/// Collects arrays and packs them behind a header.
class ArrayPacker {
 public:
  template <typename T>
  void add(const char* name, const char* type, const T* data, std::size_t length) {
    header_["arrays"].push_back(
        {{"name", name}, {"type", type}, {"length", length}, {"offset", body_.size()}});
    const std::size_t begin = body_.size();
    const std::size_t bytes = length * sizeof(T);
    body_.resize((begin + bytes + kAlignment - 1) / kAlignment * kAlignment);
    if (bytes > 0) std::memcpy(body_.data() + begin, data, bytes);
  }

  [[nodiscard]] std::string pack() {
    constexpr std::size_t kOffsetDigits = 12;  // more than any offset has
    nlohmann::ordered_json header = header_;
    const std::size_t space = header.dump().size() + header_["arrays"].size() * kOffsetDigits;
    const std::size_t head =
        (sizeof(std::uint32_t) + space + kAlignment - 1) / kAlignment * kAlignment;
    for (auto& array : header["arrays"])
      array["offset"] = array["offset"].get<std::size_t>() + head;
    std::string text = header.dump();
    text.resize(head - sizeof(std::uint32_t), ' ');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::string all(sizeof length, '\0');
    std::memcpy(all.data(), &length, sizeof length);
    return all + text + body_;
  }

 private:
  nlohmann::ordered_json header_ = {{"arrays", nlohmann::ordered_json::array()}};
  std::string body_;
};

constexpr std::size_t kPerPoint = 3;

}  // namespace

std::string encode_mesh(const Mesh& mesh) {
  static_assert(sizeof(Eigen::Vector3f) == kPerPoint * sizeof(float));
  ArrayPacker packer;
  const std::size_t vertices = mesh.vertices_mm.size();
  packer.add("positions",
             "float32",
             reinterpret_cast<const float*>(mesh.vertices_mm.data()),
             vertices * kPerPoint);
  packer.add("triangles",
             "uint32",
             reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()),
             mesh.triangles.size() * kPerPoint);
  const std::vector<Eigen::Vector3f> normals =
      mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals;
  packer.add("normals",
             "float32",
             reinterpret_cast<const float*>(normals.data()),
             normals.size() * kPerPoint);
  if (!mesh.sigma_mm.empty()) packer.add("sigma_mm", "float32", mesh.sigma_mm.data(), vertices);
  if (!mesh.views.empty()) packer.add("views", "uint16", mesh.views.data(), vertices);
  if (!mesh.vertex_marks.empty() || !mesh.triangle_marks.empty()) {
    std::vector<std::uint8_t> marks(mesh.triangles.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
      marks[i] = static_cast<std::uint8_t>(mark_of(mesh, i));
    packer.add("marks", "uint8", marks.data(), marks.size());
  }
  return packer.pack();
}

std::string encode_selection(const Selection& selection) {
  ArrayPacker packer;
  packer.add("selected", "uint8", selection.data(), selection.size());
  return packer.pack();
}

std::string encode_points(const PointCloud& points, std::size_t most) {
  const std::size_t step = points.points_mm.size() / (most + 1) + 1;
  std::vector<float> positions;
  std::vector<float> sigma;
  for (std::size_t i = 0; i < points.points_mm.size(); i += step) {
    for (const float value : points.points_mm[i])
      positions.push_back(value);
    sigma.push_back(points.sigma_mm.empty() ? kMissing : points.sigma_mm[i]);
  }
  ArrayPacker packer;
  packer.add("positions", "float32", positions.data(), positions.size());
  packer.add("sigma_mm", "float32", sigma.data(), sigma.size());
  return packer.pack();
}

}  // namespace frangia
