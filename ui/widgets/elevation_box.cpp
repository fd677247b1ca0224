#include "ui/widgets/elevation_box.h"

#include "ui/text/number_text.h"

#include <cmath>

namespace marsview {
namespace {

constexpr double kElevationMax = 1e8; // meters or feet: more than the radius of any body here

} // namespace

ElevationBox::ElevationBox(QWidget* parent)
    : QDoubleSpinBox(parent)
{
    setElevationRange();
    setKeyboardTracking(false); // not every digit on the way
    setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue);
}

void ElevationBox::setElevationRange()
{
    setRange(-kElevationMax, kElevationMax);
}

QString ElevationBox::digitsOf(QString text) const
{
    if (text.endsWith(suffix())) {
        text.chop(suffix().size());
    }
    text.replace(QChar(0x2212), locale().negativeSign());
    text.replace(QLatin1Char('-'), locale().negativeSign());
    return text.trimmed().remove(locale().groupSeparator());
}

void ElevationBox::setTrailingZeros(bool are_kept)
{
    has_trailing_zeros_ = are_kept;
}

bool ElevationBox::isSpecial(const QString& text) const
{
    return !specialValueText().isEmpty() && text == specialValueText();
}

QString ElevationBox::textFromValue(double value) const
{
    int digits = decimals();
    const auto is_whole_in = [value, this](int fewer) {
        const double scale = std::pow(10.0, fewer);
        const double rounded = std::round(value * scale) / scale;
        return std::abs(rounded - value) < 0.5 * std::pow(10.0, -decimals());
    };
    while (!has_trailing_zeros_ && digits > 0 && is_whole_in(digits - 1)) {
        --digits;
    }
    return numberText(value, digits);
}

double ElevationBox::valueFromText(const QString& text) const
{
    if (isSpecial(text)) {
        return minimum();
    }
    bool is_number = false;
    const double value = locale().toDouble(digitsOf(text), &is_number);
    return is_number ? value : this->value();
}

QValidator::State ElevationBox::validate(QString& text, int& /*position*/) const
{
    if (isSpecial(text)) {
        return QValidator::Acceptable;
    }
    const QString digits = digitsOf(text);
    if (digits.isEmpty() || digits == locale().negativeSign()) {
        return QValidator::Intermediate;
    }
    bool is_number = false;
    const double value = locale().toDouble(digits, &is_number);
    if (!is_number) {
        return QValidator::Invalid;
    }
    return value >= minimum() && value <= maximum() ? QValidator::Acceptable
                                                    : QValidator::Intermediate;
}

} // namespace marsview
