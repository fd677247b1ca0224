// The cross in the middle of the picture, where the keyboard reads.
#pragma once

#include <QWidget>

namespace marsview {

/// A bright cross with a dark rim and an open middle, so that the place itself stays visible. Mouse
/// events go through it.
class Crosshair final : public QWidget {
    Q_OBJECT

public:
    explicit Crosshair(QWidget* parent = nullptr);

    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
};

} // namespace marsview
