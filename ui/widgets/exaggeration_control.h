// Choosing the vertical exaggeration: a slider, a field and a button for 1:1.
#pragma once

#include "core/view/exaggeration.h"

#include <QDoubleSpinBox>
#include <QSlider>
#include <QTimer>
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

    /// While arrows or the wheel change the value.
    bool isStepping() const noexcept { return is_stepping_; }

Q_SIGNALS:
    /// Return was pressed after a factor within the range.
    void entered();

protected:
    bool event(QEvent* event) override;

private:
    bool is_stepping_ = false;
    mutable bool is_corrected_ = false; // what was typed was beyond the range
};

/// Round factors, six a decade, counted from ×1 = 0, which is marked. A click does not move the
/// keyboard focus here.
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
    /// As requested(), while the slider is dragged or follows wheel and keys.
    void dragged(double exaggeration);
    /// The slider was pressed or released, or wheel and keys pause.
    void dragEnded();
    /// A factor was typed and completed with Return.
    void entered();

private:
    void step(double exaggeration);

    ExaggerationSlider* slider_ = nullptr;
    ExaggerationBox* box_ = nullptr;
    QToolButton* true_scale_ = nullptr;
    QTimer step_pause_; // runs while steps of wheel and keys are one drag
    double shown_ = 1.0;
};

} // namespace marsview
