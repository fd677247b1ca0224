// Choosing the vertical exaggeration: a slider, a field and a button for 1:1.
#pragma once

#include "core/view/exaggeration.h"

#include <QDoubleSpinBox>
#include <QSlider>
#include <QWidget>

class QToolButton;

namespace marsview {

/// A factor written "×1.5". Arrows step through round numbers; any number within the range can be
/// typed.
class ExaggerationBox final : public QDoubleSpinBox {
    Q_OBJECT

public:
    explicit ExaggerationBox(QWidget* parent = nullptr);

    void stepBy(int steps) override;
    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& position) const override;
    void fixup(QString& text) const override;
};

/// Round factors, six a decade, counted from ×1 = 0, which is marked.
class ExaggerationSlider final : public QSlider {
    Q_OBJECT

public:
    explicit ExaggerationSlider(QWidget* parent = nullptr);

protected:
    void paintEvent(QPaintEvent* event) override;
};

class ExaggerationControl final : public QWidget {
    Q_OBJECT

public:
    explicit ExaggerationControl(QWidget* parent = nullptr);

    /// The exaggerations that can be chosen. Keeps the current value.
    void setRange(const ExaggerationRange& range);
    void showExaggeration(double exaggeration);

Q_SIGNALS:
    void requested(double exaggeration);
    /// As requested(), while the slider is dragged.
    void dragged(double exaggeration);
    /// The slider was pressed or released.
    void dragEnded();

private:
    ExaggerationSlider* slider_ = nullptr;
    ExaggerationBox* box_ = nullptr;
    QToolButton* true_scale_ = nullptr;
    double shown_ = 1.0;
};

} // namespace marsview
