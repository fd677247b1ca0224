#include "ui/text/body_text.h"

#include <QByteArray>
#include <QCoreApplication>

namespace marsview {
namespace {

// Those of knownBodies(); tools for translators find them here.
[[maybe_unused]] constexpr const char* kNames[]{
    QT_TRANSLATE_NOOP("Body", "Mercury"),  QT_TRANSLATE_NOOP("Body", "Venus"),
    QT_TRANSLATE_NOOP("Body", "Earth"),    QT_TRANSLATE_NOOP("Body", "Moon"),
    QT_TRANSLATE_NOOP("Body", "Mars"),     QT_TRANSLATE_NOOP("Body", "Phobos"),
    QT_TRANSLATE_NOOP("Body", "Deimos"),   QT_TRANSLATE_NOOP("Body", "Eros"),
    QT_TRANSLATE_NOOP("Body", "Vesta"),    QT_TRANSLATE_NOOP("Body", "Ceres"),
    QT_TRANSLATE_NOOP("Body", "Io"),       QT_TRANSLATE_NOOP("Body", "Europa"),
    QT_TRANSLATE_NOOP("Body", "Ganymede"), QT_TRANSLATE_NOOP("Body", "Callisto"),
    QT_TRANSLATE_NOOP("Body", "Mimas"),    QT_TRANSLATE_NOOP("Body", "Enceladus"),
    QT_TRANSLATE_NOOP("Body", "Tethys"),   QT_TRANSLATE_NOOP("Body", "Dione"),
    QT_TRANSLATE_NOOP("Body", "Rhea"),     QT_TRANSLATE_NOOP("Body", "Titan"),
    QT_TRANSLATE_NOOP("Body", "Iapetus"),  QT_TRANSLATE_NOOP("Body", "Miranda"),
    QT_TRANSLATE_NOOP("Body", "Ariel"),    QT_TRANSLATE_NOOP("Body", "Umbriel"),
    QT_TRANSLATE_NOOP("Body", "Titania"),  QT_TRANSLATE_NOOP("Body", "Oberon"),
    QT_TRANSLATE_NOOP("Body", "Triton"),   QT_TRANSLATE_NOOP("Body", "Pluto"),
    QT_TRANSLATE_NOOP("Body", "Charon"),
};

} // namespace

QString bodyName(const Body& body)
{
    return bodyName(body.name);
}

QString bodyName(std::string_view name)
{
    const QByteArray source(name.data(), static_cast<qsizetype>(name.size()));
    return QCoreApplication::translate("Body", source.constData());
}

QString bodyInSentence(const Body& body)
{
    if (body.name == "Earth") {
        //: A body, in "on the Earth"
        return QCoreApplication::translate("Body", "the Earth");
    }
    if (body.name == "Moon") {
        //: A body, in "on the Moon"
        return QCoreApplication::translate("Body", "the Moon");
    }
    return bodyName(body);
}

} // namespace marsview
