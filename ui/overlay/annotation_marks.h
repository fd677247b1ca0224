// Symbols, names and handles of the annotations on the map.
#pragma once

#include "core/annotations/annotation.h"
#include "ui/overlay/drawn_marks.h"

#include <QPainterPath>
#include <QPixmap>
#include <QRgb>

#include <map>
#include <tuple>

namespace marsview {

class AnnotationController;
struct AnnotationItem;

/// Names that would lie over others are left out. Points that the terrain hides are faint.
class AnnotationMarks final : public DrawnMarks {
    Q_OBJECT

public:
    AnnotationMarks(AnnotationController& controller, QWidget* view);

private:
    std::vector<Mark> marks() const override;
    Mark symbolMark(const AnnotationItem& item, const DrawnHandle& handle) const;

    AnnotationController& controller_;
    using Look = std::tuple<MarkSymbol, QRgb, bool>; // color, whether it is hidden
    mutable std::map<Look, QPixmap> stamps_;
    mutable double stamp_scale_ = 1.0;
};

/// Around a place, of that radius.
QPainterPath symbolPath(MarkSymbol symbol, QPointF place, double radius);

} // namespace marsview
