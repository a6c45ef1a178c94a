#include "batch/file_record.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include "frangia/core/checksums.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Null for a file that is missing or no regular file.
Json stamp_of(const fs::path& path) {
  struct ::stat state {};
  if (::stat(path.c_str(), &state) != 0 || !S_ISREG(state.st_mode)) return nullptr;
  return {state.st_size, state.st_mtim.tv_sec, state.st_mtim.tv_nsec, state.st_ino};
}

std::string checksum_of(const fs::path& path) {
  const std::string ending = lowercase_extension(path);
  if (ending != ".png" && ending != ".tif" && ending != ".tiff")
    return "sha256:" + sha256_of_file(path);
  const std::vector<char> bytes = read_regular_file(path);
  return fmt::format("crc32:{:08x}", crc32(bytes));
}

/// Whether a file is the recorded one. A record of another form is of none.
bool is_unchanged(const Json& record, const fs::path& path, bool verify) {
  const Json stamp = stamp_of(path);
  if (stamp.is_null()) return record.is_null();
  if (!record.is_object()) return false;
  const auto known = record.find("stamp");
  const auto checksum = record.find("checksum");
  if (known == record.end() || checksum == record.end()) return false;
  if (!verify && *known == stamp) return true;
  if (!known->is_array() || known->empty() || known->front() != stamp.front()) return false;
  try {
    return *checksum == checksum_of(path);
  } catch (const Error&) {  // it cannot be read
    return false;
  }
}

}  // namespace

Json stamps_of(const NamedFiles& files) {
  Json stamps = Json::object();
  for (const auto& [name, path] : files)
    stamps[name] = stamp_of(path);
  return stamps;
}

Json record_of(const NamedFiles& files) {
  Json record = Json::object();
  for (const auto& [name, path] : files) {
    // The stamp is older than the checksum: a change between them is found by the checksum.
    Json stamp = stamp_of(path);
    record[name] = stamp.is_null()
                       ? Json()
                       : Json{{"stamp", std::move(stamp)}, {"checksum", checksum_of(path)}};
  }
  return record;
}

std::string first_changed(const Json& record, const NamedFiles& files, bool verify) {
  if (!record.is_object()) return files.empty() ? "the record" : files.begin()->first;
  for (const auto& [name, path] : files) {
    const auto known = record.find(name);
    if (known == record.end() || !is_unchanged(*known, path, verify)) return name;
  }
  for (const auto& [name, value] : record.items())
    if (files.count(name) == 0) return name;
  return {};
}

}  // namespace frangia
