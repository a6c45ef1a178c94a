#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/editor/edit_script.h"
#include "frangia/files/read_mesh.h"

namespace frangia::testing {

/// A version of the surface as the files state it.
struct VersionOnDisk {
  std::string surface;  ///< bytes of surface.ply
  EditScript script;
};

/// What a project's files state, read here without the service's own reader.
struct ProjectOnDisk {
  int revision = 0;
  int current = 0;
  std::map<int, VersionOnDisk> versions;

  [[nodiscard]] const VersionOnDisk& shown() const { return versions.at(current); }
};

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline ProjectOnDisk read_project(const std::filesystem::path& folder) {
  ProjectOnDisk disk;
  if (!std::filesystem::exists(folder / "versions.json")) {
    if (!std::filesystem::exists(folder / "surface.ply")) return disk;
    disk.current = 1;
    disk.versions[1].surface = bytes_of(folder / "surface.ply");
    if (std::filesystem::exists(folder / "edits.json"))
      disk.versions[1].script = read_edit_script(folder / "edits.json");
    return disk;
  }
  const auto json = nlohmann::json::parse(bytes_of(folder / "versions.json"));
  disk.revision = json.at("revision");
  disk.current = json.at("current");
  for (const nlohmann::json& one : json.at("versions")) {
    const int number = one.at("number");
    const bool in_place = one.value("in_place", false);
    const auto files = in_place ? folder : folder / "versions" / fmt::format("{:03}", number);
    VersionOnDisk& version = disk.versions[number];
    version.surface = bytes_of(files / "surface.ply");
    const int edits = one.at("edits");
    const auto script =
        files / (edits == 0 ? std::string("edits.json") : fmt::format("edits-{}.json", edits));
    if (edits != 0 || (in_place && std::filesystem::exists(script)))
      version.script = read_edit_script(script);
  }
  return disk;
}

inline bool same(const VersionOnDisk& a, const VersionOnDisk& b) {
  return a.surface == b.surface && a.script.steps == b.script.steps &&
         a.script.done == b.script.done;
}

inline bool same(const ProjectOnDisk& a, const ProjectOnDisk& b) {
  if (a.revision != b.revision || a.current != b.current || a.versions.size() != b.versions.size())
    return false;
  for (const auto& [number, version] : a.versions)
    if (!b.versions.contains(number) || !same(version, b.versions.at(number))) return false;
  return true;
}

/// The mesh of the version that is shown, by the editor alone.
inline Mesh mesh_of(const std::filesystem::path& folder, const ProjectOnDisk& disk) {
  const auto copy = folder.parent_path() / "truth.ply";
  std::ofstream(copy, std::ios::binary) << disk.shown().surface;
  EditState state{.mesh = read_mesh(copy), .selection = {}};
  const EditScript& script = disk.shown().script;
  for (std::size_t i = 0; i < script.done; ++i)
    apply_step(state, script.steps[i]);
  return state.mesh;
}

}  // namespace frangia::testing
