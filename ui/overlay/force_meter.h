// The meter of the contact force.
#pragma once

#include "core/base/vec.h"

#include <QWidget>

namespace marsview {

/// Shows the force of a touch as a bar, a number and an arrow. There only while something is
/// touched: setForce() shows it, release() hides it. Transparent to the mouse.
class ForceMeter final : public QWidget {
    Q_OBJECT

public:
    explicit ForceMeter(QWidget* parent = nullptr);

    /// The force on the hand: x right, y away from the user, z up. A force that is not finite
    /// counts as zero. `force_n_max` > 0 fills the bar.
    void setForce(const Vec3& force_n, double force_n_max);
    /// Nothing is touched any more.
    void release();
    bool isInUse() const noexcept { return is_in_use_; }

    /// The magnitude as written, for example "1.24 N".
    QString text() const;
    /// Empty while not in use.
    QSize sizeHint() const override;

Q_SIGNALS:
    /// The meter came into use or went out of it.
    void roomChanged();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString spokenText() const;

    Vec3 force_n_{};
    double force_n_max_ = 1.0;
    bool is_in_use_ = false;
};

} // namespace marsview
