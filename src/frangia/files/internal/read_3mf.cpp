#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/xml_parser.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/three_mf.h"
#include "frangia/files/internal/three_mf_model.h"
#include "frangia/files/internal/without_percent.h"
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

/// Reads the model in a file of the package into `model`.
void read_part(const ZipReader& zip,
               const std::string& name,
               const MemoryBudget& budget,
               ThreeMfModel& model) {
  model.begin_part(name);
  XmlParser elements([&](std::string_view element,
                         const XmlAttributes& attributes) { model.begin(element, attributes); },
                     [](std::string_view) {});
  elements.on_namespace(
      [&](std::string_view prefix, std::string_view uri) { model.declare_namespace(prefix, uri); });
  const double before = model.collected_bytes();
  const auto feed = [&](std::string_view piece, double done) {
    elements.feed(piece);
    const double collected = model.collected_bytes();
    budget.check(collected, before + (collected - before) / done);
  };
  if (!zip.read(name, feed) && !zip.read(without_percent(name), feed)) {
    throw Error(ErrorKind::Input,
                fmt::format("not a 3MF package: it has no model {}", in_quotes(name)));
  }
  elements.finish();
}

Mesh read_package(const std::filesystem::path& path, const ReadOptions& options, const Run& run) {
  const ZipReader zip(path);
  const MemoryBudget budget(path, std::filesystem::file_size(path), options.allow_memory_bytes);
  const std::string root = model_name(zip);
  ThreeMfModel model;
  std::set<std::string> known{root};
  std::vector<std::string> open{root};
  while (!open.empty()) {
    run.check();
    const std::string part = std::move(open.back());
    open.pop_back();
    read_part(zip, part, budget, model);
    constexpr std::size_t kMostParts = 10'000;
    if (model.parts().size() > kMostParts) {
      throw Error(
          ErrorKind::Input,
          fmt::format("its objects are in more than {} files; export it again", kMostParts));
    }
    for (const std::string& name : model.parts())
      if (known.insert(name).second) open.push_back(name);
  }
  ThreeMfModel::Built built = model.build(path, budget);
  if (built.left_out > 0) {
    run.warn(
        fmt::format("{}: left out {} object{} that {} no part: supports, or modifiers of a slicer",
                    path.string(),
                    built.left_out,
                    built.left_out == 1 ? "" : "s",
                    built.left_out == 1 ? "is" : "are"));
  }
  if (built.shapes > 0) {
    run.warn(fmt::format(
        "{}: left out {} beam{} or shape{} of extensions, which are no triangles; export it as "
        "triangles",
        path.string(),
        built.shapes,
        built.shapes == 1 ? "" : "s",
        built.shapes == 1 ? "" : "s"));
  }
  return std::move(built.mesh);
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
