#include "print_text.h"

#include <cerrno>
#include <system_error>

#include <nlohmann/json.hpp>

#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void fail(int error) {
  throw Error(ErrorKind::File,
              fmt::format("standard output cannot be written ({}); the result is not complete",
                          std::generic_category().message(error)));
}

}  // namespace

void write_output(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail(errno);
}

void flush_output() {
  const bool failed_before = std::ferror(stdout) != 0;
  if (std::fflush(stdout) != 0) fail(errno);
  if (failed_before) fail(EIO);
}

void print_json(const nlohmann::ordered_json& json) {
  constexpr int kIndent = 2;
  write_output(json.dump(kIndent, ' ', true, nlohmann::ordered_json::error_handler_t::replace) +
               "\n");
}

}  // namespace frangia
