// The language of the window.
#pragma once

#include <QList>
#include <QString>

#include <memory>
#include <vector>

class QTranslator;

namespace marsview {

/// A language that the window can be shown in.
struct Language {
    QString code; // "en", "de"
    QString name; // in the language itself
};
/// English, then the languages with a translation.
QList<Language> languages();

/// The code of the language for a preference: the preference itself if there is such a language,
/// otherwise the first of the system's languages that there is, otherwise English.
QString languageFor(const QString& preferred);

/// Translates the program's texts and Qt's own while the result exists. Before any window is made,
/// which keeps the language that it was made in.
std::vector<std::unique_ptr<QTranslator>> translateTo(const QString& code);

/// Numbers and dates as in that language. The region stays if it is the system's.
void useNumbersOf(const QString& code);

} // namespace marsview
