#include "frangia/files/internal/zip_file.h"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unzip.h>
#include <zip.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/files/internal/check_mesh.h"

namespace frangia {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U;
constexpr std::uint64_t kMaxBytes = std::uint64_t{8} << 30U;
constexpr std::uint64_t kHarmlessBytes = std::uint64_t{64} << 20U;
constexpr std::uint64_t kMaxRatio = 200;  // text of coordinates compresses 3 to 10 times
constexpr std::size_t kMostNameBytes = 4000;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

}  // namespace

struct ZipReader::Archive {
  unzFile file = nullptr;
};

ZipReader::ZipReader(std::filesystem::path path)
    : path_(std::move(path)), archive_(std::make_unique<Archive>()) {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) fail(path_, "there is no such file; check its name");
  if (!std::filesystem::is_regular_file(path_, error))
    fail(path_, "this is not a regular file; name a file");
  archive_->file = unzOpen64(path_.c_str());
  if (archive_->file == nullptr) {
    const std::string other = other_kind_of_file(path_);
    const bool is_other = !other.empty() && !other.starts_with("it is a zip");
    fail(path_, is_other ? other : "it is not a zip archive, or it is truncated");
  }
}

ZipReader::~ZipReader() {
  unzClose(archive_->file);
}

bool ZipReader::read(const std::string& name,
                     const std::function<void(std::string_view, double)>& consume) const {
  constexpr int kExact = 1;
  constexpr int kAnyCase = 2;  // names of a package's parts differ by more than case
  if (unzLocateFile(archive_->file, name.c_str(), kExact) != UNZ_OK &&
      unzLocateFile(archive_->file, name.c_str(), kAnyCase) != UNZ_OK)
    return false;
  read_here(name, consume);
  return true;
}

void ZipReader::read(const ZipEntry& entry,
                     const std::function<void(std::string_view, double)>& consume) const {
  const unz64_file_pos place{entry.offset, entry.ordinal};
  if (unzGoToFilePos64(archive_->file, &place) != UNZ_OK)
    fail(path_, "the directory of the archive is damaged; copy the file again");
  read_here(entry.name, consume);
}

void ZipReader::read_here(const std::string& name,
                          const std::function<void(std::string_view, double)>& consume) const {
  unz_file_info64 info{};
  std::array<char, 4096> ignored{};
  if (unzGetCurrentFileInfo64(
          archive_->file, &info, ignored.data(), ignored.size(), nullptr, 0, nullptr, 0) !=
      UNZ_OK) {
    fail(path_, "the directory of the archive is damaged; copy the file again");
  }
  const bool bomb = info.uncompressed_size > kMaxBytes ||
                    (info.uncompressed_size > kHarmlessBytes &&
                     info.uncompressed_size / kMaxRatio > info.compressed_size);
  if (bomb) {
    fail(path_,
         fmt::format("entry {} would expand from {} to {} bytes, which no mesh and no scan does; "
                     "it is refused",
                     name,
                     info.compressed_size,
                     info.uncompressed_size));
  }
  if (unzOpenCurrentFile(archive_->file) != UNZ_OK) {
    fail(path_,
         fmt::format("entry {} is damaged or uses an unsupported compression; save it with deflate",
                     name));
  }
  std::vector<char> block(kBlock);
  std::uint64_t unpacked = 0;
  for (;;) {
    const int got =
        unzReadCurrentFile(archive_->file, block.data(), static_cast<unsigned>(block.size()));
    if (got < 0) fail(path_, fmt::format("entry {} is damaged; copy the file again", name));
    if (got == 0) break;
    unpacked += static_cast<std::uint64_t>(got);
    if (unpacked > info.uncompressed_size) {
      fail(path_, fmt::format("entry {} is longer than its stated size; it is refused", name));
    }
    consume({block.data(), static_cast<std::size_t>(got)},
            static_cast<double>(unpacked) / static_cast<double>(info.uncompressed_size));
  }
  if (unzCloseCurrentFile(archive_->file) != UNZ_OK || unpacked != info.uncompressed_size) {
    fail(path_, fmt::format("entry {} is damaged; copy the file again", name));
  }
}

std::vector<ZipEntry> ZipReader::entries(std::size_t most) const {
  std::vector<ZipEntry> entries;
  std::array<char, kMostNameBytes + 1> name{};
  for (int code = unzGoToFirstFile(archive_->file); code != UNZ_END_OF_LIST_OF_FILE;
       code = unzGoToNextFile(archive_->file)) {
    unz_file_info64 info{};
    unz64_file_pos place{};
    const bool known =
        code == UNZ_OK &&
        unzGetCurrentFileInfo64(
            archive_->file, &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) ==
            UNZ_OK &&
        unzGetFilePos64(archive_->file, &place) == UNZ_OK;
    if (!known) fail(path_, "the directory of the archive is damaged; copy the file again");
    if (info.size_filename > kMostNameBytes) {
      fail(path_,
           fmt::format("the name of entry {}... is too long; shorten it",
                       std::string_view(name.data(), 60)));
    }
    if (entries.size() == most)
      fail(path_, fmt::format("it holds more than {} entries; pack one scan alone", most));
    entries.push_back({std::string(name.data(), info.size_filename),
                       info.uncompressed_size,
                       place.pos_in_zip_directory,
                       place.num_of_file});
  }
  return entries;
}

struct ZipWriter::Archive {
  explicit Archive(const std::filesystem::path& path) : atomic(path) {}
  AtomicFile atomic;
  zipFile file = nullptr;
  bool open = false;
  std::string buffer;

  void check(int code) const {
    if (code == ZIP_OK) return;
    throw Error(
        ErrorKind::File,
        fmt::format("{}: cannot be written; the disk may be full", atomic.temporary().string()));
  }
  void flush() {
    check(zipWriteInFileInZip(file, buffer.data(), static_cast<unsigned>(buffer.size())));
    buffer.clear();
  }
  void end() {
    if (!open) return;
    flush();
    check(zipCloseFileInZip(file));
    open = false;
  }
};

ZipWriter::ZipWriter(const std::filesystem::path& path)
    : archive_(std::make_unique<Archive>(path)) {
  archive_->file = zipOpen64(archive_->atomic.temporary().c_str(), APPEND_STATUS_CREATE);
  if (archive_->file == nullptr) archive_->check(ZIP_ERRNO);
}

ZipWriter::~ZipWriter() {
  if (archive_->file != nullptr) zipClose(archive_->file, nullptr);
}

void ZipWriter::begin(const std::string& name, std::uint64_t max_bytes) {
  constexpr int kFast = 1;  // a third larger than level 9 and five times as fast
  archive_->end();
  zip_fileinfo info{};
  info.tmz_date = {
      0, 0, 0, 1, 0, 1980};  // a fixed date, so that the same mesh gives the same bytes
  archive_->check(zipOpenNewFileInZip64(archive_->file,
                                        name.c_str(),
                                        &info,
                                        nullptr,
                                        0,
                                        nullptr,
                                        0,
                                        nullptr,
                                        Z_DEFLATED,
                                        kFast,
                                        max_bytes > 0xFFFF0000U ? 1 : 0));
  archive_->open = true;
}

void ZipWriter::text(std::string_view piece) {
  archive_->buffer.append(piece);
  if (archive_->buffer.size() >= kBlock) archive_->flush();
}

void ZipWriter::commit() {
  archive_->end();
  zipFile file = std::exchange(archive_->file, nullptr);
  archive_->check(zipClose(file, nullptr));
  archive_->atomic.commit();
}

}  // namespace frangia
