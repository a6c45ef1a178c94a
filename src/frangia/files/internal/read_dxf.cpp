#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/dxf.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/dxf_drawing.h"
#include "frangia/files/internal/dxf_entities.h"
#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

/// mm per unit of $INSUNITS by its number; 0 stands for unknown, and mm are assumed.
///
/// @source   Autodesk, DXF Reference 2024, HEADER section; US survey units: NIST Handbook 44
constexpr std::array<double, 25> kMmOfUnit{
    1.0,
    25.4,                   // inch
    304.8,                  // foot
    1'609'344.0,            // mile
    1.0,                    // mm
    10.0,                   // cm
    1000.0,                 // m
    1e6,                    // km
    25.4e-6,                // microinch
    0.0254,                 // mil
    914.4,                  // yard
    1e-7,                   // angstrom
    1e-6,                   // nm
    1e-3,                   // micrometre
    100.0,                  // dm
    1e4,                    // dam
    1e5,                    // hm
    1e12,                   // Gm
    149'597'870'700'000.0,  // astronomical unit
    9.4607304725808e18,     // light year
    3.0856775814913673e19,  // parsec
    1200e3 / 3937.0,        // US survey foot
    100e3 / 3937.0,         // US survey inch
    3600e3 / 3937.0,        // US survey yard
    6336e6 / 3937.0,        // US survey mile
};

/// Nothing for a number that no release defines.
std::optional<double> mm_of(std::int64_t unit) {
  if (unit < 0 || static_cast<std::uint64_t>(unit) >= kMmOfUnit.size()) return std::nullopt;
  return kMmOfUnit.at(static_cast<std::size_t>(unit));
}

class DxfReader {
 public:
  DxfReader(const std::filesystem::path& path, std::string_view text) : groups_(path, text) {}

  void read() {
    bool more = groups_.next();
    while (more && !groups_.is(0, "EOF")) {
      if (groups_.is(0, "SECTION")) {
        more = groups_.next();
        section_ = more && groups_.code() == 2 ? std::string(groups_.value()) : "";
        more = more && groups_.next();
      } else if (groups_.is(0, "ENDSEC")) {
        section_.clear();
        entities_.end_block();
        more = groups_.next();
      } else if (groups_.is(0, "BLOCK") && section_ == "BLOCKS") {
        more = entities_.begin_block();
      } else if (groups_.is(0, "ENDBLK") && section_ == "BLOCKS") {
        entities_.end_block();
        more = groups_.next();
      } else if (groups_.code() == 0 && (section_ == "ENTITIES" || section_ == "BLOCKS")) {
        more = entities_.read();
      } else if (groups_.is(9, "$INSUNITS") && section_ == "HEADER") {
        more = groups_.next();
        if (more && groups_.code() == 70) take_unit(groups_.integer());
      } else if (groups_.is(9, "$MEASUREMENT") && section_ == "HEADER") {
        more = groups_.next();
        imperial_ = more && groups_.code() == 70 && groups_.integer() == 0;
      } else if (groups_.is(0, "LAYER") && section_ == "TABLES") {
        more = read_layer();
      } else {
        more = groups_.next();
      }
    }
    truncated_ = !more && !section_.empty();
  }

  /// Whether the file ends within a section.
  [[nodiscard]] bool truncated() const { return truncated_; }
  [[nodiscard]] std::string skipped() const { return entities_.skipped(); }
  [[nodiscard]] DxfBlocks release_blocks() { return entities_.release_blocks(mm_per_unit_); }
  void warn(const std::filesystem::path& path, const Run& run) const {
    entities_.odd_faces().warn(path, mm_per_unit_, run);
    if (unknown_unit_) {
      run.warn(fmt::format("{}: its $INSUNITS {} is no unit that is known; mm are assumed",
                           path.string(),
                           *unknown_unit_));
    }
    if (imperial_ && no_unit_) {
      run.warn(
          fmt::format("{}: it is an imperial drawing ($MEASUREMENT 0) without a unit "
                      "($INSUNITS); mm are assumed",
                      path.string()));
    }
    if (entities_.cages() > 0) {
      run.warn(
          fmt::format("{}: {} MESH {} subdivided by the program that shows it; the cage is "
                      "read, without the subdivision",
                      path.string(),
                      entities_.cages(),
                      entities_.cages() == 1 ? "is" : "are"));
    }
    const std::string left_out = entities_.left_out();
    if (!left_out.empty()) run.warn(fmt::format("{}: left out {}", path.string(), left_out));
  }
  void count_hidden(std::size_t meshes) { entities_.count_hidden(meshes); }
  [[nodiscard]] std::string left_out() const { return entities_.left_out(); }

 private:
  void take_unit(std::int64_t unit) {
    const std::optional<double> mm = mm_of(unit);
    mm_per_unit_ = mm.value_or(1.0);
    no_unit_ = unit == 0;
    if (!mm) unknown_unit_ = unit;
  }

  /// Takes note of a layer that is not shown: bit 1 of its flags freezes it, a negative color
  /// switches it off.
  bool read_layer() {
    std::string name;
    DxfLayerState state;
    bool more = false;
    while ((more = groups_.next()) && groups_.code() != 0) {
      if (groups_.code() == 2) name = groups_.value();
      if (groups_.code() == 70) state.frozen = (groups_.integer() & 1) != 0;
      if (groups_.code() == 62) state.off = groups_.integer() < 0;
    }
    if (state.off || state.frozen) entities_.hide_layer(name, state);
    return more;
  }

  DxfGroups groups_;
  DxfEntities entities_{groups_};
  bool truncated_ = false;
  std::string section_;
  double mm_per_unit_ = 1.0;
  std::optional<std::int64_t> unknown_unit_;
  bool no_unit_ = true;    ///< of $INSUNITS
  bool imperial_ = false;  ///< by $MEASUREMENT
};

}  // namespace

Mesh read_dxf(const std::filesystem::path& path, const Run& run, const ReadOptions& options) {
  std::string bytes = read_bytes(path);
  if (bytes.starts_with("AutoCAD Binary DXF")) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: this is a binary DXF; save it as text (ASCII) DXF", path.string()));
  }
  const std::string text = plain_text(std::move(bytes));
  DxfReader reader(path, text);
  reader.read();
  const std::string skipped = reader.skipped();
  const MemoryBudget budget(path, text.size(), options.allow_memory_bytes);
  DxfExpanded expanded = expand_blocks(reader.release_blocks(), path, budget, run);
  Mesh mesh = std::move(expanded.mesh);
  reader.count_hidden(expanded.hidden);
  check_mesh(mesh, path);
  if (mesh.empty()) {
    const std::string left_out = reader.left_out();
    const std::string others =
        skipped + (skipped.empty() || left_out.empty() ? "" : " and ") + left_out;
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has no 3DFACE, polyface or MESH with an area{}{}; save "
                            "surfaces as meshes",
                            path.string(),
                            others.empty() ? "" : ", only ",
                            others));
  }
  if (reader.truncated()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the file is truncated within a section, after {} triangle{}",
                            path.string(),
                            mesh.triangles.size(),
                            mesh.triangles.size() == 1 ? "" : "s"));
  }
  reader.warn(path, run);
  if (expanded.missing > 0) {
    run.warn(fmt::format("{}: left out {} INSERT of blocks that the file does not hold",
                         path.string(),
                         expanded.missing));
  }
  for (const auto& [other, count] : expanded.externals) {
    run.warn(
        fmt::format("{}: left out {} INSERT of the external drawing {}; bind it and save again",
                    path.string(),
                    count,
                    other));
  }
  if (!skipped.empty()) {
    run.warn(fmt::format("{}: skipped {}, which are not meshes", path.string(), skipped));
  }
  return mesh;
}

}  // namespace frangia
