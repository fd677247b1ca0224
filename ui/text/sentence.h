// What the core says, which begins in lower case, as a sentence of the window.
#pragma once

#include <QString>

#include <string>

namespace marsview {

/// A message of the core, which is English, in the language of the window. What comes before its
/// sentence, such as a path, stays, without a colon where it is the subject of the sentence. A
/// sentence without a translation stays, too.
QString translatedMessage(const QString& message);

/// The same, with a capital letter at its beginning and true minus signs.
QString asSentence(const QString& message);
QString asSentence(const std::string& message);

/// A name for a menu or a button, where a single ampersand would mark an access key.
QString withoutMnemonics(QString text);

} // namespace marsview
