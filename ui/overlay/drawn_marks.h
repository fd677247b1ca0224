// Marks over the map that keep their size on the screen: handles, symbols and labels.
#pragma once

#include "core/view/color_ramp.h"
#include "ui/drawing/drawn_item.h"
#include "ui/overlay/box_grid.h"
#include "ui/widgets/picture_part.h"

#include <QColor>
#include <QHash>
#include <QList>
#include <QPixmap>
#include <QPointer>
#include <QRectF>
#include <QString>
#include <QWidget>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

class QPainter;

namespace marsview {

class DrawingBase;

/// Covers its parent, the view, and is transparent to the mouse.
class DrawnMarks : public QWidget {
    Q_OBJECT

public:
    /// Follows the items of `drawing`. Without it there are no marks.
    DrawnMarks(const DrawingBase& drawing, QWidget* view);

    /// Widgets over the view that labels keep clear of while they are visible.
    void setObstacles(const QList<QWidget*>& obstacles);
    /// Marks of the same view, which outlive this. Labels leave their points uncovered where there
    /// is other room.
    void setNeighbor(const DrawnMarks& neighbor) { neighbor_ = &neighbor; }
    /// The labels of the neighbor take their room first. Not for both of two neighbors.
    void giveWayToNeighbor();
    /// Of the labels as they are drawn now, in points. None overlap, also not those of neighbors.
    std::vector<QRectF> labelBoxes() const;
    /// What names of places keep clear of: labels, points and lines.
    std::vector<QRectF> takenBoxes() const;
    /// For a picture of the view of any size: as large as in the view where it is as high.
    std::vector<PicturePart> partsFor(const QSize& picture) const;

Q_SIGNALS:
    /// What is drawn may have changed.
    void marksChanged();

protected:
    struct Mark {
        QRectF box; // that it fills, in points
        bool is_label = false;
        std::function<void(QPainter&)> draw;
    };
    /// In the order in which they are drawn.
    virtual std::vector<Mark> marks() const = 0;
    /// Below marks(), in pictures of the view: what the view itself draws.
    virtual std::vector<Mark> marksOnTerrain() const { return {}; }
    /// Lets the view draw what it draws itself.
    virtual void showOnTerrain() {}

    static QColor colorOf(const Rgb8& color);
    static QRectF boxAround(QPointF place, double radius);
    /// A dot with a dark rim, faint where it is hidden.
    static Mark handleMark(const DrawnHandle& handle, bool is_current);
    /// Room for labels: those placed before, which none overlaps, and marks that labels do not
    /// cover where there is other room.
    struct LabelRoom {
        BoxGrid labels;
        BoxGrid marks;
    };
    /// The handles of the items as they are now.
    const std::vector<DrawnHandle>& handles() const;
    /// Of more marks, no room is left anyway.
    static constexpr std::size_t kMarksMax = 500;
    /// With the labels and handles of the neighbor, and these marks.
    LabelRoom roomBeside(const std::vector<QRectF>& marks) const;
    /// Next to a place, within the view and clear of obstacles and other labels, and adds it to
    /// `room`. Empty if it does not fit.
    std::optional<Mark> labelMark(QPointF place, const QString& text, LabelRoom& room) const;
    void noteChange();

    void changeEvent(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    // A text as it looks on the screen; the same ones are drawn in most frames.
    struct LabelStamp {
        double width = 0.0; // of the text, in points
        QPixmap picture;    // null before it is painted first
    };

    double widthOf(const QString& text) const;
    void paintLabel(QPainter& painter, const QRectF& plate, const QString& text) const;
    std::optional<QRectF> labelBox(QPointF place, const QSizeF& size, const LabelRoom& room) const;
    QRectF placeOf(const QWidget& obstacle) const;
    const std::vector<Mark>& knownMarks() const;
    bool areMarksKnown() const;
    void forget();
    void noteMove();
    void showNew();

    QPointer<const DrawingBase> drawing_; // null once the window is being closed
    QList<QWidget*> obstacles_;
    const DrawnMarks* neighbor_ = nullptr;
    bool gives_way_ = false;
    mutable std::optional<std::vector<Mark>> marks_; // since the last change
    mutable std::uint64_t marks_of_ = 0;             // DrawingBase::handlesRevision()
    mutable std::vector<QRectF> given_way_to_;       // labels of the neighbor
    mutable QHash<QString, LabelStamp> label_stamps_;
    mutable double label_scale_ = 1.0; // pixels a point, of the stamps
    std::uint64_t painted_of_ = 0;
    std::uint64_t shown_of_ = 0; // by showOnTerrain()
};

} // namespace marsview
