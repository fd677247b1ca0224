// An environment variable with another value for a while.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace marsview::test {

/// Sets a variable, or removes it if `value` is null. The destructor restores the previous value.
/// `name` must outlive it.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const char* value)
        : name_(name)
    {
        if (const char* before = std::getenv(name)) { // NOLINT(concurrency-mt-unsafe)
            before_ = before;
        }
        set(value);
    }
    ~ScopedVariable() { set(before_ ? before_->c_str() : nullptr); }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

private:
    void set(const char* value)
    {
        if (value != nullptr) {
            setenv(name_, value, 1); // NOLINT(concurrency-mt-unsafe)
        } else {
            unsetenv(name_); // NOLINT(concurrency-mt-unsafe)
        }
    }

    const char* name_;
    std::optional<std::string> before_;
};

} // namespace marsview::test
