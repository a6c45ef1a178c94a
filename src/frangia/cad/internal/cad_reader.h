#pragma once

#include "frangia/cad/internal/faces.h"
#include "frangia/cad/internal/separate_process.h"

namespace frangia {

/// What reads CAD files, in a shared object of its own that is loaded when the first one is read.
/// The loader takes 70 ms to bind OpenCASCADE's libraries, three quarters of the start of a program
/// that links them.
struct CadReader {
  decltype(&translate_in_process) translate;
  decltype(&load_faces) load;
};

/// The shared object, beside the folder of the program that loads it.
inline constexpr const char* kCadReaderFile = "../lib/frangia/frangia_cad.so";
/// The one function that it exports.
inline constexpr const char* kCadReaderSymbol = "frangia_cad_reader";

}  // namespace frangia
