#include "app/python/conversion.h"

#include <fmt/format.h>

namespace marsview::python {
namespace {

const char* codeName(ErrorCode code)
{
    switch (code) {
    case ErrorCode::NotFound:
        return "not-found";
    case ErrorCode::Unreadable:
        return "unreadable";
    case ErrorCode::Unsupported:
        return "unsupported";
    case ErrorCode::Invalid:
        return "invalid";
    case ErrorCode::OutOfRange:
        return "out-of-range";
    case ErrorCode::TooLarge:
        return "too-large";
    case ErrorCode::Canceled:
        return "canceled";
    case ErrorCode::Damaged:
        return "damaged";
    }
    return "";
}

PyObject* error_type = nullptr; // lives as long as the module, which is never unloaded

} // namespace

void addError(py::module_& module)
{
    error_type = PyErr_NewExceptionWithDoc(
        "marsview.Error",
        "A map, a file or an argument cannot be used. The message names it and says what to do; "
        "`code` is its kind.",
        PyExc_RuntimeError, nullptr);
    if (error_type == nullptr) {
        throw py::error_already_set();
    }
    module.attr("Error") = py::handle(error_type);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) {
                std::rethrow_exception(thrown);
            }
        } catch (const Failure& failure) {
            const py::object error = py::handle(error_type)(failure.error().message);
            error.attr("code") = codeName(failure.error().code);
            PyErr_SetObject(error_type, error.ptr());
        }
    });
}

py::object asPython(const nlohmann::ordered_json& json)
{
    if (json.is_object()) {
        py::dict fields;
        for (const auto& [name, value] : json.items()) {
            fields[py::str(name)] = asPython(value);
        }
        return fields;
    }
    if (json.is_array()) {
        py::list items;
        for (const auto& value : json) {
            items.append(asPython(value));
        }
        return items;
    }
    if (json.is_boolean()) {
        return py::bool_(json.get<bool>());
    }
    if (json.is_number_unsigned()) {
        return py::int_(json.get<std::uint64_t>());
    }
    if (json.is_number_integer()) {
        return py::int_(json.get<std::int64_t>());
    }
    if (json.is_number()) {
        return py::float_(json.get<double>());
    }
    if (json.is_string()) {
        const auto text = json.get<std::string>();
        // File names need not be UTF-8.
        return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
            text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
    }
    return py::none();
}

void checkRows(const Doubles& array, py::ssize_t columns, const char* name)
{
    if (array.ndim() != 2 || array.shape(1) != columns) {
        throw py::value_error(fmt::format("{} must be an array of N × {} numbers", name, columns));
    }
}

} // namespace marsview::python
