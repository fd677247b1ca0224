#include "ui/text/language.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

#include <algorithm>
#include <utility>

// The macro must not be in a namespace, not even an unnamed one.
static void loadTranslations()
{
#ifdef MARSVIEW_HAS_TRANSLATIONS
    Q_INIT_RESOURCE(translations);
#endif
}

namespace marsview {
namespace {

// "de" for "de-CH" and "de_CH".
QString languagePart(const QString& name)
{
    const auto is_end = [](QChar c) { return c == QLatin1Char('-') || c == QLatin1Char('_'); };
    return QString(name.begin(), std::find_if(name.begin(), name.end(), is_end) - name.begin());
}

} // namespace

QList<Language> languages()
{
    QList<Language> all{{QStringLiteral("en"), QStringLiteral("English")}};
#ifdef MARSVIEW_HAS_TRANSLATIONS
    for (const QString& code :
         QStringLiteral(MARSVIEW_HAS_TRANSLATIONS).split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
        all.append({code, QLocale(code).nativeLanguageName()});
    }
#endif
    return all;
}

QString languageFor(const QString& preferred)
{
    QStringList wanted = QLocale::system().uiLanguages();
    wanted.prepend(preferred);
    const QList<Language> all = languages();
    for (const QString& name : std::as_const(wanted)) {
        for (const Language& language : all) {
            if (!name.isEmpty() && languagePart(name) == language.code) {
                return language.code;
            }
        }
    }
    return all.front().code;
}

std::vector<std::unique_ptr<QTranslator>> translateTo(const QString& code)
{
    loadTranslations();
    std::vector<std::unique_ptr<QTranslator>> translators;
    const auto install = [&translators](const QString& file, const QString& folder) {
        auto translator = std::make_unique<QTranslator>();
        if (translator->load(file, folder)) {
            QCoreApplication::installTranslator(translator.get());
            translators.push_back(std::move(translator));
        }
    };
    install(QStringLiteral("qtbase_") + code, QLibraryInfo::path(QLibraryInfo::TranslationsPath));
    install(QStringLiteral("marsview_") + code, QStringLiteral(":/translations"));
    return translators;
}

void useNumbersOf(const QString& code)
{
    if (languagePart(QLocale().name()) != code) { // also "C", which has no group separators
        QLocale::setDefault(QLocale(code));
    }
}

} // namespace marsview
