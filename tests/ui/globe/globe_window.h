// A window that shows the bundled Mars, on the flat map or as a globe.
#pragma once

#include "core/globe/body_motion.h"
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/globe/globe_view.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QFile>
#include <QMouseEvent>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <string>

namespace marsview {

class GlobeTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    QAction* scene(int index) { return window_->actionSet().scenes->actions().at(index); }
    bool showGlobe()
    {
        scene(2)->trigger();
        return waitFor([this] { return globe().terrain() != nullptr; });
    }
    GlobeView& globe() { return *window_->globe(); }
    QPointF globeMiddle() { return QRectF(globe().rect()).center(); }
    const Ellipsoid& body() { return globe().terrain()->grid()->ellipsoid(); }

    // The CRS of the ASCII grid with that name: longitude and latitude on Mars.
    void writeMarsCrs(const QString& name)
    {
        QFile file(maps_.path(name));
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        file.write(
            "GEOGCS[\"GCS_Mars_2000\",DATUM[\"D_Mars_2000\","
            "SPHEROID[\"Mars_2000_IAU_IAG\",3396190.0,169.8944472236118]],"
            "PRIMEM[\"Reference_Meridian\",0.0],UNIT[\"Degree\",0.0174532925199433]]");
    }
    void wheel(QPointF at, int notches)
    {
        QWheelEvent event(at, globe().mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&globe(), &event);
    }
    // To the widget itself: a motion of the real pointer arrives when the X server sends it.
    void move(QPointF at, Qt::MouseButtons buttons = Qt::NoButton)
    {
        QMouseEvent event(QEvent::MouseMove, at, globe().mapToGlobal(at), Qt::NoButton, buttons,
                          Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    }
    bool rests()
    {
        return waitFor([this] { return !globe().isMoving(); });
    }
    GeographicPoint placeAt(QPointF at)
    {
        const auto hit = globe().hitAt(at);
        EXPECT_TRUE(hit);
        return hit ? *globe().terrain()->map()->georeference().toGeographic(hit->grid)
                   : GeographicPoint{};
    }
    // In the body-fixed frame, in meters.
    ScenePoint pointAt(QPointF at)
    {
        const auto hit = globe().hitAt(at);
        const CameraPose pose = poseOf(globe().camera(), body());
        const Ray ray = pickRay(pose, globe().viewport(), {at.x(), at.y()});
        EXPECT_TRUE(hit);
        return hit ? ray.at(hit->distance_m) : ScenePoint{};
    }
};

} // namespace marsview
