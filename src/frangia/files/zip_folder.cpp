#include "frangia/files/zip_folder.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/files/internal/zip_file.h"

namespace frangia {
namespace {

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_symlink() || !entry.is_regular_file() || name.starts_with('.') ||
        is_temporary_file_name(name))
      continue;
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

void zip_folder(const std::filesystem::path& folder,
                const std::string& name,
                const std::filesystem::path& archive,
                const Run& run) {
  const auto files = files_below(folder);
  require(!files.empty(), "the folder holds no files to be put into an archive");
  ZipWriter writer(archive);
  std::vector<char> block(std::size_t{1} << 16U);
  for (std::size_t i = 0; i < files.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(files.size()));
    writer.begin(
        (std::filesystem::path(name) / files[i].lexically_relative(folder)).generic_string(),
        std::filesystem::file_size(files[i]));
    std::ifstream in(files[i], std::ios::binary);
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
      writer.text({block.data(), static_cast<std::size_t>(in.gcount())});
    if (!in.eof())
      throw Error(ErrorKind::File, fmt::format("{}: cannot be read", files[i].string()));
  }
  writer.commit();
}

}  // namespace frangia
