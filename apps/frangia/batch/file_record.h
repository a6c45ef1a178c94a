#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace frangia {

/// Files by the names under which a record keeps them.
using NamedFiles = std::map<std::string, std::filesystem::path>;

/// Size, time of the last change and inode of each file, null for one that is missing.
[[nodiscard]] nlohmann::ordered_json stamps_of(const NamedFiles& files);

/// The stamps of files with their checksums: SHA-256, and for images the CRC-32 that the manifest
/// of a capture holds. Null for a file that is missing.
///
/// @errors   Error(Input) that names a file that cannot be read
[[nodiscard]] nlohmann::ordered_json record_of(const NamedFiles& files);

/// The name of the first file that a record does not have, or that has changed since, or that is
/// missing now and was not; empty when all are as they were. A file whose stamp is the same has not
/// changed; one with another stamp is compared by its checksum. With `verify`, all are.
[[nodiscard]] std::string first_changed(const nlohmann::ordered_json& record,
                                        const NamedFiles& files,
                                        bool verify);

}  // namespace frangia
