// From results, JSON and points to Python.
#pragma once

#include "core/base/result.h"

#include <exception>
#include <nlohmann/json.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

namespace marsview::python {

namespace py = pybind11;

/// A Result's error on its way to Python, where it is marsview.Error.
class Failure : public std::exception {
public:
    explicit Failure(Error error)
        : error_(std::move(error))
    {}
    const char* what() const noexcept override { return error_.message.c_str(); }
    const Error& error() const noexcept { return error_; }

private:
    Error error_;
};

/// Throws Failure if `result` is an error.
template <typename T>
T valueOf(Result<T> result)
{
    if (!result) {
        throw Failure(std::move(result).error());
    }
    return std::move(result).value();
}

/// Defines marsview.Error, with the attribute `code` ("not-found", "invalid", …).
void addError(py::module_& module);

/// Dicts, lists, numbers; null is None. Floating-point fields that are not finite are None, as in
/// the JSON of the command line.
py::object asPython(const nlohmann::ordered_json& json);

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Refuses arrays that are not N × `columns`.
void checkRows(const Doubles& array, py::ssize_t columns, const char* name);

} // namespace marsview::python
