#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/memory_budget.h"
#include "frangia/core/xml_parser.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Collects the objects and build items of the models of a 3MF package from their XML elements. The
/// first part is the one that is built; its objects may refer to those of further parts (production
/// extension).
///
/// @errors   Error(Input) without the name of the file
class ThreeMfModel {
 public:
  /// Begins the model in a file of the package, by its name there.
  void begin_part(const std::string& name);
  /// Takes note of a prefix, by which a model names the extensions that it requires.
  void declare_namespace(std::string_view prefix, std::string_view uri);
  /// The files of the package that objects or build items refer to so far.
  [[nodiscard]] const std::set<std::string>& parts() const { return parts_; }
  /// Handles the start of an element; `name` is "namespace|name".
  void begin(std::string_view name, const XmlAttributes& attributes);
  /// Memory of what has been collected, bytes.
  [[nodiscard]] double collected_bytes() const { return collected_bytes_; }
  /// The mesh of all build items, in mm. `path` is for messages.
  ///
  /// @errors   Error(Input) also when the repeated objects exceed the budget
  struct Built {
    Mesh mesh;
    std::size_t left_out = 0;  ///< objects that are no part: supports, modifiers of a slicer
    std::size_t shapes = 0;    ///< beams and other shapes of extensions, which are no triangles
  };
  [[nodiscard]] Built build(const std::filesystem::path& path, const MemoryBudget& budget) const;

 private:
  /// An object by the file that it is in and its number there.
  using Key = std::pair<std::string, std::uint32_t>;
  struct Reference {
    Key object;
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  };
  struct Object {
    Mesh mesh;
    std::vector<Reference> components;
    std::string material, index;  ///< of triangles without a material of their own
    bool is_aid = false;          ///< a support, or a modifier of a slicer
    std::size_t shapes = 0;       ///< of extensions, which are no triangles
  };

  Reference read_reference(const XmlAttributes& attributes);
  void check_extensions(std::string_view prefixes) const;
  /// A name that no other part of the file has.
  [[nodiscard]] std::string in_part(std::string_view id) const;
  /// Scale from the unit of a part to that of another.
  [[nodiscard]] double scale_between(const std::string& from, const std::string& to) const;
  Object& object();
  void begin_object(const XmlAttributes& attributes);
  void count_shape(std::string_view name);
  void vertex(const XmlAttributes& attributes);
  void triangle(const XmlAttributes& attributes);
  void color_corners(Object& owner, const Mesh::Triangle& corners, const XmlAttributes& attributes);
  [[nodiscard]] Mark mark_of_material(std::string_view id, std::string_view index) const;
  [[nodiscard]] const Object& object_of(const Reference& reference, int depth) const;
  [[nodiscard]] double memory_of(const Reference& reference,
                                 std::map<Key, double>& known,
                                 int depth) const;
  void add(Built& built,
           const Reference& reference,
           const Eigen::Affine3d& parent,
           const std::filesystem::path& path,
           int depth) const;

  std::map<Key, Object> objects_;
  std::map<std::string, std::vector<std::string>> materials_;
  std::map<std::string, std::vector<VertexColor>> colors_;  ///< by the id of their group
  std::string color_group_;
  std::vector<Reference> items_;
  std::uint32_t current_ = 0xFFFFFFFF;
  std::string material_;
  std::string root_;  ///< the part that is built
  std::string part_;  ///< that is read
  std::set<std::string> parts_;
  std::map<std::string, double> mm_per_unit_;        ///< of each part
  std::map<std::string, std::string> namespace_of_;  ///< by its prefix, in this part
  double collected_bytes_ = 0.0;
};

}  // namespace frangia
