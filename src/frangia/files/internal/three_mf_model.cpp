#include "frangia/files/internal/three_mf_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/append_transformed.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

constexpr std::string_view kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02|";

constexpr std::string_view kMaterials =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02|";

/// A color of the form #RRGGBB or #RRGGBBAA.
VertexColor color_of_text(std::string_view text) {
  VertexColor color = kUnknownColor;
  if (text.size() < 7 || text.front() != '#') return color;
  for (std::size_t i = 0; i < color.size(); ++i) {
    const char* const digits = text.data() + 1 + 2 * i;
    std::uint8_t value = 0;
    if (std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2) return kUnknownColor;
    color.at(i) = value;
  }
  return color;
}

[[noreturn]] void fail_3mf(const std::string& why) {
  throw Error(ErrorKind::Input, why);
}

/// mm per unit of a model; the specification's default is millimeter.
double mm_per_unit_of(std::string_view unit) {
  static const std::map<std::string_view, double> kUnits{{"micron", 0.001},
                                                         {"millimeter", 1.0},
                                                         {"", 1.0},
                                                         {"centimeter", 10.0},
                                                         {"inch", 25.4},
                                                         {"foot", 304.8},
                                                         {"meter", 1000.0}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end())
    fail_3mf(fmt::format("its unit {} is not defined by 3MF; export it in millimeters",
                         in_quotes(unit)));
  return found->second;
}

std::uint32_t id_of(std::string_view word) {
  const auto number = parse_integer(word);
  if (!number || *number < 0 || *number >= 0xFFFFFFFF) {
    fail_3mf(fmt::format("{} is not a valid id or index", in_quotes(word)));
  }
  return static_cast<std::uint32_t>(*number);
}

float coordinate(const XmlAttributes& attributes, std::string_view name) {
  const auto number = parse_float(attributes.value(name));
  if (!number) {
    fail_3mf(
        fmt::format("{}={} of a vertex is not a number", name, in_quotes(attributes.value(name))));
  }
  return *number;
}

}  // namespace

void ThreeMfModel::begin_part(const std::string& name) {
  if (mm_per_unit_.empty()) root_ = name;
  part_ = name;
  current_ = 0xFFFFFFFF;
  namespace_of_.clear();
  mm_per_unit_[name] = 1.0;
}

void ThreeMfModel::declare_namespace(std::string_view prefix, std::string_view uri) {
  namespace_of_[std::string(prefix)] = uri;
}

void ThreeMfModel::check_extensions(std::string_view prefixes) const {
  // Those whose models keep their triangles where the core specification has them.
  constexpr std::array<std::string_view, 4> kRead{
      "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
      "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
      "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07",
      "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"};
  TextReader words("requiredextensions", prefixes);
  for (auto prefix = words.word(); !prefix.empty(); prefix = words.word()) {
    const auto known = namespace_of_.find(std::string(prefix));
    const std::string_view uri = known == namespace_of_.end() ? prefix : known->second;
    if (std::find(kRead.begin(), kRead.end(), uri) != kRead.end()) continue;
    fail_3mf(fmt::format("it requires an extension that is not read, {}; export it as triangles",
                         std::string(uri.substr(0, 200))));
  }
}

std::string ThreeMfModel::in_part(std::string_view id) const {
  return fmt::format("{}|{}", part_, id);
}

double ThreeMfModel::scale_between(const std::string& from, const std::string& to) const {
  const auto unit = [&](const std::string& part) {
    const auto found = mm_per_unit_.find(part);
    return found == mm_per_unit_.end() ? 1.0 : found->second;
  };
  return unit(from) / unit(to);
}

void ThreeMfModel::begin(std::string_view name, const XmlAttributes& attributes) {
  constexpr double kGrowth = 2.0;       // of a vector: its capacity is up to twice its size
  constexpr double kMapNode = 64.0;     // bytes that a map adds to an entry
  constexpr double kCorners = 3.0 * 4;  // bytes of a vertex or triangle
  if (name.starts_with(kMaterials)) {
    name.remove_prefix(kMaterials.size());
    if (name == "colorgroup") color_group_ = in_part(attributes.value("id"));
    if (name != "color") return;
    colors_[color_group_].push_back(color_of_text(attributes.value("color")));
    collected_bytes_ += kGrowth * sizeof(VertexColor);
    return;
  }
  if (!name.starts_with(kCore)) return count_shape(name);
  name.remove_prefix(kCore.size());
  if (name == "vertex") {
    vertex(attributes);
    collected_bytes_ += kGrowth * kCorners;
  } else if (name == "triangle") {
    triangle(attributes);
    collected_bytes_ += kGrowth * kCorners;
  } else if (name == "object") {
    begin_object(attributes);
    collected_bytes_ += sizeof(Object) + kMapNode;
  } else if (name == "component") {
    object().components.push_back(read_reference(attributes));
    collected_bytes_ += kGrowth * sizeof(Reference);
  } else if (name == "item" && part_ == root_) {
    items_.push_back(read_reference(attributes));
    collected_bytes_ += kGrowth * sizeof(Reference);
  } else if (name == "base") {
    const std::string_view material = attributes.value("name");
    materials_[material_].emplace_back(material);
    collected_bytes_ +=
        kGrowth * sizeof(std::string) + kMapNode + static_cast<double>(material.size());
  } else if (name == "basematerials") {
    material_ = in_part(attributes.value("id"));
  } else if (name == "model") {
    mm_per_unit_[part_] = mm_per_unit_of(attributes.value("unit"));
    check_extensions(attributes.value("requiredextensions"));
  }
}

ThreeMfModel::Built ThreeMfModel::build(const std::filesystem::path& path,
                                        const MemoryBudget& budget) const {
  std::map<Key, double> memory_of_object;
  double needed_bytes = collected_bytes_;
  for (const Reference& item : items_)
    needed_bytes += memory_of(item, memory_of_object, 0);
  budget.check(needed_bytes);
  Built built;
  Eigen::Affine3d mm_from_model = Eigen::Affine3d::Identity();
  mm_from_model.scale(mm_per_unit_.at(root_));
  for (const Reference& item : items_) {
    Reference scaled = item;
    scaled.transform.scale(scale_between(item.object.first, root_));
    add(built, scaled, mm_from_model, path, 0);
  }
  return built;
}

ThreeMfModel::Reference ThreeMfModel::read_reference(const XmlAttributes& attributes) {
  constexpr std::string_view kPath =
      "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
  std::string part(attributes.value(kPath));
  if (part.starts_with('/')) part.erase(0, 1);
  if (part.empty()) part = part_;
  parts_.insert(part);
  Reference reference{.object = {part, id_of(attributes.value("objectid"))}};
  const std::string_view text = attributes.value("transform");
  if (text.empty()) return reference;
  TextReader reader("transform", text);
  for (int row = 0; row < 4; ++row) {  // rows of the transposed matrix; the last is the translation
    for (int column = 0; column < 3; ++column)
      reference.transform.matrix()(column, row) = static_cast<double>(reader.real());
  }
  return reference;
}

ThreeMfModel::Object& ThreeMfModel::object() {
  const auto found = objects_.find({part_, current_});
  if (found == objects_.end())
    fail_3mf("a vertex, triangle or component is outside any object; export it again");
  return found->second;
}

void ThreeMfModel::begin_object(const XmlAttributes& attributes) {
  current_ = id_of(attributes.value("id"));
  if (objects_.contains({part_, current_})) {
    fail_3mf(fmt::format("object {} is defined twice; export it again", current_));
  }
  Object& made = objects_[{part_, current_}];
  made.material = attributes.value("pid");
  made.index = attributes.value("pindex");
  // "model", "surface" and none are the part itself; slicers write modifiers as "other".
  const std::string_view type = attributes.value("type");
  made.is_aid = type == "support" || type == "solidsupport" || type == "other";
}

/// Takes note of an element of an extension that stands for a part of the object: beams and their
/// balls, Boolean operations, displaced and implicit surfaces.
void ThreeMfModel::count_shape(std::string_view name) {
  constexpr std::array<std::string_view, 5> kShapes{
      "beam", "ball", "booleanshape", "displacementmesh", "levelset"};
  name.remove_prefix(std::min(name.rfind('|') + 1, name.size()));
  if (std::find(kShapes.begin(), kShapes.end(), name) == kShapes.end()) return;
  const auto found = objects_.find({part_, current_});
  if (found != objects_.end()) ++found->second.shapes;
}

void ThreeMfModel::vertex(const XmlAttributes& attributes) {
  object().mesh.vertices_mm.emplace_back(
      coordinate(attributes, "x"), coordinate(attributes, "y"), coordinate(attributes, "z"));
}

void ThreeMfModel::triangle(const XmlAttributes& attributes) {
  Object& owner = object();
  const std::size_t count = owner.mesh.vertices_mm.size();
  Mesh::Triangle corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr std::array<std::string_view, 3> kNames{"v1", "v2", "v3"};
    corners.at(i) = id_of(attributes.value(kNames.at(i)));
    if (corners.at(i) >= count) {
      fail_3mf(
          fmt::format("a triangle of object {} refers to vertex {}, counted from 0, of only {}",
                      current_,
                      corners.at(i),
                      count));
    }
  }
  const bool own = !attributes.value("pid").empty();
  color_corners(owner, corners, attributes);
  add_triangle(owner.mesh,
               corners,
               mark_of_material(own ? attributes.value("pid") : owner.material,
                                own ? attributes.value("p1") : owner.index));
}

/// Gives the corners of a triangle the colors that it refers to, if these are of a color group.
void ThreeMfModel::color_corners(Object& owner,
                                 const Mesh::Triangle& corners,
                                 const XmlAttributes& attributes) {
  if (colors_.empty()) return;
  const bool own = !attributes.value("pid").empty();
  const auto group =
      colors_.find(in_part(own ? attributes.value("pid") : std::string_view(owner.material)));
  if (group == colors_.end()) return;
  constexpr std::array<std::string_view, 3> kNames{"p1", "p2", "p3"};
  const std::string_view first = own ? attributes.value("p1") : std::string_view(owner.index);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::string_view text = own ? attributes.value(kNames.at(i)) : first;
    const auto index = parse_integer(text.empty() ? first : text);
    const bool exists =
        index && *index >= 0 && static_cast<std::uint64_t>(*index) < group->second.size();
    if (!exists) continue;
    owner.mesh.colors.resize(owner.mesh.vertices_mm.size(), kUnknownColor);
    owner.mesh.colors[corners.at(i)] = group->second[static_cast<std::size_t>(*index)];
  }
}

Mark ThreeMfModel::mark_of_material(std::string_view id, std::string_view index) const {
  const auto group = materials_.find(in_part(id));
  const auto number = parse_integer(index);
  if (group == materials_.end() || !number || *number < 0 ||
      static_cast<std::uint64_t>(*number) >= group->second.size()) {
    return Mark::Measured;
  }
  return find_named<Mark>(group->second[static_cast<std::size_t>(*number)])
      .value_or(Mark::Measured);
}

const ThreeMfModel::Object& ThreeMfModel::object_of(const Reference& reference, int depth) const {
  constexpr int kMaxDepth = 64;
  const auto found = objects_.find(reference.object);
  if (found == objects_.end()) {
    fail_3mf(fmt::format("object {} is built but not defined; export it again",
                         reference.object.second));
  }
  if (depth > kMaxDepth) {
    fail_3mf("an object contains itself, or components are nested too deeply; export it again");
  }
  return found->second;
}

/// Memory of an object with its components. Each object is visited once, however often it is
/// repeated.
double ThreeMfModel::memory_of(const Reference& reference,
                               std::map<Key, double>& known,
                               int depth) const {
  constexpr double kPerInstance = 1000.0;  // bytes; bounds the time for instances without triangles
  const auto found = known.find(reference.object);
  if (found != known.end()) return found->second;
  const Object& object = object_of(reference, depth);
  double bytes =
      kPerInstance + mesh_memory_bytes(static_cast<double>(object.mesh.vertices_mm.size()),
                                       static_cast<double>(object.mesh.triangles.size()));
  for (const Reference& component : object.components)
    bytes += memory_of(component, known, depth + 1);
  known[reference.object] = bytes;
  return bytes;
}

void ThreeMfModel::add(Built& built,
                       const Reference& reference,
                       const Eigen::Affine3d& parent,
                       const std::filesystem::path& path,
                       int depth) const {
  const Object& object = object_of(reference, depth);
  if (object.is_aid) {
    ++built.left_out;
    return;
  }
  built.shapes += object.shapes;
  const Eigen::Affine3d transform = parent * reference.transform;
  if (!object.mesh.empty()) append_transformed(built.mesh, object.mesh, transform, path);
  for (const Reference& component : object.components) {
    Reference scaled = component;
    scaled.transform.scale(scale_between(component.object.first, reference.object.first));
    add(built, scaled, transform, path, depth + 1);
  }
}

}  // namespace frangia
