// The table of the annotations.
#pragma once

#include "ui/panels/drawn_list.h"

namespace marsview {

class AnnotationController;

/// With the shape of each annotation and the body that it is on.
class AnnotationList final : public DrawnList {
    Q_OBJECT

public:
    enum Column { NameColumn, ShapeColumn, NoteColumn, BodyColumn };

    explicit AnnotationList(AnnotationController& controller, QWidget* parent = nullptr);

protected:
    QVariant cell(const DrawnItem& item, int column, int role) const override;
    bool isBefore(const DrawnItem& a, const DrawnItem& b, int column) const override;
    void addActions(QMenu& menu, const std::vector<std::uint32_t>& ids) override;

private:
    AnnotationController& controller_;
};

} // namespace marsview
