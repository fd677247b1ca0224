#include "haptics/device/loader_message.h"

#include <fmt/format.h>

namespace marsview {
namespace {

bool has(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

std::string_view fileName(std::string_view path)
{
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

} // namespace

// The loader reports "FILE: what: why" in English (glibc translates only with a locale set).
std::string loaderSentence(std::string_view name, std::string_view message)
{
    const std::string_view subject = message.substr(0, message.find(':'));
    if (has(message, "cannot open shared object file")) {
        if (fileName(subject) == fileName(name)) {
            return "is not installed or may not be read";
        }
        return fmt::format("needs the library {}, which is not installed; install it",
                           fileName(subject));
    }
    if (has(message, "invalid ELF header") || has(message, "file too short") ||
        has(message, "wrong ELF class") || has(message, "invalid ELF")) {
        return "is not a library for this computer, or is damaged; get a build for this system";
    }
    constexpr std::string_view kUndefined = "undefined symbol: ";
    if (const std::size_t at = message.find(kUndefined); at != std::string_view::npos) {
        const std::string_view symbol = message.substr(at + kUndefined.size());
        return fmt::format(
            "does not fit the installed libraries (the function {} is missing); get "
            "a build for this system",
            symbol.substr(0, symbol.find_first_of(" ,")));
    }
    return fmt::format("cannot be loaded: {}", message);
}

} // namespace marsview
