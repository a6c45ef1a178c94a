#include "print_page.h"

#include <fmt/format.h>

#include "frangia/core/error.h"

#include "run_program.h"

namespace frangia {

void print_page(const std::filesystem::path& page,
                const std::filesystem::path& pdf,
                const std::stop_token& stop) {
  // Absolute, so that a name that begins with a dash is no option.
  const auto code = run_program({"weasyprint",
                                 std::filesystem::absolute(page).string(),
                                 std::filesystem::absolute(pdf).string()},
                                stop,
                                WhenStopped::End);
  if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "stopped");
  if (!code) {
    throw Error(ErrorKind::Input,
                "PDF files are made by WeasyPrint, which is missing: install the package "
                "weasyprint, or write the report as HTML and print it");
  }
  if (*code != 0) {
    throw Error(ErrorKind::File,
                fmt::format("WeasyPrint ended with code {} and wrote no PDF file; write the report "
                            "as HTML and print it",
                            *code));
  }
}

}  // namespace frangia
