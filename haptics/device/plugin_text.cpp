#include "haptics/device/plugin_text.h"

#include <algorithm>
#include <cstring>

namespace marsview {
namespace {

bool isContinuation(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

} // namespace

std::string shownPluginText(const char* text, std::size_t bytes_max)
{
    if (text == nullptr) {
        return {};
    }
    std::size_t bytes = strnlen(text, bytes_max);
    if (bytes == bytes_max && bytes > 0) {
        // The last character may be incomplete: drop it, at most four bytes.
        std::size_t last = bytes - 1;
        while (last > 0 && bytes - last < 4 && isContinuation(text[last])) {
            --last;
        }
        bytes = static_cast<unsigned char>(text[last]) < 0x80U ? bytes : last;
    }
    std::string shown(text, bytes);
    std::replace_if(
        shown.begin(), shown.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
    return shown;
}

} // namespace marsview
