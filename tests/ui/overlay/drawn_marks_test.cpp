// Labels of measurements and annotations make way for what else lies over the map.

#include "tests/ui/map_window.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/overlay/annotation_marks.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/overlay/place_mark.h"

#include <QFontMetricsF>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace marsview {
namespace {

class DrawnMarksTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
        annotations_ = window_->findChild<AnnotationMarks*>();
        measurements_ = window_->findChild<MeasureMarks*>();
    }
    void annotate(GridPoint place)
    {
        window_->annotating()->begin(FeatureShape::Point);
        window_->annotating()->addPointAt(place);
    }
    void measure(GridPoint from, GridPoint to)
    {
        MeasureController& measuring = *window_->measuring();
        measuring.begin(MeasurementKind::Distance);
        measuring.addPointAt(from);
        measuring.addPointAt(to);
        measuring.finish();
        const std::uint32_t id = measuring.current()->id;
        ASSERT_TRUE(waitFor(
            [&] { return measuring.outcome(id).result && !measuring.outcome(id).is_running; }));
    }
    bool isAtRest()
    {
        return waitFor([this] { return view().isPictureComplete() && !view().isMoving(); });
    }
    static bool overlaps(const std::vector<QRectF>& labels, const QRectF& other)
    {
        return std::any_of(labels.begin(), labels.end(),
                           [&other](const QRectF& label) { return label.intersects(other); });
    }

    AnnotationMarks* annotations_ = nullptr;
    MeasureMarks* measurements_ = nullptr;
};

} // namespace

TEST_F(DrawnMarksTest, NamesMakeWayForThePinAndReturn)
{
    annotate({20.0, 15.0});
    view().setFocus(); // the name is kept
    ASSERT_TRUE(isAtRest());
    const std::vector<QRectF> before = annotations_->labelBoxes();
    ASSERT_EQ(before.size(), 1U);
    const auto hit = view().surfaceAt(QPointF(before[0].center().x(), before[0].bottom()));
    ASSERT_TRUE(hit);
    window_->overlays()->markPlace(hit->grid);
    const QRectF pin = window_->overlays()->placeMark()->geometry();
    ASSERT_TRUE(pin.intersects(before[0]));
    const std::vector<QRectF> beside = annotations_->labelBoxes();
    ASSERT_EQ(beside.size(), 1U) << "it has moved";
    EXPECT_FALSE(beside[0].intersects(pin));
    window_->overlays()->clearMark();
    EXPECT_EQ(annotations_->labelBoxes(), before);
}

TEST_F(DrawnMarksTest, ResultsAndNamesLeaveEachOthersPointsUncovered)
{
    ASSERT_NO_FATAL_FAILURE(measure({12.0, 15.0}, {20.0, 15.0}));
    ASSERT_TRUE(isAtRest());
    ASSERT_EQ(measurements_->labelBoxes().size(), 1U);
    const auto hit = view().surfaceAt(measurements_->labelBoxes()[0].center());
    ASSERT_TRUE(hit);
    annotate(hit->grid);
    view().setFocus();
    ASSERT_TRUE(isAtRest());
    const auto point = window_->annotating()->namePlace(1);
    ASSERT_TRUE(point);
    const QRectF symbol(*point - QPointF(5.0, 5.0), QSizeF(10.0, 10.0));
    const std::vector<QRectF> results = measurements_->labelBoxes();
    ASSERT_EQ(results.size(), 1U);
    EXPECT_FALSE(overlaps(results, symbol));
    const std::vector<QRectF> names = annotations_->labelBoxes();
    ASSERT_EQ(names.size(), 1U);
    EXPECT_FALSE(overlaps(results, names[0]));
    for (const DrawnHandle& handle : window_->measuring()->handles()) {
        EXPECT_FALSE(overlaps(names, QRectF(handle.place - QPointF(4.0, 4.0), QSizeF(8.0, 8.0))));
    }
}

// The name lies where the result will have its label, which the results do not give up.
TEST_F(DrawnMarksTest, NamesMakeWayForResultsThatArriveLater)
{
    const int start = window_->undoStack().index();
    ASSERT_NO_FATAL_FAILURE(measure({12.0, 15.0}, {20.0, 15.0}));
    ASSERT_TRUE(isAtRest());
    ASSERT_EQ(measurements_->labelBoxes().size(), 1U);
    const QPointF goal = measurements_->labelBoxes()[0].center();
    window_->undoStack().setIndex(start);
    const auto name_at = [&](QPointF position) {
        const auto hit = view().surfaceAt(position);
        ASSERT_TRUE(hit);
        annotate(hit->grid);
        view().setFocus(); // the name is kept
        ASSERT_TRUE(isAtRest());
        ASSERT_EQ(annotations_->labelBoxes().size(), 1U);
    };
    ASSERT_NO_FATAL_FAILURE(name_at(goal));
    const QPointF offset = annotations_->labelBoxes()[0].center() - goal;
    window_->undoStack().setIndex(start);
    ASSERT_NO_FATAL_FAILURE(name_at(goal - offset));
    const std::vector<QRectF> before = annotations_->labelBoxes();

    QSignalSpy changed(annotations_, &DrawnMarks::marksChanged);
    ASSERT_NO_FATAL_FAILURE(measure({12.0, 15.0}, {20.0, 15.0}));
    ASSERT_TRUE(isAtRest());
    const std::vector<QRectF> results = measurements_->labelBoxes();
    ASSERT_EQ(results.size(), 1U);
    EXPECT_TRUE(overlaps(before, results[0])) << "the name has to make way";
    EXPECT_FALSE(overlaps(annotations_->labelBoxes(), results[0]));
    EXPECT_GE(changed.count(), 1) << "names of places make way, too";
}

TEST_F(DrawnMarksTest, ALabelHasRoomForItsTextInLargerLetters)
{
    annotate({20.0, 15.0});
    const QString name = QStringLiteral("A rather long name of a rim, 150 %");
    window_->annotating()->rename(1, name);
    view().setFocus();
    QFont font = annotations_->font();
    font.setPointSizeF(1.5 * font.pointSizeF());
    annotations_->setFont(font);
    ASSERT_TRUE(isAtRest());
    const std::vector<QRectF> labels = annotations_->labelBoxes();
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_GE(labels[0].width(), QFontMetricsF(font).horizontalAdvance(name));
    EXPECT_GE(labels[0].height(), QFontMetricsF(font).height());
    EXPECT_TRUE(QRectF(view().rect()).contains(labels[0]));
}

} // namespace marsview
