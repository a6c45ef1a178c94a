#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/memory_budget.h"
#include "frangia/core/xml_parser.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Collects the objects and build items of a 3MF model from its XML elements.
///
/// @errors   Error(Input) without the name of the file
class ThreeMfModel {
 public:
  /// Handles the start of an element; `name` is "namespace|name".
  void begin(std::string_view name, const XmlAttributes& attributes);
  /// Memory of what has been collected, bytes.
  [[nodiscard]] double collected_bytes() const { return collected_bytes_; }
  /// The mesh of all build items, in mm. `path` is for messages.
  ///
  /// @errors   Error(Input) also when the repeated objects exceed the budget
  [[nodiscard]] Mesh build(const std::filesystem::path& path, const MemoryBudget& budget) const;

 private:
  struct Reference {
    std::uint32_t object = 0;
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  };
  struct Object {
    Mesh mesh;
    std::vector<Reference> components;
    std::string material, index;  ///< of triangles without a material of their own
  };

  static Reference read_reference(const XmlAttributes& attributes);
  Object& object();
  void begin_object(const XmlAttributes& attributes);
  void vertex(const XmlAttributes& attributes);
  void triangle(const XmlAttributes& attributes);
  void color_corners(Object& owner, const Mesh::Triangle& corners, const XmlAttributes& attributes);
  [[nodiscard]] Mark mark_of_material(std::string_view id, std::string_view index) const;
  [[nodiscard]] const Object& object_of(const Reference& reference, int depth) const;
  [[nodiscard]] double memory_of(const Reference& reference,
                                 std::map<std::uint32_t, double>& known,
                                 int depth) const;
  void add(Mesh& mesh,
           const Reference& reference,
           const Eigen::Affine3d& parent,
           const std::filesystem::path& path,
           int depth) const;

  std::map<std::uint32_t, Object> objects_;
  std::map<std::string, std::vector<std::string>> materials_;
  std::map<std::string, std::vector<VertexColor>> colors_;  ///< by the id of their group
  std::string color_group_;
  std::vector<Reference> items_;
  std::uint32_t current_ = 0xFFFFFFFF;
  std::string material_;
  double mm_per_unit_ = 1.0;
  double collected_bytes_ = 0.0;
};

}  // namespace frangia
