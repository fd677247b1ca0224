// The outcome of an operation that can fail for outside reasons: a file, a device, a GPU.
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
    NotFound,    // nothing has that path or name
    Unreadable,  // it exists, but reading it failed
    Unsupported, // it was read, but this program does not support it
    Invalid,     // its content or an argument is inconsistent
    OutOfRange,  // a number lies outside the stated range
    TooLarge,    // it does not fit in the memory limit
    Canceled,    // the user stopped it
    Damaged,     // its content has changed, although no program is known to have written to it
};

/// One sentence for the user: what failed, why, and what to do. Lower case, no full stop.
struct Error {
    ErrorCode code = ErrorCode::Invalid;
    std::string message;
};

/// A value of type T, or the Error that prevented it. Interface as std::expected.
template <typename T>
class [[nodiscard]] Result {
public:
    // Both conversions are intended: functions return with `return value;` and `return Error{…};`.
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

/// The Result of an operation that has no value to return.
struct Done {};
using Status = Result<Done>;

} // namespace marsview
