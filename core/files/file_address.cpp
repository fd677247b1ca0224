#include "core/files/file_address.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace marsview {
namespace {

bool startsWithAnyCase(std::string_view text, std::string_view prefix)
{
    return text.size() >= prefix.size() &&
           std::equal(prefix.begin(), prefix.end(), text.begin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
}

std::optional<unsigned> hexDigit(char c)
{
    if (c >= '0' && c <= '9') {
        return static_cast<unsigned>(c - '0');
    }
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower >= 'a' && lower <= 'f' ? std::optional(static_cast<unsigned>(lower - 'a') + 10U)
                                        : std::nullopt;
}

// Empty if a percent sign is not followed by two hexadecimal digits, or if they encode a zero byte.
std::optional<std::string> percentDecoded(std::string_view text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const auto high = i + 2 < text.size() ? hexDigit(text[i + 1]) : std::nullopt;
        const auto low = i + 2 < text.size() ? hexDigit(text[i + 2]) : std::nullopt;
        if (!high || !low || *high * 16 + *low == 0) {
            return std::nullopt;
        }
        decoded += static_cast<char>(*high * 16 + *low);
        i += 2;
    }
    return decoded;
}

} // namespace

Result<std::string> localPathOf(const std::string& address)
{
    constexpr std::string_view kScheme = "file:";
    if (!startsWithAnyCase(address, std::string(kScheme) + "/")) {
        return address;
    }
    std::string_view rest = std::string_view(address).substr(kScheme.size());
    if (rest.starts_with("//")) {
        rest.remove_prefix(2);
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        const std::string_view host = rest.substr(0, slash);
        if (!host.empty() && !(host.size() == 9 && startsWithAnyCase(host, "localhost"))) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: names the computer \"{}\"; only files of this computer "
                                     "can be opened with file://",
                                     address, host)};
        }
        rest.remove_prefix(slash);
    }
    if (rest.empty()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: no path; write file:///folder/file.tif", address)};
    }
    const std::optional<std::string> path = percentDecoded(rest);
    if (!path) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: a percent sign must be followed by two hexadecimal digits "
                                 "(%20 is a blank, %25 a percent sign)",
                                 address)};
    }
    return *path;
}

} // namespace marsview
