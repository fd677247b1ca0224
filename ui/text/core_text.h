// Texts of the core, which are UTF-8.
#pragma once

#include <QString>

#include <string_view>

namespace marsview {

inline QString textFrom(std::string_view text)
{
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

} // namespace marsview
