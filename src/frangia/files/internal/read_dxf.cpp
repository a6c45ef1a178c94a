#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/dxf.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/dxf_entities.h"
#include "frangia/files/internal/dxf_groups.h"
#include "frangia/files/internal/read_bytes.h"

namespace frangia {
namespace {

/// mm per unit of $INSUNITS; 1 for 0, which stands for unknown, and for exotic units.
double mm_of(std::int64_t unit) {
  switch (unit) {
    case 1:  // inch
      return 25.4;
    case 2:  // foot
      return 304.8;
    case 5:  // cm
      return 10.0;
    case 6:  // m
      return 1000.0;
    case 7:  // km
      return 1e6;
    case 13:  // micrometre
      return 1e-3;
    case 14:  // dm
      return 100.0;
    default:
      return 1.0;
  }
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
        more = groups_.next();
      } else if (groups_.code() == 0 && section_ == "ENTITIES") {
        more = entities_.read();
      } else if (groups_.is(9, "$INSUNITS") && section_ == "HEADER") {
        more = groups_.next();
        if (more && groups_.code() == 70) mm_per_unit_ = mm_of(groups_.integer());
      } else {
        more = groups_.next();
      }
    }
    truncated_ = !more && !section_.empty();
  }

  /// Whether the file ends within a section.
  [[nodiscard]] bool truncated() const { return truncated_; }
  [[nodiscard]] std::string skipped() const { return entities_.skipped(); }
  [[nodiscard]] Mesh release_mesh() { return entities_.release_mesh(mm_per_unit_); }

 private:
  DxfGroups groups_;
  DxfEntities entities_{groups_};
  bool truncated_ = false;
  std::string section_;
  double mm_per_unit_ = 1.0;
};

}  // namespace

Mesh read_dxf(const std::filesystem::path& path, const Run& run) {
  const std::string text = read_bytes(path);
  if (text.starts_with("AutoCAD Binary DXF")) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: this is a binary DXF; save it as text (ASCII) DXF", path.string()));
  }
  DxfReader reader(path, text);
  reader.read();
  const std::string skipped = reader.skipped();
  Mesh mesh = reader.release_mesh();
  check_mesh(mesh, path);
  if (mesh.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has no 3DFACE, polyface or MESH with an area{}{}; explode "
                            "blocks and save surfaces as meshes",
                            path.string(),
                            skipped.empty() ? "" : ", only ",
                            skipped));
  }
  if (reader.truncated()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the file is truncated within a section, after {} triangle{}",
                            path.string(),
                            mesh.triangles.size(),
                            mesh.triangles.size() == 1 ? "" : "s"));
  }
  if (!skipped.empty()) {
    run.warn(fmt::format("{}: skipped {}, which are not meshes", path.string(), skipped));
  }
  return mesh;
}

}  // namespace frangia
