// A field for an elevation.
#pragma once

#include <QDoubleSpinBox>

namespace marsview {

/// Numbers as numberText() writes them; hyphens and minus signs are both read, and group separators
/// may be left out.
class ElevationBox final : public QDoubleSpinBox {
    Q_OBJECT

public:
    explicit ElevationBox(QWidget* parent = nullptr);

    /// What elevations can be, in meters or feet.
    void setElevationRange();

    /// Whether "2,000.000" keeps its zeros. They are kept to begin with.
    void setTrailingZeros(bool are_kept);

    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& position) const override;

private:
    QString digitsOf(QString text) const;
    bool isSpecial(const QString& text) const;

    bool has_trailing_zeros_ = true;
};

} // namespace marsview
