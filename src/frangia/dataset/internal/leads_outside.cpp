#include "frangia/dataset/internal/leads_outside.h"

#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::path real = std::filesystem::weakly_canonical(path, failed);
  if (failed) {
    throw Error(
        ErrorKind::Input,
        fmt::format(
            "{}: {}; name a folder or file that can exist", path.string(), failed.message()));
  }
  return real;
}

}  // namespace

bool leads_outside(const std::filesystem::path& outer, const std::filesystem::path& inner) {
  const auto begins_with_parent = [](const std::filesystem::path& path) {
    return path.empty() || *path.begin() == "..";
  };
  if (inner.native().find('\0') != std::string::npos) return true;
  if (inner.is_absolute() || begins_with_parent(inner.lexically_normal())) return true;
  return begins_with_parent(resolved(outer / inner).lexically_relative(resolved(outer)));
}

}  // namespace frangia
