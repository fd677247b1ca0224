// The pin at a place that was asked for.
#pragma once

#include <QPointF>
#include <QWidget>

namespace marsview {

/// A pin whose tip is at the place. Mouse events go through it.
class PlaceMark final : public QWidget {
    Q_OBJECT

public:
    explicit PlaceMark(QWidget* parent = nullptr);

    /// Shows it with its tip there, in coordinates of the parent.
    void pointAt(QPointF place);
    /// Where the tip is, in coordinates of the parent.
    QPointF tip() const;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QPointF offset_; // of the tip from a whole pixel
};

} // namespace marsview
