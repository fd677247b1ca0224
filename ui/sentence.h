// What the core says, which begins in lower case, as a sentence of the window.
#pragma once

#include <QString>

#include <string>

namespace marsview {

inline QString asSentence(QString text)
{
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    return text;
}

inline QString asSentence(const std::string& text)
{
    return asSentence(QString::fromStdString(text));
}

} // namespace marsview
