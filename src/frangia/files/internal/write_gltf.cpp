#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/base64.h"
#include "frangia/core/error.h"
#include "frangia/core/srgb.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/gltf.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126;
constexpr int kUnsigned = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementBuffer = 34963;

/// Writes raw bytes.
class PlainSink {
 public:
  explicit PlainSink(FileWriter& file) : file_(file) {}
  template <typename Number>
  void number(Number value) {
    file_.binary(value);
  }
  void finish() {}

 private:
  FileWriter& file_;
};

/// Writes base64 in blocks of a multiple of three bytes.
class Base64Sink {
 public:
  explicit Base64Sink(FileWriter& file) : file_(file) {}
  template <typename Number>
  void number(Number value) {
    kept_.append(reinterpret_cast<const char*>(&value),
                 sizeof value);  // NOLINT(*-reinterpret-cast)
    if (kept_.size() >= kBlock) write(kept_.size() / 3 * 3);
  }
  void finish() { write(kept_.size()); }

 private:
  static constexpr std::size_t kBlock = 3 << 14;
  void write(std::size_t count) {
    file_.text(encode_base64(std::string_view(kept_).substr(0, count)));
    kept_.erase(0, count);
  }
  FileWriter& file_;
  std::string kept_;
};

/// The JSON of the file and the layout of its buffer.
class Layout {
 public:
  Layout(const Mesh& mesh, const std::filesystem::path& path) : mesh_(mesh) {
    std::array<std::size_t, 3> counts{};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      ++counts.at(static_cast<std::size_t>(mark_of(mesh, i)));
    describe_vertices();
    describe_triangles(counts);
    constexpr std::uint64_t kMaxBytes = 0xFFFFFFFFU - 65'536U;
    if (bytes_ > kMaxBytes) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: the mesh exceeds the 4 GB that glTF can hold; decimate it or "
                              "write .ply",
                              path.string()));
    }
  }

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  [[nodiscard]] Json document(const Json& buffer) const {
    Json gltf;
    gltf["asset"] = {{"version", "2.0"}, {"generator", "Frangia"}};
    gltf["scene"] = 0;
    gltf["scenes"] = {{{"nodes", {0}}}};
    // From the stored mm with z up to metres with y up.
    gltf["nodes"] = {{{"name", "scan"},
                      {"mesh", 0},
                      {"matrix", {0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1}}}};
    gltf["meshes"] = {{{"name", "scan"}, {"primitives", primitives_}}};
    gltf["materials"] = materials_;
    gltf["accessors"] = accessors_;
    gltf["bufferViews"] = views_;
    gltf["buffers"] = Json::array({buffer});
    return gltf;
  }

  template <typename Sink>
  void write(Sink sink) const {
    write_vectors(sink, mesh_.vertices_mm);
    write_vectors(sink, mesh_.normals);
    for (const std::vector<float>* sigmas :
         {&mesh_.sigma_mm, &mesh_.sigma_noise_mm, &mesh_.sigma_systematic_mm}) {
      for (const float sigma : *sigmas)
        sink.number(sigma);
    }
    for (const std::uint16_t views : mesh_.views)
      sink.number(static_cast<float>(views));
    for (const Mark mark : mesh_.vertex_marks)
      sink.number(static_cast<float>(mark));
    for (const VertexColor& color : mesh_.colors) {
      for (const std::uint8_t channel : color)
        sink.number(static_cast<float>(linear_from_srgb(channel)));
    }
    for (std::size_t mark = 0; mark < names_of(Mark{}).size(); ++mark) {
      for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        if (static_cast<std::size_t>(mark_of(mesh_, i)) != mark) continue;
        for (const std::uint32_t corner : mesh_.triangles[i])
          sink.number(corner);
      }
    }
    sink.finish();
  }

 private:
  template <typename Sink>
  static void write_vectors(Sink& sink, const std::vector<Eigen::Vector3f>& vectors) {
    for (const Eigen::Vector3f& vector : vectors) {
      for (const float coordinate : vector)
        sink.number(coordinate);
    }
  }

  void describe_vertices() {
    const std::size_t count = mesh_.vertices_mm.size();
    Eigen::AlignedBox3f box;
    for (const auto& place : mesh_.vertices_mm)
      box.extend(place);
    attributes_["POSITION"] = accessor(count, kFloat, "VEC3");
    accessors_.back()["min"] = {box.min().x(), box.min().y(), box.min().z()};
    accessors_.back()["max"] = {box.max().x(), box.max().y(), box.max().z()};
    if (!mesh_.normals.empty()) attributes_["NORMAL"] = accessor(count, kFloat, "VEC3");
    if (!mesh_.sigma_mm.empty()) attributes_["_SIGMA_MM"] = accessor(count, kFloat, "SCALAR");
    if (!mesh_.sigma_noise_mm.empty())
      attributes_["_SIGMA_NOISE_MM"] = accessor(count, kFloat, "SCALAR");
    if (!mesh_.sigma_systematic_mm.empty())
      attributes_["_SIGMA_SYSTEMATIC_MM"] = accessor(count, kFloat, "SCALAR");
    if (!mesh_.views.empty()) attributes_["_VIEWS"] = accessor(count, kFloat, "SCALAR");
    if (!mesh_.vertex_marks.empty()) attributes_["_MARK"] = accessor(count, kFloat, "SCALAR");
    if (!mesh_.colors.empty()) attributes_["COLOR_0"] = accessor(count, kFloat, "VEC3");
  }

  void describe_triangles(const std::array<std::size_t, 3>& counts) {
    for (std::size_t mark = 0; mark < counts.size(); ++mark) {
      if (counts.at(mark) == 0) continue;
      primitives_.push_back({{"attributes", attributes_},
                             {"indices", accessor(3 * counts.at(mark), kUnsigned, "SCALAR")},
                             {"material", materials_.size()},
                             {"mode", 4}});
      // Linear, as glTF defines them. A material's color multiplies those of the vertices.
      constexpr std::array<double, 3> kWhite{1.0, 1.0, 1.0};
      const bool own = !mesh_.colors.empty() && mark == 0;
      const auto& [red, green, blue] = own ? kWhite : kMarkColors.at(mark);
      materials_.push_back({{"name", name_of(static_cast<Mark>(mark))},
                            {"pbrMetallicRoughness",
                             {{"baseColorFactor", {red, green, blue, 1.0}},
                              {"metallicFactor", 0.0},
                              {"roughnessFactor", 0.8}}},
                            {"doubleSided", true}});
    }
  }

  std::size_t accessor(std::size_t count, int component, const char* type) {
    const std::uint64_t length = 4 * count * (std::string_view(type) == "VEC3" ? 3 : 1);
    accessors_.push_back({{"bufferView", views_.size()},
                          {"componentType", component},
                          {"count", count},
                          {"type", type}});
    views_.push_back({{"buffer", 0},
                      {"byteOffset", bytes_},
                      {"byteLength", length},
                      {"target", component == kUnsigned ? kElementBuffer : kArrayBuffer}});
    bytes_ += length;
    return accessors_.size() - 1;
  }

  const Mesh& mesh_;
  std::uint64_t bytes_ = 0;
  Json attributes_;
  Json primitives_ = Json::array();
  Json materials_ = Json::array();
  Json accessors_ = Json::array();
  Json views_ = Json::array();
};

void write_glb(FileWriter& file, const Layout& layout) {
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
  constexpr std::uint32_t kBinaryChunk = 0x004E4942;
  std::string gltf = layout.document({{"byteLength", layout.bytes()}}).dump();
  gltf.resize((gltf.size() + 3) / 4 * 4, ' ');
  const auto text = static_cast<std::uint32_t>(gltf.size());
  const auto body = static_cast<std::uint32_t>(layout.bytes());  // a multiple of four
  file.text("glTF");
  file.binary(std::uint32_t{2});
  file.binary(12 + 8 + text + 8 + body);
  file.binary(text);
  file.binary(kJsonChunk);
  file.text(gltf);
  file.binary(body);
  file.binary(kBinaryChunk);
  layout.write(PlainSink(file));
}

void write_text(FileWriter& file, const Layout& layout) {
  const std::string here = "data:application/octet-stream;base64,";
  const std::string gltf = layout.document({{"byteLength", layout.bytes()}, {"uri", here}}).dump(1);
  const std::size_t split = gltf.rfind(here) + here.size();
  file.text(std::string_view(gltf).substr(0, split));
  layout.write(Base64Sink(file));
  file.text(std::string_view(gltf).substr(split));
  file.text("\n");
}

}  // namespace

void write_gltf(const std::filesystem::path& path, const Mesh& mesh) {
  check_triangles(mesh, path);
  const Layout layout(mesh, path);
  FileWriter file(path);
  if (lowercase_extension(path) == ".gltf") {
    write_text(file, layout);
  } else {
    write_glb(file, layout);
  }
  file.commit();
}

}  // namespace frangia
