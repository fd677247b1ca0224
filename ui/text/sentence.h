// What the core says, which begins in lower case, as a sentence of the window.
#pragma once

#include "ui/text/number_text.h"

#include <QRegularExpression>
#include <QString>

#include <string>

namespace marsview {

inline QString asSentence(QString text)
{
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    // Numbers alone: names of files and definitions of systems keep their hyphens.
    static const QRegularExpression kMinus(QStringLiteral("(?<=[ (])-(?=[0-9])"));
    text.replace(kMinus, QString(QChar(0x2212)));
    return isolated(text); // the core writes English, whatever the layout
}

inline QString asSentence(const std::string& text)
{
    return asSentence(QString::fromStdString(text));
}

} // namespace marsview
