#include "frangia/dataset/internal/leads_outside.h"

namespace frangia {

bool leads_outside(const std::filesystem::path& outer, const std::filesystem::path& inner) {
  const auto begins_with_parent = [](const std::filesystem::path& path) {
    return path.empty() || *path.begin() == "..";
  };
  if (inner.native().find('\0') != std::string::npos) return true;
  if (inner.is_absolute() || begins_with_parent(inner.lexically_normal())) return true;
  const std::filesystem::path real = std::filesystem::weakly_canonical(outer / inner);
  return begins_with_parent(real.lexically_relative(std::filesystem::weakly_canonical(outer)));
}

}  // namespace frangia
