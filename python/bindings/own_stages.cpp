#include "own_stages.h"

#include <memory>
#include <vector>

#include "frangia/core/error.h"

#include "arrays.h"
#include "phase_arrays.h"

namespace frangia::python {
namespace {

/// A Python function that several threads may hold; it is freed with the GIL.
using Function = std::shared_ptr<const py::object>;

Function function_of(const py::object& object, const char* name) {
  if (!PyCallable_Check(object.ptr()))
    throw Error(ErrorKind::Input, fmt::format("{} is no function", name));
  return std::static_pointer_cast<const py::object>(keep(object));
}

/// Item `i` of a tuple, or None beyond its end.
py::object item(const py::tuple& values, std::size_t i) {
  return i < values.size() ? py::object(values[i]) : py::none();
}

/// What a function returned as a tuple: a single array becomes its first item.
py::tuple tuple_of(const py::object& result) {
  return py::isinstance<py::tuple>(result) ? result.cast<py::tuple>() : py::make_tuple(result);
}

}  // namespace

OwnStages own_stages(const py::object& wrap,
                     const py::object& unwrap_spatially,
                     const py::object& unwrap) {
  OwnStages own;
  if (!wrap.is_none()) {
    own.wrap = [function = function_of(wrap, "wrap")](const FrameStack& stack,
                                                      const FittedAlgorithm& fitted,
                                                      const NoiseModel& noise) {
      const py::gil_scoped_acquire gil;
      const py::object result = (*function)(stack, fitted.algorithm, noise);
      if (py::isinstance<WrappedPhase>(result)) return result.cast<WrappedPhase>();
      const py::tuple arrays = tuple_of(result);
      return wrapped_of(
          item(arrays, 0), item(arrays, 1), item(arrays, 2), item(arrays, 3), stack.pattern);
    };
  }
  if (!unwrap_spatially.is_none()) {
    own.unwrap_spatially =
        [function = function_of(unwrap_spatially, "unwrap_spatially")](const WrappedPhase& map) {
          const py::gil_scoped_acquire gil;
          const py::object result = (*function)(map);
          if (py::isinstance<RelativePhase>(result)) return result.cast<RelativePhase>();
          const py::tuple arrays = tuple_of(result);
          return relative_of(item(arrays, 0), item(arrays, 1), map);
        };
  }
  if (!unwrap.is_none()) {
    own.unwrap = [function = function_of(unwrap, "unwrap")](std::span<const WrappedPhase> maps) {
      const py::gil_scoped_acquire gil;
      py::list list;
      for (const WrappedPhase& map : maps)
        list.append(py::cast(map));
      const py::object result = (*function)(list);
      if (py::isinstance<AbsolutePhase>(result)) return result.cast<AbsolutePhase>();
      const py::tuple arrays = tuple_of(result);
      return absolute_of(item(arrays, 0), item(arrays, 1), &maps.back(), maps.back().pattern);
    };
  }
  return own;
}

}  // namespace frangia::python
