#pragma once

#include <filesystem>
#include <stop_token>

namespace frangia {

/// Makes a PDF file of an HTML page by WeasyPrint.
///
/// @errors   Error(Input) that says what to install where it is missing; Error(File) when it fails;
///           Error(Cancelled)
void print_page(const std::filesystem::path& page,
                const std::filesystem::path& pdf,
                const std::stop_token& stop);

}  // namespace frangia
