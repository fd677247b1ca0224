// Asks for the elevation between two contour lines.
#pragma once

#include <QDialog>

namespace marsview {

class ElevationBox;

class IntervalDialog final : public QDialog {
    Q_OBJECT

public:
    /// Whether an interval that follows the view, 0, can be chosen.
    enum class Automatic { Allowed, NotAllowed };

    IntervalDialog(const QString& title,
                   Automatic automatic,
                   double interval_m,
                   QWidget* parent = nullptr);

    ElevationBox* box() const noexcept { return box_; }

Q_SIGNALS:
    /// In meters; 0 for automatic.
    void intervalChosen(double interval_m);

private:
    ElevationBox* box_;
};

} // namespace marsview
