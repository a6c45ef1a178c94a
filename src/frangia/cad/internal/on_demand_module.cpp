// The shared object that holds all of OpenCASCADE that is used.
#include "frangia/cad/internal/cad_reader.h"

extern "C" __attribute__((visibility("default"))) const frangia::CadReader* frangia_cad_reader();

const frangia::CadReader* frangia_cad_reader() {
  static constexpr frangia::CadReader kReader{&frangia::translate_in_process, &frangia::load_faces};
  return &kReader;
}
