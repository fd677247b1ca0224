// A vendor's library, loaded while the program runs because its license forbids redistribution.
#pragma once

#include <dlfcn.h>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace marsview {

/// Stays loaded until the program ends.
class VendorLibrary {
public:
    /// Loads the first of these files or names that can be loaded. Empty if none can; `complaint`
    /// then says why the first one cannot.
    static std::optional<VendorLibrary> load(const std::vector<std::string>& names,
                                             std::string& complaint);

    /// Sets `function`, or null if the library lacks it.
    template <typename Function>
    void findOptional(Function& function, const char* name) const
    {
        static_assert(std::is_pointer_v<Function>);
        function = reinterpret_cast<Function>(dlsym(library_, name));
    }
    /// Also notes a missing function.
    template <typename Function>
    void find(Function& function, const char* name)
    {
        findOptional(function, name);
        if (function == nullptr && missing_.empty()) {
            missing_ = name;
        }
    }
    /// The first function that find() did not find; empty if it found all.
    const std::string& missing() const noexcept { return missing_; }

private:
    explicit VendorLibrary(void* library)
        : library_(library)
    {}

    void* library_;
    std::string missing_;
};

} // namespace marsview
