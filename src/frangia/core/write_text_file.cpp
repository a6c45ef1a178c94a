#include "frangia/core/write_text_file.h"

#include "frangia/core/atomic_file.h"

namespace frangia {

void write_text_file(const std::filesystem::path& path,
                     std::string_view text,
                     Durability durability) {
  AtomicFile file(path, durability);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace frangia
