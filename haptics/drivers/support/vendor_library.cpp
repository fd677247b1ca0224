#include "haptics/drivers/support/vendor_library.h"

#include "haptics/device/loader_message.h"

namespace marsview {

std::optional<VendorLibrary> VendorLibrary::load(const std::vector<std::string>& names,
                                                 std::string& complaint)
{
    complaint.clear();
    for (const std::string& name : names) {
        void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        if (library != nullptr) {
            complaint.clear();
            return VendorLibrary(library);
        }
        const char* text = dlerror(); // NOLINT(concurrency-mt-unsafe): glibc's is
        if (complaint.empty() && text != nullptr) {
            complaint = name + " " + loaderSentence(name, text);
        }
    }
    return std::nullopt;
}

} // namespace marsview
