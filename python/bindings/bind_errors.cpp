#include <exception>

#include "frangia/core/error.h"

#include "bindings.h"

namespace frangia::python {
namespace {

namespace py = pybind11;

/// Adds an exception type with several bases to the module and returns it.
PyObject* add_error(py::module_& module,
                    const char* name,
                    const py::tuple& bases,
                    const char* doc) {
  const std::string full = std::string("frangia.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(type);
  return type;
}

struct ErrorTypes {
  PyObject* input = nullptr;
  PyObject* file = nullptr;
  PyObject* device = nullptr;
  PyObject* numeric = nullptr;
};

ErrorTypes& types() {
  static ErrorTypes all;  // a translator of pybind11 has no other place
  return all;
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    switch (error.kind()) {
      case ErrorKind::Input:
        PyErr_SetString(types().input, error.what());
        return;
      case ErrorKind::File:
        PyErr_SetString(types().file, error.what());
        return;
      case ErrorKind::Device:
        PyErr_SetString(types().device, error.what());
        return;
      case ErrorKind::Numeric:
        PyErr_SetString(types().numeric, error.what());
        return;
      case ErrorKind::Cancelled:
        PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
        return;
    }
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  const auto base = py::reinterpret_steal<py::object>(add_error(
      module,
      "Error",
      py::make_tuple(py::handle(PyExc_Exception)),
      "Base of the errors of this package. The text names the file, key or value and what to do."));
  const auto derived = [&](const char* name, PyObject* also, const char* doc) {
    return add_error(module, name, py::make_tuple(base, py::handle(also)), doc);
  };
  types().input = derived("InputError", PyExc_ValueError, "A file, value or option is wrong.");
  types().file = derived("FileError", PyExc_OSError, "A file cannot be read or written.");
  types().device = derived("DeviceError", PyExc_RuntimeError, "A device fails or does not answer.");
  types().numeric =
      derived("NumericError", PyExc_ArithmeticError, "A computation has no trustworthy result.");
  py::register_exception_translator(&translate);
}

}  // namespace frangia::python
