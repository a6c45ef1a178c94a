#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/append_transformed.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/mark_names.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/three_mf.h"
#include "frangia/files/internal/xml_parser.h"
#include "frangia/files/internal/zip_file.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr std::string_view kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02|";

struct ObjectReference {
  std::uint32_t object = 0;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
};

struct Object {
  Mesh mesh;
  std::vector<ObjectReference> components;
  std::string material, index;  ///< of its triangles that name none
};

/// What a model's XML says, gathered element by element.
class Model {
 public:
  void begin(std::string_view name, const XmlAttributes& attributes) {
    if (!name.starts_with(kCore)) return;
    name.remove_prefix(kCore.size());
    if (name == "vertex") {
      vertex(attributes);
    } else if (name == "triangle") {
      triangle(attributes);
    } else if (name == "object") {
      current_ = id_of(attributes.value("id"));
      if (objects_.contains(current_)) fail(fmt::format("object {} comes twice", current_));
      objects_[current_].material = attributes.value("pid");
      objects_[current_].index = attributes.value("pindex");
    } else if (name == "component") {
      object().components.push_back(read_reference(attributes));
    } else if (name == "item") {
      items_.push_back(read_reference(attributes));
    } else if (name == "base") {
      materials_[material_].emplace_back(attributes.value("name"));
    } else if (name == "basematerials") {
      material_ = attributes.value("id");
    } else if (name == "model") {
      mm_per_unit_ = mm_of(attributes.value("unit"));
    }
  }

  Mesh build(const std::filesystem::path& path) const {
    Mesh mesh;
    Eigen::Affine3d mm_from_model = Eigen::Affine3d::Identity();
    mm_from_model.scale(mm_per_unit_);
    for (const ObjectReference& item : items_)
      add(mesh, item, mm_from_model, path, 0);
    return mesh;
  }

  [[noreturn]] static void fail(const std::string& why) { throw Error(ErrorKind::Input, why); }

 private:
  static double mm_of(std::string_view unit) {
    static const std::map<std::string_view, double> kUnits{{"micron", 0.001},
                                                           {"millimeter", 1.0},
                                                           {"", 1.0},
                                                           {"centimeter", 10.0},
                                                           {"inch", 25.4},
                                                           {"foot", 304.8},
                                                           {"meter", 1000.0}};
    const auto found = kUnits.find(unit);
    if (found == kUnits.end()) fail(fmt::format("its unit is {}, which is none", in_quotes(unit)));
    return found->second;
  }

  static std::uint32_t id_of(std::string_view word) {
    const auto number = parse_integer(word);
    if (!number || *number < 0 || *number >= 0xFFFFFFFF) {
      fail(fmt::format("{} is not a number of something", in_quotes(word)));
    }
    return static_cast<std::uint32_t>(*number);
  }

  static float real(const XmlAttributes& attributes, std::string_view name) {
    const auto number = parse_float(attributes.value(name));
    if (!number) {
      fail(fmt::format(
          "{}={} of a vertex is not a number", name, in_quotes(attributes.value(name))));
    }
    return *number;
  }

  static ObjectReference read_reference(const XmlAttributes& attributes) {
    ObjectReference reference{.object = id_of(attributes.value("objectid"))};
    const std::string_view text = attributes.value("transform");
    if (text.empty()) return reference;
    TextReader reader("transform", text);
    for (int row = 0; row < 4; ++row) {  // of the transposed matrix: the last is the shift
      for (int column = 0; column < 3; ++column)
        reference.transform.matrix()(column, row) = static_cast<double>(reader.real());
    }
    return reference;
  }

  Object& object() {
    const auto found = objects_.find(current_);
    if (found == objects_.end()) fail("a vertex, triangle or component is outside of any object");
    return found->second;
  }

  void vertex(const XmlAttributes& attributes) {
    object().mesh.vertices_mm.emplace_back(
        real(attributes, "x"), real(attributes, "y"), real(attributes, "z"));
  }

  void triangle(const XmlAttributes& attributes) {
    Object& owner = object();
    const std::size_t count = owner.mesh.vertices_mm.size();
    Mesh::Triangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      constexpr std::array<std::string_view, 3> kNames{"v1", "v2", "v3"};
      corners.at(i) = id_of(attributes.value(kNames.at(i)));
      if (corners.at(i) >= count) {
        fail(fmt::format("a triangle of object {} refers to vertex {}, counted from 0, of only {}",
                         current_,
                         corners.at(i),
                         count));
      }
    }
    const bool own = !attributes.value("pid").empty();
    add_triangle(owner.mesh,
                 corners,
                 mark_of_material(own ? attributes.value("pid") : owner.material,
                                  own ? attributes.value("p1") : owner.index));
  }

  [[nodiscard]] Mark mark_of_material(std::string_view id, std::string_view index) const {
    const auto group = materials_.find(std::string(id));
    const auto number = parse_integer(index);
    if (group == materials_.end() || !number || *number < 0 ||
        static_cast<std::uint64_t>(*number) >= group->second.size()) {
      return Mark::Measured;
    }
    return mark_of_name(group->second[static_cast<std::size_t>(*number)]);
  }

  void add(Mesh& mesh,
           const ObjectReference& reference,
           const Eigen::Affine3d& parent,
           const std::filesystem::path& path,
           int depth) const {
    constexpr int kDeepest = 64;
    constexpr std::size_t kMaxInstances = 100'000;
    const auto found = objects_.find(reference.object);
    if (found == objects_.end()) {
      fail(fmt::format("object {} is built, but not there", reference.object));
    }
    if (depth > kDeepest || ++instances_ > kMaxInstances) {
      fail("an object is part of itself, or parts are nested too deep or too often");
    }
    const Eigen::Affine3d transform = parent * reference.transform;
    if (!found->second.mesh.empty()) append_transformed(mesh, found->second.mesh, transform, path);
    for (const ObjectReference& component : found->second.components)
      add(mesh, component, transform, path, depth + 1);
  }

  std::map<std::uint32_t, Object> objects_;
  std::map<std::string, std::vector<std::string>> materials_;
  std::vector<ObjectReference> items_;
  std::uint32_t current_ = 0xFFFFFFFF;
  std::string material_;
  double mm_per_unit_ = 1.0;
  mutable std::size_t instances_ = 0;
};

/// The name of the package's model, as its relationships say.
std::string model_name(const ZipReader& zip) {
  std::string name = "3D/3dmodel.model";
  XmlParser elements(
      [&](std::string_view element, const XmlAttributes& attributes) {
        const bool is_model =
            element.ends_with("|Relationship") && attributes.value("Type").ends_with("/3dmodel");
        if (!is_model) return;
        name = attributes.value("Target");
        if (name.starts_with('/')) name.erase(0, 1);
      },
      [](std::string_view) {});
  if (zip.read("_rels/.rels", [&](std::string_view piece) { elements.feed(piece); })) {
    elements.finish();
  }
  return name;
}

Mesh read_package(const std::filesystem::path& path, const Run& run) {
  const ZipReader zip(path);
  const std::string name = model_name(zip);
  Model model;
  bool further = false;
  XmlParser elements(
      [&](std::string_view element, const XmlAttributes& attributes) {
        model.begin(element, attributes);
        constexpr std::string_view kPath =
            "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
        further = further || !attributes.value(kPath).empty();
      },
      [](std::string_view) {});
  if (!zip.read(name, [&](std::string_view piece) { elements.feed(piece); })) {
    Model::fail(fmt::format("there is no model {} in it; it is no 3MF", in_quotes(name)));
  }
  elements.finish();
  if (further) run.warn(fmt::format("{}: models in further files are left out", path.string()));
  return model.build(path);
}

}  // namespace

Mesh read_3mf(const std::filesystem::path& path, const Run& run) {
  Mesh mesh;
  try {
    mesh = read_package(path, run);
  } catch (const Error& error) {
    const std::string why = error.what();
    if (error.kind() != ErrorKind::Input || why.starts_with(path.string())) throw;
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
  }
  check_mesh(mesh, path);
  if (mesh.empty()) {
    throw Error(ErrorKind::Input, fmt::format("{}: it builds no triangle", path.string()));
  }
  return mesh;
}

}  // namespace frangia
