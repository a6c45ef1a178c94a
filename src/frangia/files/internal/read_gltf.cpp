#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/srgb.h"
#include "frangia/files/internal/append_transformed.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/gltf.h"
#include "frangia/files/internal/gltf_document.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// The `mode` of a primitive of triangles.
constexpr std::uint64_t kGltfTriangles = 4;
constexpr std::uint64_t kGltfFan = 6;  ///< 5 is a strip

using nlohmann::json;

double memory_of_mesh(const GltfDocument& document, const json& mesh) {
  const auto count_of = [&](const json& accessor, std::size_t width) {
    return static_cast<double>(document.locate(document.whole(accessor), width).count);
  };
  double bytes = 0.0;
  const json* attributes = nullptr;
  for (const auto& primitive : mesh.at("primitives")) {
    const std::uint64_t mode = document.whole_or(primitive, "mode", kGltfTriangles);
    if (mode < kGltfTriangles || mode > kGltfFan) continue;
    const json& own = primitive.at("attributes");
    const double vertices = count_of(own.at("POSITION"), 3);
    const double corners =
        primitive.contains("indices") ? count_of(primitive.at("indices"), 1) : vertices;
    const bool shared = attributes != nullptr && *attributes == own;
    // In a strip or fan each corner but two makes a triangle.
    const double triangles = mode == kGltfTriangles ? corners / 3.0 : corners;
    bytes += mesh_memory_bytes(shared ? 0.0 : vertices, triangles);
    attributes = &own;
  }
  return bytes;
}

/// Memory of a document and of its meshes as often as `meshes` names them, bytes. No number of an
/// accessor is read.
///
/// @errors   Error(Input) as GltfDocument::locate
double gltf_memory_bytes(const GltfDocument& document, const std::vector<std::uint64_t>& meshes) {
  std::map<std::uint64_t, double> memory_of;
  auto bytes = static_cast<double>(document.total_bytes);
  for (const std::uint64_t mesh : meshes) {
    const auto [known, inserted] = memory_of.try_emplace(mesh, 0.0);
    if (inserted) known->second = memory_of_mesh(document, document.item("meshes", mesh));
    bytes += known->second;
  }
  return bytes;
}

using nlohmann::json;

Eigen::Affine3d transform_of(const GltfDocument& document, const json& node) {
  const auto numbers = [&](const char* key, std::vector<double> usual) {
    if (!node.contains(key)) return usual;
    auto found = node.at(key).get<std::vector<double>>();
    if (found.size() != usual.size())
      document.fail(fmt::format("the {} of a node has the wrong length; export it again", key));
    return found;
  };
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {
    const auto m = numbers("matrix", std::vector<double>(16));
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    transform.makeAffine();
    return transform;
  }
  const auto t = numbers("translation", {0.0, 0.0, 0.0});
  const auto r = numbers("rotation", {0.0, 0.0, 0.0, 1.0});
  const auto s = numbers("scale", {1.0, 1.0, 1.0});
  transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  return transform;
}

std::vector<Eigen::Vector3f> vectors_of(const std::vector<double>& numbers) {
  std::vector<Eigen::Vector3f> vectors;
  vectors.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    vectors.emplace_back(Eigen::Vector3d(numbers[i], numbers[i + 1], numbers[i + 2]).cast<float>());
  return vectors;
}

class GltfReader {
 public:
  GltfReader(const GltfDocument& document, const ReadOptions& options, const Run& run)
      : document_(document), options_(options), run_(run) {}

  Mesh read() {
    // Metres with y up to mm with z up.
    Eigen::Affine3d mm_from_scene = Eigen::Affine3d::Identity();
    mm_from_scene.linear() << 1000, 0, 0, 0, 0, -1000, 0, 1000, 0;
    const json& all = document_.json;
    if (all.contains("scenes")) {
      const json& scene = document_.item("scenes", document_.whole_or(all, "scene", 0));
      for (const std::uint64_t node : document_.whole_list(scene, "nodes"))
        visit(node, mm_from_scene);
    } else if (all.contains("nodes")) {
      std::set<std::uint64_t> children;
      for (const auto& node : all.at("nodes")) {
        for (const std::uint64_t child : document_.whole_list(node, "children"))
          children.insert(child);
      }
      for (std::uint64_t node = 0; node < all.at("nodes").size(); ++node)
        if (!children.contains(node)) visit(node, mm_from_scene);
    }
    std::vector<std::uint64_t> meshes;
    for (const Instance& instance : instances_)
      meshes.push_back(instance.mesh);
    MemoryBudget(document_.path, document_.total_bytes, options_.allow_memory_bytes)
        .check(gltf_memory_bytes(document_, meshes));
    for (const Instance& instance : instances_)
      add_primitives(document_.item("meshes", instance.mesh), instance.mm_from_mesh);
    if (skipped_ > 0) {
      run_.warn(fmt::format("{}: skipped {} primitive{} of points or lines",
                            document_.path.string(),
                            skipped_,
                            skipped_ == 1 ? "" : "s"));
    }
    if (skinned_ + morphed_ > 0) {
      run_.warn(
          fmt::format("{}: {} mesh{} read at rest, without the pose of a skeleton or shape key",
                      document_.path.string(),
                      skinned_ + morphed_,
                      skinned_ + morphed_ == 1 ? " is" : "es are"));
    }
    if (hidden_ > 0) {
      run_.warn(fmt::format("{}: left out {} node{} hidden",
                            document_.path.string(),
                            hidden_,
                            hidden_ == 1 ? " that is" : "s that are"));
    }
    if (mesh_.empty()) document_.fail("its scene has no triangle");
    if (!all_have_normals_) mesh_.normals.clear();
    return std::move(mesh_);
  }

 private:
  /// A mesh that a node of the scene shows.
  struct Instance {
    std::uint64_t mesh = 0;
    Eigen::Affine3d mm_from_mesh;
  };

  /// glTF requires a strict tree, so a node that is visited twice is an error. The depth is limited
  /// because the traversal is recursive.
  void visit(std::uint64_t number, const Eigen::Affine3d& parent, int depth = 0) {
    constexpr int kMaxDepth = 256;
    const json& node = document_.item("nodes", number);
    if (!seen_.insert(number).second || depth > kMaxDepth) {
      document_.fail(
          "a node has two parents, is its own descendant, or is nested too deeply; export it "
          "again");
    }
    if (GltfDocument::hides(node)) {
      ++hidden_;
      return;
    }
    const Eigen::Affine3d mm_from_node = parent * transform_of(document_, node);
    if (node.contains("mesh")) add_instances(node, mm_from_node);
    for (const std::uint64_t child : document_.whole_list(node, "children"))
      visit(child, mm_from_node, depth + 1);
  }

  /// Adds the mesh of a node, or its copies where the node has EXT_mesh_gpu_instancing.
  void add_instances(const json& node, const Eigen::Affine3d& mm_from_node) {
    const std::uint64_t mesh = document_.whole(node.at("mesh"));
    if (node.contains("skin")) ++skinned_;
    const json extensions = node.value("extensions", json::object());
    const auto found = extensions.find("EXT_mesh_gpu_instancing");
    if (found == extensions.end()) {
      instances_.push_back({mesh, mm_from_node});
      return;
    }
    const json& attributes = found->at("attributes");
    std::uint64_t count = 0;
    const auto read = [&](const char* name, std::size_t width) {
      constexpr std::uint64_t kMost = 1'000'000;
      if (!attributes.contains(name)) return std::vector<double>();
      const std::uint64_t accessor = document_.whole(attributes.at(name));
      const std::uint64_t has = document_.locate(accessor, width).count;
      if (has > kMost || (count != 0 && has != count))
        document_.fail(fmt::format("its copies have {} values of {}; export it again", has, name));
      count = has;
      return document_.numbers(accessor, width);
    };
    const std::vector<double> t = read("TRANSLATION", 3);
    const std::vector<double> r = read("ROTATION", 4);
    const std::vector<double> s = read("SCALE", 3);
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Affine3d place = mm_from_node;
      if (!t.empty()) place.translate(Eigen::Vector3d(t[3 * i], t[3 * i + 1], t[3 * i + 2]));
      if (!r.empty())
        place.rotate(
            Eigen::Quaterniond(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]).normalized());
      if (!s.empty()) place.scale(Eigen::Vector3d(s[3 * i], s[3 * i + 1], s[3 * i + 2]));
      instances_.push_back({mesh, place});
    }
  }

  /// Adds the primitives of a mesh. Consecutive primitives with the same attributes share vertices.
  void add_primitives(const json& mesh, const Eigen::Affine3d& mm_from_node) {
    Mesh part;
    json attributes;
    for (const auto& primitive : mesh.at("primitives")) {
      const std::uint64_t mode = document_.whole_or(primitive, "mode", kGltfTriangles);
      if (mode < kGltfTriangles) {
        ++skipped_;
        continue;
      }
      if (mode > kGltfFan)
        document_.fail(fmt::format("a primitive has the unknown mode {}; export it again", mode));
      if (document_.is_compressed(primitive)) {
        document_.fail("it is compressed (Draco); export it without compression");
      }
      if (primitive.contains("targets")) ++morphed_;
      if (attributes != primitive.at("attributes")) {
        if (!part.empty()) append_transformed(mesh_, part, mm_from_node, document_.path);
        attributes = primitive.at("attributes");
        part = vertices_of(attributes);
      }
      add_triangles(part, primitive, mode);
    }
    if (!part.empty()) append_transformed(mesh_, part, mm_from_node, document_.path);
  }

  Mesh vertices_of(const json& attributes) {
    Mesh part;
    part.vertices_mm = vectors_of(document_.numbers(document_.whole(attributes.at("POSITION")), 3));
    const std::size_t count = part.vertices_mm.size();
    const auto read = [&](const char* name, std::size_t width) {
      std::vector<double> found;
      if (attributes.contains(name)) {
        const std::uint64_t accessor = document_.whole(attributes.at(name));
        if (document_.locate(accessor, width).count != count) {
          document_.fail(
              fmt::format("its {} values are not one per vertex; export it again", name));
        }
        found = document_.numbers(accessor, width);
      }
      return found;
    };
    part.normals = vectors_of(read("NORMAL", 3));
    all_have_normals_ = all_have_normals_ && !part.normals.empty();
    for (auto& normal : part.normals)
      if (!normal.allFinite()) normal.setZero();
    const auto read_sigma = [&](const char* name) {
      std::vector<float> sigmas;
      for (const double sigma : read(name, 1))
        sigmas.push_back(static_cast<float>(sigma));
      return sigmas;
    };
    part.sigma_mm = read_sigma("_SIGMA_MM");
    if (!part.sigma_mm.empty() && attributes.contains("_SIGMA_NOISE_MM") &&
        attributes.contains("_SIGMA_SYSTEMATIC_MM")) {
      part.sigma_noise_mm = read_sigma("_SIGMA_NOISE_MM");
      part.sigma_systematic_mm = read_sigma("_SIGMA_SYSTEMATIC_MM");
    }
    for (const double views : read("_VIEWS", 1))
      part.views.push_back(static_cast<std::uint16_t>(views > 0 ? std::min(views, 65'535.0) : 0.0));
    if (attributes.contains("COLOR_0")) {
      const std::size_t width = document_.width_of(document_.whole(attributes.at("COLOR_0")));
      if (width < 3) document_.fail("its COLOR_0 is neither VEC3 nor VEC4; export it again");
      const std::vector<double> colors = read("COLOR_0", width);
      for (std::size_t i = 0; i < colors.size(); i += width) {
        part.colors.push_back({srgb_from_linear(colors[i]),
                               srgb_from_linear(colors[i + 1]),
                               srgb_from_linear(colors[i + 2])});
      }
    }
    for (const double mark : read("_MARK", 1)) {
      part.vertex_marks.push_back(mark == 1.0   ? Mark::Displaced
                                  : mark == 2.0 ? Mark::Synthesized
                                                : Mark::Measured);
    }
    return part;
  }

  [[nodiscard]] Mark mark_of_material(const json& primitive) const {
    if (!primitive.contains("material")) return Mark::Measured;
    const json& material = document_.item("materials", document_.whole(primitive.at("material")));
    return find_named<Mark>(material.value("name", "")).value_or(Mark::Measured);
  }

  /// The corners of a strip or fan as those of triangles.
  ///
  /// @source   glTF 2.0, 3.7.2.1
  static std::vector<double> as_triangles(const std::vector<double>& corners,
                                          std::uint64_t mode,
                                          const std::vector<Eigen::Vector3f>& vertices) {
    if (mode == kGltfTriangles) return corners;
    std::vector<double> all;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
      const bool odd = i % 2 == 1;
      const std::array<double, 3> three =
          mode == kGltfFan
              ? std::array{corners[i + 1], corners[i + 2], corners[0]}
              : std::array{corners[i], corners[odd ? i + 2 : i + 1], corners[odd ? i + 1 : i + 2]};
      const auto is_same = [&](double a, double b) {
        const auto count = static_cast<double>(vertices.size());
        const bool exist = a >= 0.0 && b >= 0.0 && a < count && b < count;
        return a == b || (exist && vertices[static_cast<std::size_t>(a)] ==
                                       vertices[static_cast<std::size_t>(b)]);
      };
      // A strip is led on by triangles without an area.
      if (!is_same(three[0], three[1]) && !is_same(three[1], three[2]) &&
          !is_same(three[2], three[0]))
        all.insert(all.end(), three.begin(), three.end());
    }
    return all;
  }

  void add_triangles(Mesh& part, const json& primitive, std::uint64_t mode) const {
    const std::size_t count = part.vertices_mm.size();
    std::vector<double> corners;
    if (primitive.contains("indices")) {
      corners = document_.numbers(document_.whole(primitive.at("indices")), 1);
    } else {
      for (std::size_t i = 0; i < count; ++i)
        corners.push_back(static_cast<double>(i));
    }
    corners = as_triangles(corners, mode, part.vertices_mm);
    if (corners.size() % 3 != 0)
      document_.fail("the number of its indices is not a multiple of three; export it again");
    const Mark mark = mark_of_material(primitive);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      Mesh::Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double corner = corners[i + k];
        if (!(corner >= 0.0 && corner < static_cast<double>(count))) {
          document_.fail(fmt::format(
              "a triangle refers to vertex {}, counted from 0, of only {}; export it again",
              corner,
              count));
        }
        triangle.at(k) = static_cast<std::uint32_t>(corner);
      }
      add_triangle(part, triangle, mark);
    }
  }

  const GltfDocument& document_;
  const ReadOptions& options_;
  const Run& run_;
  std::vector<Instance> instances_;
  Mesh mesh_;
  std::set<std::uint64_t> seen_;
  std::size_t skipped_ = 0;
  std::size_t skinned_ = 0;
  std::size_t morphed_ = 0;
  std::size_t hidden_ = 0;
  bool all_have_normals_ = true;
};

}  // namespace

Mesh read_gltf(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  try {
    GltfDocument document;
    read_gltf_document(path, document);
    Mesh mesh = GltfReader(document, options, run).read();
    check_mesh(mesh, path);
    return mesh;
  } catch (const json::exception& error) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: it is not valid glTF ({}); export it again", path.string(), error.what()));
  }
}

}  // namespace frangia
