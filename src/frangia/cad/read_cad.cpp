#include "frangia/cad/read_cad.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "frangia/cad/internal/faces.h"
#include "frangia/cad/internal/separate_process.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

/// The first and the last part of a file.
struct FileEnds {
  std::uint64_t bytes = 0;
  std::string begin;
  std::string end;
};

FileEnds ends_of(const std::filesystem::path& path) {
  constexpr std::uint64_t kPart = 4096;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed))
    refuse(path, std::filesystem::exists(path, failed) ? "it is no file" : "there is no such file");
  FileEnds ends;
  ends.bytes = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  const auto part = [&](std::uint64_t from) {
    std::string text(std::min(kPart, ends.bytes - from), '\0');
    file.seekg(static_cast<std::streamoff>(from));
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file) throw Error(ErrorKind::File, fmt::format("{}: it cannot be read", path.string()));
    return text;
  };
  ends.begin = part(0);
  ends.end = part(ends.bytes - std::min(kPart, ends.bytes));
  return ends;
}

void check_step(const std::filesystem::path& path, const FileEnds& ends) {
  if (ends.begin.find("ISO-10303-21") == std::string::npos)
    refuse(path, "it is no STEP file: it does not begin with ISO-10303-21; export it again");
  if (ends.end.find("END-ISO-10303-21") == std::string::npos)
    refuse(path, "it is cut short: it does not end with END-ISO-10303-21; copy or export it again");
}

/// Column 73 of each line of an IGES file names its section, S to T.
void check_iges(const std::filesystem::path& path, const FileEnds& ends) {
  constexpr std::size_t kColumn = 72;
  if (ends.begin.size() <= kColumn || (ends.begin[kColumn] != 'S' && ends.begin[kColumn] != 's'))
    refuse(path, "it is no IGES file: its first line has no S in column 73; export it again");
  std::string text = ends.end;
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.pop_back();
  const std::size_t line_end = text.find_last_of("\r\n");
  const std::string last = line_end == std::string::npos ? text : text.substr(line_end + 1);
  if (last.size() <= kColumn || (last[kColumn] != 'T' && last[kColumn] != 't'))
    refuse(path, "it is cut short: its last line has no T in column 73; copy or export it again");
}

/// The application protocol that a STEP file names in its head.
std::string schema_of(const FileEnds& ends) {
  const std::size_t at = ends.begin.find("FILE_SCHEMA");
  if (at == std::string::npos) return "";
  const std::string text = ends.begin.substr(at, ends.begin.find(';', at) - at);
  const auto names = [&](std::string_view part) { return text.find(part) != std::string::npos; };
  if (names("AP242")) return "AP242";
  if (names("AUTOMOTIVE_DESIGN") || names("AP214")) return "AP214";
  return names("CONFIG_CONTROL_DESIGN") || names("AP203") ? "AP203" : "";
}

/// Refuses information about faces that the model does not have.
void check_face_numbers(const CadPmi& pmi, std::size_t faces) {
  for (const CadRequirement& requirement : pmi.requirements) {
    for (const auto& numbers : {requirement.faces, requirement.other_faces})
      for (const std::size_t number : numbers)
        require(number <= faces, "it refers to a face that it does not have; export it again");
  }
}

}  // namespace

bool is_cad_file(const std::filesystem::path& path) {
  const std::string extension = lowercase_extension(path);
  return extension == ".step" || extension == ".stp" || extension == ".igs" || extension == ".iges";
}

std::unique_ptr<CadModel> read_cad(const std::filesystem::path& path,
                                   const CadOptions& options,
                                   const Run& run) {
  if (!is_cad_file(path)) refuse(path, "a CAD file ends in .step, .stp, .igs or .iges");
  const FileEnds ends = ends_of(path);
  if (ends.bytes == 0) refuse(path, "it is empty; copy or export it again");
  const bool step = lowercase_extension(path).starts_with(".st");
  step ? check_step(path, ends) : check_iges(path, ends);
#ifdef FRANGIA_WITH_CAD
  constexpr double kSecondsPerByte = 20e-6;
  const ProcessLimits limits{
      MemoryBudget(path, ends.bytes, options.allow_memory),
      std::max(options.allow_time_s, kSecondsPerByte * static_cast<double>(ends.bytes))};
  TranslatedCad translated = translate_in_process(path, {options.units, options.pmi}, limits, run);
  for (const std::string& warning : translated.said.warnings)
    run.warn(fmt::format("{}: {}", path.string(), warning));
  if (!translated.said.error.empty()) refuse(path, translated.said.error);
  try {
    auto faces = load_faces(translated.shape, run);
    if (faces->mesh.triangles.empty())
      refuse(path, "none of its faces has an area; export it again");
    translated.said.pmi.schema = step ? schema_of(ends) : "";
    check_face_numbers(translated.said.pmi, faces->list.size());
    return std::make_unique<CadModel>(
        std::move(faces), translated.said.unit, std::move(translated.said.pmi));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input || std::string(error.what()).starts_with(path.string()))
      throw;
    refuse(path, error.what());
  }
#else
  static_cast<void>(options);
  static_cast<void>(run);
  refuse(path,
         "this program was built without OpenCASCADE, which reads CAD files; give a mesh, or build "
         "it with libocct-data-exchange-dev");
#endif
}

}  // namespace frangia
