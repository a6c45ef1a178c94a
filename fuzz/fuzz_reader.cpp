// Fuzzes the reader that FRANGIA_FUZZ_READER names, one of fuzz_readers(). A reader must throw an
// Error or return a consistent value; anything else is a crash.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const frangia::FuzzReader* const reader = [] {
    const char* const named = std::getenv("FRANGIA_FUZZ_READER");
    return frangia::find_fuzz_reader(named == nullptr ? "ply" : named);
  }();
  static const frangia::FuzzFolder folder;
  if (reader == nullptr) {
    static_cast<void>(std::fputs("FRANGIA_FUZZ_READER names no reader\n", stderr));
    std::abort();
  }
  folder.run(*reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
