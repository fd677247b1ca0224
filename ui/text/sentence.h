// What the core says, which begins in lower case, as a sentence of the window.
#pragma once

#include "ui/text/number_text.h"

#include <QString>

#include <string>

namespace marsview {

inline QString asSentence(QString text)
{
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    return isolated(text); // the core writes English, whatever the layout
}

inline QString asSentence(const std::string& text)
{
    return asSentence(QString::fromStdString(text));
}

} // namespace marsview
