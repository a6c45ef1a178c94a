#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "frangia/files/internal/dxf_drawing.h"
#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/dxf_triangles.h"

namespace frangia {

/// Reads the entities of a DXF that hold triangles: 3DFACE, POLYLINE as a polyface or M x N mesh,
/// MESH, and blocks of them with INSERT. Counts the entities that it skips.
///
/// @errors   Error(Input) that names the file and the line
class DxfEntities {
 public:
  explicit DxfEntities(DxfGroups& groups) : groups_(groups) { open_content(""); }

  /// Reads from the name of an entity (group 0) to the name of the next; false at the end of the
  /// text.
  bool read();
  /// Reads from the name BLOCK to the name of the first entity: entities belong to the block from
  /// then on, until `end_block`.
  bool begin_block();
  void end_block() { open_content(""); }
  /// Leaves out what is on a layer from now on.
  void hide_layer(const std::string& name, const DxfLayerState& state);
  /// Counts meshes that blocks hide when they are expanded.
  void count_hidden(std::size_t meshes) { hidden_ += meshes; }
  /// The meshes that a drawing does not show: "2 entities of layers that are off or frozen, 1 of
  /// paper space"; empty when there is none.
  [[nodiscard]] std::string left_out() const;
  /// The MESH entities whose subdivision is not computed.
  [[nodiscard]] std::size_t cages() const { return cages_; }
  /// The skipped entities as "3 LINE, 1 CIRCLE"; empty when none was skipped.
  [[nodiscard]] std::string skipped() const;
  /// The faces that are no plane polygons.
  [[nodiscard]] const OddFaces& odd_faces() const { return odd_; }
  /// The drawing and its blocks in mm.
  [[nodiscard]] DxfBlocks release_blocks(double mm_per_unit);

 private:
  /// Where an entity belongs.
  struct Place {
    Mark mark = Mark::Measured;
    DxfLayerState layer;
    bool is_in_paper_space = false;
    bool is_invisible = false;
    bool on_layer_0 = false;  ///< of a block
  };
  /// Takes the layer and the space of an entity from the present group.
  void take_place(Place& place) const;
  /// Whether an entity is part of the model; counts one that is not.
  bool is_shown(const Place& place);
  /// Where an entity's triangles belong.
  DxfTriangles& triangles_of(const Place& place);
  /// What a block, or the drawing, holds so far, in its units.
  struct Content {
    DxfTriangles triangles;
    DxfTriangles on_layer_0;
    std::size_t entities_on_layer_0 = 0;
    std::string external{};
    Eigen::Vector3d base = Eigen::Vector3d::Zero();
    std::vector<DxfInsert> inserts{};
  };
  void open_content(const std::string& name);
  bool read_insert();
  bool to_next_entity();
  void skip(const std::string& name);
  bool read_face();
  bool read_polyline();
  bool read_vertex(DxfPolyline& line);
  bool read_mesh_entity();

  DxfGroups& groups_;
  OddFaces odd_;
  std::map<std::string, Content> contents_;  ///< by the name of the block; "": the drawing
  Content* content_ = nullptr;               ///< that entities belong to
  std::map<std::string, std::size_t> skipped_;
  bool in_block_ = false;
  bool in_paper_block_ = false;  ///< of another layout
  std::map<std::string, DxfLayerState> hidden_layers_;
  std::size_t hidden_ = 0;
  std::size_t invisible_ = 0;
  std::size_t in_paper_space_ = 0;
  std::size_t cages_ = 0;
};

}  // namespace frangia
