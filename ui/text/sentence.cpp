#include "ui/text/sentence.h"

#include "ui/text/number_text.h"

#include <QCoreApplication>
#include <QRegularExpression>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace marsview {
namespace {

constexpr const char* kContext = "CoreMessage";

// The sentences of the core that people meet most. %1, %2 … stand for its names and numbers. A
// sentence that is not here, or that the core has changed since, stays English.
constexpr std::array kMessages{
    // A file cannot be opened.
    QT_TRANSLATE_NOOP("CoreMessage", "does not exist"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "is not a raster that GDAL can read, or is damaged; convert it to GeoTIFF or "
                      "fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "has %1 bytes, but SRTM tiles have %2 (1201 × 1201 samples) or %3 (3601 × "
                      "3601); it may be cut short; fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage", "is a color picture, not an elevation map"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "is one band of a color picture, read as elevations; open an elevation map "
                      "instead"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "looks like a color picture: band %1 of %2 is read as elevations, and all "
                      "are 8-bit values without a unit; open an elevation map instead"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "names a data file that is missing; put it next to this file (%1)"),
    QT_TRANSLATE_NOOP("CoreMessage", "is cut short or damaged: %1; fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage", "block %1 of %2 ends at byte %3, the file at byte %4"),
    QT_TRANSLATE_NOOP("CoreMessage", "block %1 of %2 has %3 bytes, too few for its %4 of samples"),
    QT_TRANSLATE_NOOP("CoreMessage", "it declares %1 blocks of samples but lists %2"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "it declares a list of %1 blocks of samples that takes %2, but the whole "
                      "file has %3"),
    QT_TRANSLATE_NOOP("CoreMessage", "its directory is beyond the end of the file"),
    QT_TRANSLATE_NOOP("CoreMessage", "its directories form a loop"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the archive is damaged: %1 in it cannot be unpacked; fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage", "the file is cut short or damaged (%1); fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage", "the file is cut short or damaged; fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "reading rows %1 to %2 failed: it is cut short, %3 of the %4 bytes that its "
                      "header promises are present; fetch it again"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "%1 × %2 samples are not a surface; at least 2 × 2 are needed"),
    QT_TRANSLATE_NOOP("CoreMessage", "contains no elevations; all of its %1 samples are nodata"),
    // A layer cannot be placed on its body.
    QT_TRANSLATE_NOOP("CoreMessage",
                      "has samples beyond a pole or outside its projection; crop it"),
    QT_TRANSLATE_NOOP("CoreMessage", "has fewer than 2 columns or rows"),
    QT_TRANSLATE_NOOP("CoreMessage", "has fewer than 2 columns or rows off the poles"),
    QT_TRANSLATE_NOOP("CoreMessage", "extends over %1° of longitude; a body has 360°"),
    // An override is refused.
    QT_TRANSLATE_NOOP("CoreMessage",
                      "unknown CRS \"%1\"; enter an EPSG or IAU code, a PROJ string or WKT"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "\"%1\" (unit %2) cannot place a grid in degrees (%3, %4); choose a CRS of "
                      "longitude and latitude, or set a geotransform in its unit"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "\"%1\" (unit %2) cannot place a grid that covers x %3 to %4 and y %5 to %6; "
                      "choose a projected CRS, or set a geotransform in degrees"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "\"%1\" is unknown; give its radii instead, or a name such as Mars, Moon, "
                      "Earth, Vesta or Titan"),
    QT_TRANSLATE_NOOP("CoreMessage", "\"%1\" is unknown; use m, km, ft or \"US survey ft\""),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "%1 cannot scale elevations; use a finite number other than 0"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "an equatorial radius of %1 m and a polar radius of %2 m are impossible; "
                      "give a polar radius above 0 and not above the equatorial one"),
    // A position cannot be read.
    QT_TRANSLATE_NOOP("CoreMessage", "\"%1\" is not understood; write for example 18.65 N 226.2 E"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "a latitude and a longitude are needed; write for example 18.65 N 226.2 E"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "%1 and %2 are the same direction; write for example 18.65 N 226.2 E"),
    QT_TRANSLATE_NOOP("CoreMessage", "%1 is too large; minutes and seconds must be below 60"),
    QT_TRANSLATE_NOOP("CoreMessage", "latitude %1 is beyond 90 degrees"),
    QT_TRANSLATE_NOOP("CoreMessage", "longitude %1 is beyond 360 degrees"),
    QT_TRANSLATE_NOOP("CoreMessage", "enter two numbers, x and then y"),
    // A measurement has no result.
    QT_TRANSLATE_NOOP(
        "CoreMessage",
        "the points coincide, so they have no plane; choose points apart from each other"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the points are nearly on a line (%1 m long, %2 m wide), so their plane is "
                      "not determined; add points away from that line"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the points are nearly on a line in plan (%1 m long, %2 m wide), so that any "
                      "elevations give a vertical plane; add points away from that line"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the plane is uncertain by %1 degrees, more than %2; choose points that are "
                      "farther apart along azimuth %3°, or closer to one plane"),
    QT_TRANSLATE_NOOP(
        "CoreMessage",
        "position %1 (%2, %3) is outside the map or on nodata; choose another position"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the rim points are nearly on a line, so their circle is not determined; add "
                      "points on other sides of the rim"),
    QT_TRANSLATE_NOOP(
        "CoreMessage",
        "an edge of the polygon leaves the map's projection; choose positions on the map"),
    QT_TRANSLATE_NOOP("CoreMessage", "was measured while the map had no CRS; measure it again"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "was measured on a body, but the map has no CRS now; set its CRS again"),
    // Notices of a map.
    QT_TRANSLATE_NOOP("CoreMessage",
                      "no CRS: map units are read as meters; set its CRS or body to get longitude "
                      "and latitude"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "no CRS, but it looks like longitude and latitude in degrees (%1): set %2; "
                      "until then, map units are read as meters"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the CRS \"%1\" (unit %2) does not fit the grid, which looks like longitude "
                      "and latitude in degrees (%3): set %4"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the CRS \"%1\" of the file is not used: it is in degrees, but the grid "
                      "covers x %2 to %3 and y %4 to %5; set the CRS; until then, map units are "
                      "read as meters"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "no georeferencing in the file: each pixel is placed as one unit square; "
                      "give a geotransform to place it"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "no unit of elevation in the file, and the elevations look like feet: read "
                      "as meters they reach %1 m, and the Earth's highest place is at %2 m; set "
                      "the unit %3; until then, meters are assumed"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "no unit of elevation in the file, and the elevations may be in %1, the unit "
                      "of the CRS; set the unit %2; until then, meters are assumed"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the unit \"%1\" is not a known unit of length; meters are assumed"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "samples of %1 at an end of the range often mark nodata, but the file "
                      "declares no nodata value; if they do, set it as nodata"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the elevations reach %1 m, but the highest place %2 is at %3 m; a scale "
                      "or a unit may be missing, or the map shows another body; set the scale, the "
                      "unit or the body"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the elevations reach %1 m, but the lowest place %2 is at %3 m; a scale "
                      "or a unit may be missing, or the map shows another body; set the scale, the "
                      "unit or the body"),
    // %2 of these two.
    QT_TRANSLATE_NOOP("CoreMessage", "on the Moon"),
    QT_TRANSLATE_NOOP("CoreMessage", "on the Earth"),
    QT_TRANSLATE_NOOP("CoreMessage", "on Mars"),
    QT_TRANSLATE_NOOP("CoreMessage", "on Mercury"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the sample %1 makes an elevation of %2 m, which is implausible; set it as "
                      "nodata, or set the unit or the scale"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "a preview of %1 × %2 samples is shown; elevations are read from it until "
                      "all %3 × %4 are available"),
    QT_TRANSLATE_NOOP("CoreMessage", "from the label %1: %2 (GDAL reads %3)"),
    QT_TRANSLATE_NOOP("CoreMessage", "from the file's metadata: %1 (GDAL reads %2)"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "the file's metadata give scale %1 and offset %2, which are not applied to "
                      "floating-point samples; set scale and offset if they should be (--scale, "
                      "--offset)"),
    QT_TRANSLATE_NOOP("CoreMessage", "opened %1 in place of %2"),
    QT_TRANSLATE_NOOP("CoreMessage",
                      "shifted by %1 column and %2 row to match the latitude and longitude limits "
                      "in the label"),
    QT_TRANSLATE_NOOP("CoreMessage", "its detail is estimated because it has no level file"),
    QT_TRANSLATE_NOOP("CoreMessage", "its extent is %1, %2"),
};

std::optional<QString> translationOf(const QString& sentence);

// The number behind a percent sign at `at`; 0 if there is none.
int placeAt(const QString& text, qsizetype at)
{
    return text[at] == QLatin1Char('%') && at + 1 < text.size() ? text[at + 1].digitValue() : 0;
}

// Matches what a message becomes once its places are filled, in their order.
QRegularExpression patternOf(const char* message)
{
    QString pattern = QRegularExpression::escape(QString::fromUtf8(message));
    static const QRegularExpression kPlace(QStringLiteral(R"(\\%[1-9])"));
    pattern.replace(kPlace, QStringLiteral("(.+?)"));
    return QRegularExpression(QRegularExpression::anchoredPattern(pattern),
                              QRegularExpression::DotMatchesEverythingOption);
}

// A number as the window shows numbers: a count in groups, others with the digits that resolve a
// millimeter in 1000 km. Very large and very small ones, other words, and what the user typed,
// which is in quotes, stay.
QString asShown(const QString& words, bool is_quoted)
{
    static const QRegularExpression kCount(QStringLiteral("^-?[1-9][0-9]{3,14}$"));
    static const QRegularExpression kSize(QStringLiteral("^([0-9]+(?:[.][0-9])?) ([kMGTPE]?B)$"));
    static const QRegularExpression kDecimal(QStringLiteral("^-?[0-9]{1,9}[.][0-9]+$"));
    constexpr int kDigits = 9;
    constexpr double kLeast = 1e-4; // smaller ones would get an exponent
    if (is_quoted) {
        return words;
    }
    if (kCount.match(words).hasMatch()) {
        return numberText(words.toDouble(), 0);
    }
    if (const QRegularExpressionMatch size = kSize.match(words); size.hasMatch()) {
        return shortNumberText(size.captured(1).toDouble(), kDigits) + QLatin1Char(' ') +
               size.captured(2);
    }
    const bool is_decimal =
        kDecimal.match(words).hasMatch() && std::abs(words.toDouble()) >= kLeast;
    return is_decimal ? shortNumberText(words.toDouble(), kDigits) : words;
}

// What fills a place may contain percent signs: everything is filled in one pass.
QString filled(const QString& text, const QRegularExpressionMatch& match)
{
    QString result;
    for (qsizetype at = 0; at < text.size(); ++at) {
        const int place = placeAt(text, at);
        if (place > 0) {
            const QString words = match.captured(place);
            result +=
                translationOf(words).value_or(asShown(words, result.endsWith(QLatin1Char('"'))));
            ++at;
        } else {
            result += text[at];
        }
    }
    return result;
}

std::optional<QString> translationOf(const QString& sentence)
{
    static const std::vector<QRegularExpression> kPatterns = [] {
        std::vector<QRegularExpression> patterns;
        for (const char* message : kMessages) {
            patterns.push_back(patternOf(message));
        }
        return patterns;
    }();
    for (std::size_t i = 0; i < kMessages.size(); ++i) {
        const QRegularExpressionMatch match = kPatterns[i].match(sentence);
        if (match.hasMatch()) {
            return filled(QCoreApplication::translate(kContext, kMessages[i]), match);
        }
    }
    return std::nullopt;
}

QString separator()
{
    return QStringLiteral(": ");
}

// Whether what comes before a colon is the subject of what follows, as in "map.tif: is a picture".
bool continuesSentence(const QString& rest)
{
    static const QRegularExpression kVerb(
        QStringLiteral("^(is|has|was|names|does|contains|cannot|looks|belongs|needs|ends) "));
    return kVerb.match(rest).hasMatch();
}

// What ends with a colon, before a sentence that may continue it.
QString beginningOf(const QString& before, bool is_continued)
{
    return is_continued && before.endsWith(separator())
               ? before.chopped(separator().size()) + QLatin1Char(' ')
               : before;
}

} // namespace

QString translatedMessage(const QString& message)
{
    QString plain = message;
    // A path, a field or both come before the sentence.
    for (qsizetype at = 0; at >= 0 && at < message.size();) {
        const QString rest = message.sliced(at);
        const bool is_continued = continuesSentence(rest);
        if (const auto translation = translationOf(rest)) {
            return beginningOf(message.first(at), is_continued) + *translation;
        }
        if (is_continued && plain == message) {
            plain = beginningOf(message.first(at), true) + rest;
        }
        const qsizetype next = message.indexOf(separator(), at);
        at = next < 0 ? -1 : next + separator().size();
    }
    return plain;
}

QString asSentence(const QString& message)
{
    QString text = translatedMessage(message);
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    // Numbers alone: names of files and definitions of systems keep their hyphens.
    static const QRegularExpression kMinus(QStringLiteral("(?<=[ (])-(?=[0-9])"));
    text.replace(kMinus, QString(QChar(0x2212)));
    return isolated(text); // it may be English, whatever the layout
}

QString asSentence(const std::string& message)
{
    return asSentence(QString::fromStdString(message));
}

QString withoutMnemonics(QString text)
{
    return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

} // namespace marsview
