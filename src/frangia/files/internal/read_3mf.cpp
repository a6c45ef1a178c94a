#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/xml_parser.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/three_mf.h"
#include "frangia/files/internal/three_mf_model.h"
#include "frangia/files/internal/zip_file.h"

namespace frangia {
namespace {

/// The name of the package's model according to its relationships.
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
  if (zip.read("_rels/.rels", [&](std::string_view piece, double) { elements.feed(piece); })) {
    elements.finish();
  }
  return name;
}

Mesh read_package(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  const ZipReader zip(path);
  const MemoryBudget budget(path, std::filesystem::file_size(path), options.allow_memory_bytes);
  const std::string name = model_name(zip);
  ThreeMfModel model;
  bool has_further_models = false;
  XmlParser elements(
      [&](std::string_view element, const XmlAttributes& attributes) {
        model.begin(element, attributes);
        constexpr std::string_view kPath =
            "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
        has_further_models = has_further_models || !attributes.value(kPath).empty();
      },
      [](std::string_view) {});
  const auto feed = [&](std::string_view piece, double done) {
    elements.feed(piece);
    budget.check(model.collected_bytes(), model.collected_bytes() / done);
  };
  if (!zip.read(name, feed)) {
    throw Error(ErrorKind::Input,
                fmt::format("not a 3MF package: it has no model {}", in_quotes(name)));
  }
  elements.finish();
  if (has_further_models) {
    run.warn(fmt::format("{}: models in further files of the package are skipped", path.string()));
  }
  return model.build(path, budget);
}

}  // namespace

Mesh read_3mf(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  Mesh mesh;
  try {
    mesh = read_package(path, options, run);
  } catch (const Error& error) {
    const std::string why = error.what();
    if (error.kind() != ErrorKind::Input || why.starts_with(path.string())) throw;
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
  }
  check_mesh(mesh, path);
  if (mesh.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its build items have no triangles", path.string()));
  }
  return mesh;
}

}  // namespace frangia
