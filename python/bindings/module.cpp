#include "bindings.h"

PYBIND11_MODULE(_frangia, module) {
  namespace bound = frangia::python;
  module.doc() = "Fringe-projection scanning: phase, range, registration, fusion and meshes.";
  module.attr("__version__") = FRANGIA_VERSION;
  bound::bind_errors(module);
  bound::bind_patterns(module);
  bound::bind_rig(module);
  bound::bind_phase(module);
  bound::bind_mesh(module);
  bound::bind_scan(module);
  bound::bind_inspection(module);
  bound::bind_sections(module);
  bound::bind_reconstruct(module);
}
