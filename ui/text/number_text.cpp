#include "ui/text/number_text.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QLocale>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr double kMetersInAFoot = 0.3048;

// Unicode's isolates: the text between one of them and PDI has its own direction.
constexpr QChar kLeftToRightIsolate(0x2066);
constexpr QChar kFirstStrongIsolate(0x2068);
constexpr QChar kPopIsolate(0x2069);

bool isLayoutRightToLeft()
{
    return QGuiApplication::layoutDirection() == Qt::RightToLeft;
}

bool hasRightToLeftLetters(const QString& text)
{
    return std::any_of(text.begin(), text.end(), [](QChar c) {
        return c.direction() == QChar::DirR || c.direction() == QChar::DirAL;
    });
}

} // namespace

double inUnit(double height_m, HeightUnit unit)
{
    return unit == HeightUnit::Feet ? height_m / kMetersInAFoot : height_m;
}

QString unitSymbol(HeightUnit unit)
{
    return unit == HeightUnit::Feet ? QStringLiteral("ft") : QStringLiteral("m");
}

QString numberText(double value, int decimals)
{
    const double half = 0.5 * std::pow(10.0, -decimals);
    return leftToRight(
        withMinusSigns(QLocale().toString(std::abs(value) < half ? 0.0 : value, 'f', decimals)));
}

QString shortNumberText(double value, int digits)
{
    return leftToRight(withMinusSigns(QLocale().toString(value, 'g', digits)));
}

QString significantNumberText(double value, int digits)
{
    if (!std::isfinite(value) || std::abs(value) < 1.0) {
        return shortNumberText(value, digits);
    }
    const int before_point = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
    if (before_point <= digits) {
        return numberText(value, digits - before_point);
    }
    const double step = std::pow(10.0, before_point - digits);
    return numberText(std::round(value / step) * step, 0);
}

QString sampleText(double raw)
{
    constexpr double kIntegerMax = 1e9;
    if (std::abs(raw) <= kIntegerMax && raw == std::trunc(raw)) {
        return numberText(raw, 0);
    }
    constexpr int kFloatDigits = 9;
    constexpr int kDoubleDigits = 17;
    const bool is_float = static_cast<double>(static_cast<float>(raw)) == raw;
    const auto is_meant = [raw, is_float](int digits) {
        const double read = QString::number(raw, 'g', digits).toDouble();
        return is_float ? static_cast<float>(read) == static_cast<float>(raw) : read == raw;
    };
    int digits = 1;
    while (digits < (is_float ? kFloatDigits : kDoubleDigits) && !is_meant(digits)) {
        ++digits;
    }
    return shortNumberText(raw, digits);
}

QString countText(std::size_t count)
{
    return QLocale().toString(static_cast<qulonglong>(count));
}

QString heightRangeText(const HeightRange& range, HeightUnit unit)
{
    const double low = inUnit(range.minimum_m, unit);
    const double high = inUnit(range.maximum_m, unit);
    const int decimals = decimalsFor((high - low) / 10.0, 3);
    //: A range of heights; %3 is their unit
    return leftToRight(
        QCoreApplication::translate("HeightText", "%1 … %2 %3")
            .arg(numberText(low, decimals), numberText(high, decimals), unitSymbol(unit)));
}

QString bytesText(std::uint64_t bytes)
{
    const auto value = static_cast<double>(bytes);
    const auto digits = [](double number) { return numberText(number, number < 10.0 ? 1 : 0); };
    if (value < 1e6) {
        //: Size of files: kilobytes
        return QCoreApplication::translate("SizeText", "%1 kB").arg(digits(value / 1e3));
    }
    if (value < 1e9) {
        //: Size of files: megabytes
        return QCoreApplication::translate("SizeText", "%1 MB").arg(digits(value / 1e6));
    }
    //: Size of files: gigabytes
    return QCoreApplication::translate("SizeText", "%1 GB").arg(digits(value / 1e9));
}

QString timeLeftText(std::chrono::seconds left)
{
    const auto seconds = static_cast<int>(std::min<std::int64_t>(left.count(), 3600 * 24 * 365));
    if (seconds <= 50) {
        //: How long something still takes
        return QCoreApplication::translate("TimeText", "less than a minute left");
    }
    const int minutes = (seconds + 30) / 60;
    if (minutes < 100) {
        //: How long something still takes
        return QCoreApplication::translate("TimeText", "%n min left", nullptr, minutes);
    }
    //: How long something still takes: hours
    return QCoreApplication::translate("TimeText", "%n h left", nullptr, (minutes + 30) / 60);
}

int decimalsFor(double resolution, int most)
{
    if (!(resolution > 0.0)) {
        return most;
    }
    return std::clamp(static_cast<int>(std::ceil(-std::log10(resolution / 10.0) - 1e-9)), 0, most);
}

QString leftToRight(const QString& text)
{
    return isLayoutRightToLeft() && !text.isEmpty() ? kLeftToRightIsolate + text + kPopIsolate
                                                    : text;
}

QString isolated(const QString& name)
{
    return !name.isEmpty() && (isLayoutRightToLeft() || hasRightToLeftLetters(name))
               ? kFirstStrongIsolate + name + kPopIsolate
               : name;
}

QString withUnit(const QString& number, const QString& unit)
{
    //: A number and its unit
    return leftToRight(
        QCoreApplication::translate("NumberText", "%1 %2").arg(number, unit).trimmed());
}

QString withMinusSigns(QString text)
{
    for (qsizetype i = 0; i + 1 < text.size(); ++i) {
        if (text[i] == QLatin1Char('-') && text[i + 1].isDigit()) {
            text[i] = QChar(0x2212);
        }
    }
    return text;
}

} // namespace marsview
