// What a report says about a map and its measurements.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/session/session.h"
#include "ui/pictures/picture_scene.h"
#include "ui/report/report.h"
#include "ui/text/number_text.h"

#include <QSize>
#include <QString>

namespace marsview {

class AnnotationController;
class MeasureController;

struct ReportChoice {
    QString title;
    QString credit{};             // of the data, as the user states it
    bool has_measurements = true; // tables
    bool has_plots = true;        // profiles, hypsometry, and the stereonet of attitudes
    bool has_annotations = true;  // a table
};

struct ReportSource {
    PictureFacts map; // of the picture
    double exaggeration = 1.0;
    const Session& session;
    const MeasureController& measuring;
    const AnnotationController& annotating;
    HeightUnit unit = HeightUnit::Meters;
    CoordinateFormat format{};
};

/// Everything but the picture of the map, for a picture of that size. GUI thread.
Report reportOf(const ReportSource& source, const ReportChoice& choice, const QSize& picture);

} // namespace marsview
