// Symbols, names and handles of the annotations on the map.
#pragma once

#include "core/annotations/annotation.h"
#include "ui/overlay/drawn_marks.h"

#include <QPainterPath>

#include <memory>

namespace marsview {

class AnnotationController;
struct AnnotationItem;
struct DotStamps;

/// Names that would lie over others are left out. Points that the terrain hides are faint.
class AnnotationMarks final : public DrawnMarks {
    Q_OBJECT

public:
    AnnotationMarks(AnnotationController& controller, QWidget* view);

private:
    std::vector<Mark> marks() const override;
    std::vector<Mark> marksOnTerrain() const override;
    void showOnTerrain() override;
    bool isOnTerrain(const DrawnHandle& handle) const;
    Mark symbolMark(const AnnotationItem& item, const DrawnHandle& handle) const;

    AnnotationController& controller_;
    std::shared_ptr<const DotStamps> stamps_; // for the screen
    double stamps_scale_ = 0.0;
};

/// Around a place, of that radius.
QPainterPath symbolPath(MarkSymbol symbol, QPointF place, double radius);

} // namespace marsview
