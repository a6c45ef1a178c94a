// Images and vectors of the library as NumPy arrays, without copies where layouts allow.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "frangia/core/error.h"
#include "frangia/core/image.h"

namespace frangia::python {

namespace py = pybind11;

/// Keeps a Python object alive from any thread.
inline std::shared_ptr<const void> keep(const py::object& object) {
  auto* held = new py::object(object);  // NOLINT(*-owning-memory) the deleter takes the GIL
  return {held, [](const void* pointer) {
            const py::gil_scoped_acquire gil;
            delete static_cast<const py::object*>(pointer);  // NOLINT(*-owning-memory)
          }};
}

/// A view of an image, which belongs to `owner`. Enumerations appear as their numbers.
template <typename Number, typename Pixel>
py::array_t<Number> view_of(const Image<Pixel>& image, const py::handle& owner) {
  if (image.empty()) return py::array_t<Number>(std::vector<py::ssize_t>{0, 0});
  constexpr py::ssize_t kChannels = sizeof(Pixel) / sizeof(Number);
  std::vector<py::ssize_t> shape{image.height(), image.width()};
  if (kChannels > 1) shape.push_back(kChannels);
  return py::array_t<Number>(shape,
                             reinterpret_cast<const Number*>(image.pixels().data()),
                             owner);  // NOLINT(*-reinterpret-cast)
}

/// A view of a vector of numbers or of small fixed vectors, which belongs to `owner`.
template <typename Number, typename Element>
py::array_t<Number> view_of(const std::vector<Element>& values, const py::handle& owner) {
  constexpr py::ssize_t kColumns = sizeof(Element) / sizeof(Number);
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
  if (kColumns > 1) shape.push_back(kColumns);
  if (values.empty()) return py::array_t<Number>(shape);
  return py::array_t<Number>(
      shape, reinterpret_cast<const Number*>(values.data()), owner);  // NOLINT(*-reinterpret-cast)
}

/// An array that takes over an image.
template <typename Number, typename Pixel>
py::array_t<Number> array_of(Image<Pixel>&& image) {
  auto* held = new Image<Pixel>(std::move(image));  // NOLINT(*-owning-memory) the capsule owns it
  const py::capsule owner(held, [](void* pointer) { delete static_cast<Image<Pixel>*>(pointer); });
  return view_of<Number>(*held, owner);
}

/// An image that refers to the array where this is contiguous, else to a copy of it.
template <typename Number, typename Pixel = Number>
Image<Pixel> image_of(const py::handle& values, const char* what) {
  const auto array = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(values);
  if (!array) {
    PyErr_Clear();
    throw Error(ErrorKind::Input, fmt::format("{} is no array of numbers", what));
  }
  constexpr int kChannels = sizeof(Pixel) / sizeof(Number);
  if (array.ndim() != (kChannels > 1 ? 3 : 2) || (kChannels > 1 && array.shape(2) != kChannels)) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has {} dimensions; give an array of height x width{}",
                            what,
                            array.ndim(),
                            kChannels > 1 ? fmt::format(" x {}", kChannels) : ""));
  }
  auto* pixels = const_cast<Number*>(array.data());  // NOLINT(*-const-cast) the library reads it
  return Image<Pixel>(static_cast<int>(array.shape(1)),
                      static_cast<int>(array.shape(0)),
                      reinterpret_cast<Pixel*>(pixels),  // NOLINT(*-reinterpret-cast)
                      keep(array));
}

/// The rows of an array as fixed vectors.
template <typename Number, typename Element>
std::vector<Element> vector_of(const py::handle& values, const char* what) {
  constexpr py::ssize_t kColumns = sizeof(Element) / sizeof(Number);
  const auto array = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(values);
  if (!array) {
    PyErr_Clear();
    throw Error(ErrorKind::Input, fmt::format("{} is no array of numbers", what));
  }
  const bool fits =
      kColumns == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == kColumns;
  if (!fits) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has another shape than N{}",
                            what,
                            kColumns > 1 ? fmt::format(" x {}", kColumns) : ""));
  }
  const auto* first = reinterpret_cast<const Element*>(array.data());  // NOLINT(*-reinterpret-cast)
  return {first, first + array.shape(0)};
}

}  // namespace frangia::python
