// The outcome of an operation that the world (a file, a device, a GPU) may refuse.
//
// A Result holds a value or an Error, never both. Bugs are not Results: they stop the program
// through MARSVIEW_CHECK (check.h).
#pragma once

#include "core/base/check.h"

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace marsview {

enum class ErrorCode {
    NotFound,    // there is nothing at that path or under that name
    Unreadable,  // it is there, but reading it failed
    Unsupported, // it can be read, but it is not something this program works with
    Invalid,     // its content, or an argument, contradicts itself
    OutOfRange,  // a number lies outside the stated range
    TooLarge,    // it would not fit in the memory granted
    Cancelled,   // the user stopped it
    Damaged,     // it is not what it was, though nobody is known to have changed it
};

/// What went wrong, in one sentence for the user: which thing, what was found, what to do.
/// Lower case, no full stop.
struct Error {
    ErrorCode code = ErrorCode::Invalid;
    std::string message;
};

/// A value of type T, or the Error that prevented it. Interface as std::expected.
template <typename T>
class [[nodiscard]] Result {
public:
    // Both conversions are meant: `return value;` and `return Error{…};` are how functions answer.
    // NOLINTNEXTLINE(google-explicit-constructor)
    Result(T value)
        : state_(std::in_place_index<0>, std::move(value))
    {}
    // NOLINTNEXTLINE(google-explicit-constructor)
    Result(Error error)
        : state_(std::in_place_index<1>, std::move(error))
    {}

    // NOLINTNEXTLINE(readability-identifier-naming): the standard's name
    bool has_value() const noexcept { return state_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }

    T& value() &
    {
        MARSVIEW_CHECK(has_value());
        return *std::get_if<0>(&state_);
    }
    const T& value() const&
    {
        MARSVIEW_CHECK(has_value());
        return *std::get_if<0>(&state_);
    }
    T&& value() &&
    {
        MARSVIEW_CHECK(has_value());
        return std::move(*std::get_if<0>(&state_));
    }
    const Error& error() const&
    {
        MARSVIEW_CHECK(!has_value());
        return *std::get_if<1>(&state_);
    }
    Error&& error() &&
    {
        MARSVIEW_CHECK(!has_value());
        return std::move(*std::get_if<1>(&state_));
    }

    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

private:
    std::variant<T, Error> state_;
};

/// The Result of an operation that yields nothing but its success.
struct Done {};
using Status = Result<Done>;

} // namespace marsview
