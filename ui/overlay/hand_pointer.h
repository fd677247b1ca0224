// Where the hand is when it is not in the picture.
#pragma once

#include <QPointF>
#include <QWidget>

namespace marsview {

/// An arrow at the edge of the map, in the cursor's color, readable on any ground. It is there
/// only while it has something to point to; transparent to the mouse.
class HandPointer final : public QWidget {
    Q_OBJECT

public:
    /// How far its middle stays from the edges of the map for all of it to be seen.
    static constexpr double kInset = 19.0;

    explicit HandPointer(QWidget* parent = nullptr);

    /// Its middle, in the parent, and where it points to: x right, y down, of length 1.
    void pointTo(QPointF middle, QPointF direction);
    void release() { hide(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString spokenText() const;

    QPointF offset_; // of its middle from the widget's
    QPointF direction_{1.0, 0.0};
};

} // namespace marsview
