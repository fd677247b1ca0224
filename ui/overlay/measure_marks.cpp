#include "ui/overlay/measure_marks.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/widgets/plate.h"

#include <QPainter>
#include <QPainterPath>

namespace marsview {

MeasureMarks::MeasureMarks(MeasureController& controller, QWidget* view)
    : DrawnMarks(controller, view)
    , controller_(controller)
{
    setAccessibleName(tr("Points of the measurements"));
    connect(&controller_, &MeasureController::measured, this, &MeasureMarks::noteChange);
}

void MeasureMarks::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    noteChange();
}

std::vector<DrawnMarks::Mark> MeasureMarks::marks() const
{
    const MeasureState& state = controller_.state();
    std::vector<Mark> marks;
    if (state.items.empty()) {
        return marks;
    }
    for (auto handle = handles().rbegin(); handle != handles().rend(); ++handle) {
        marks.push_back(handleMark(*handle, handle->item == state.current));
    }
    if (const auto cursor = controller_.profileCursorPlace()) {
        constexpr double kRadius = 6.5;
        marks.push_back({boxAround(*cursor, kRadius + 4.0), false, [cursor](QPainter& painter) {
                             QPainterPath ring;
                             ring.addEllipse(*cursor, kRadius, kRadius);
                             drawContrasting(painter, ring, Qt::white, 2.0);
                         }});
    }
    // The current one first, then those that were drawn last.
    std::vector<const MeasureItem*> named;
    for (auto item = state.items.rbegin(); item != state.items.rend(); ++item) {
        named.insert(item->id == state.current ? named.begin() : named.end(), &*item);
    }
    std::vector<QRectF> boxes;
    for (const Mark& mark : marks) {
        boxes.push_back(mark.box);
    }
    LabelRoom room = roomBeside(boxes);
    for (const MeasureItem* each : named) {
        const MeasureItem& item = *each;
        const MeasureOutcome& outcome = controller_.outcome(item.id);
        const auto place = controller_.labelPlace(item.id);
        // What lies beyond the picture has its numbers in the panel.
        const QString text = outcome.result ? measureSummary(*outcome.result, unit_) : QString();
        if (!place || text.isEmpty() || !QRectF(rect()).contains(*place)) {
            continue;
        }
        if (auto label = labelMark(*place, text, room)) {
            marks.push_back(std::move(*label));
        }
    }
    return marks;
}

} // namespace marsview
