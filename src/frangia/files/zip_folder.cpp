#include "frangia/files/zip_folder.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
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

[[noreturn]] void refuse_archive(const std::filesystem::path& archive, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", archive.string(), why));
}

/// Whether a name, put behind a folder, leads to a place in it.
bool stays_inside(const std::string& name) {
  const std::filesystem::path path(name);
  return path.is_relative() && name.find('\\') == std::string::npos &&
         name.find('\0') == std::string::npos && name.find("//") == std::string::npos &&
         std::none_of(path.begin(), path.end(), [](const std::filesystem::path& part) {
           return part == ".." || part == ".";
         });
}

bool is_hidden(const std::string& name) {
  const std::filesystem::path path(name);
  return std::any_of(path.begin(), path.end(), [](const std::filesystem::path& part) {
    return part.string().starts_with('.') || part == "__MACOSX";
  });
}

/// The folder of the only entry with a file name that lies in no folder of another one, with its
/// slash; empty for the top.
std::string folder_with(const std::filesystem::path& archive,
                        const std::vector<ZipEntry>& entries,
                        const std::string& marker) {
  std::vector<std::string> folders;
  for (const ZipEntry& entry : entries) {
    const std::string& name = entry.name;
    if (is_hidden(name) || std::filesystem::path(name).filename() != marker) continue;
    folders.push_back(name.substr(0, name.size() - marker.size()));
  }
  if (folders.empty())
    refuse_archive(archive, fmt::format("holds no {}; choose another archive", marker));
  // A scan holds a second scan.toml in its folder `capture`.
  const std::vector<std::string> all = folders;
  std::erase_if(folders, [&](const std::string& folder) {
    return std::any_of(all.begin(), all.end(), [&](const std::string& outer) {
      return outer.size() < folder.size() && folder.starts_with(outer);
    });
  });
  if (folders.size() > 1) {
    refuse_archive(
        archive,
        fmt::format("holds {} files {}; pack each of them on its own", folders.size(), marker));
  }
  return folders.front();
}

/// Entries of which each is harmless may fill the disk together.
void require_plausible_size(const std::filesystem::path& archive,
                            const std::vector<ZipEntry>& entries) {
  constexpr std::uint64_t kHarmlessBytes = std::uint64_t{64} << 20U;
  constexpr std::uint64_t kMostRatio = 200;  // as of a single entry
  const std::uint64_t most =
      std::max(kHarmlessBytes, kMostRatio * std::filesystem::file_size(archive));
  std::uint64_t total = 0;
  for (const ZipEntry& entry : entries) {
    if (entry.bytes > most - total)
      refuse_archive(archive,
                     fmt::format("its entries would altogether expand to more than {} bytes, which "
                                 "no scan does; it is refused",
                                 most));
    total += entry.bytes;
  }
}

}  // namespace

void unzip_folder(const std::filesystem::path& archive,
                  const std::string& marker,
                  const std::filesystem::path& folder,
                  const Run& run) {
  constexpr std::size_t kMostEntries = 200'000;
  const ZipReader reader(archive);
  std::vector<ZipEntry> entries = reader.entries(kMostEntries);
  const std::string inside = folder_with(archive, entries, marker);
  for (const ZipEntry& entry : entries) {
    if (!stays_inside(entry.name))
      refuse_archive(archive,
                     fmt::format("entry {} leads out of the archive; it is refused", entry.name));
  }
  std::erase_if(entries, [&](const ZipEntry& entry) {
    return !entry.name.starts_with(inside) || entry.name.ends_with('/') || is_hidden(entry.name);
  });
  require_plausible_size(archive, entries);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(entries.size()));
    // `inside` is empty or ends with the only slash there: what follows it stays inside as well.
    const auto target = folder / entries[i].name.substr(inside.size());
    make_folder(target.parent_path());
    AtomicFile file(target);
    reader.read(entries[i], [&](std::string_view piece, double) { file.stream() << piece; });
    file.commit();
  }
}

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
