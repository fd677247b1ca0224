// A report of a map and the measurements on it, as a value. All texts are as people read them.
#pragma once

#include <QByteArray>
#include <QColor>
#include <QImage>
#include <QList>
#include <QSize>
#include <QString>
#include <QStringList>

#include <optional>

namespace marsview {

struct ReportFact {
    QString label;
    QString value;
};

struct ReportTable {
    QStringList header;
    QList<QStringList> rows{}; // as long as the header
};

/// A drawing as SVG.
struct ReportFigure {
    QByteArray svg{};
    QSize size{}; // of its view box
    QString caption{};
};

/// The colors of the map, from the low end of the ramp to the high one.
struct ReportLegend {
    struct Tick {
        double share = 0.0; // of the ramp
        QString text;
    };
    QString title{}; // "Elevation (km), areoid"
    QList<QColor> colors{};
    QList<Tick> ticks{};
    QString contours{}; // "Contours 500 m"; empty without
};

struct ReportScale {
    QString text;       // "200 km"
    double share = 0.0; // of the picture's width, in its middle
};

struct ReportMap {
    QImage picture{};
    std::optional<ReportLegend> legend{};
    std::optional<ReportScale> scale{};
    double north_deg = 0.0; // where north is, clockwise from up
    QString caption{};
};

/// A heading with what belongs to it, in this order.
struct ReportSection {
    QString title;
    QString note{};
    QList<ReportFact> facts{};
    QList<ReportFigure> figures{};
    std::optional<ReportTable> table{};
};

struct Report {
    QString title;
    QString subtitle{}; // body, place, date
    QString credit{};   // of the data
    QString made_by{};  // program and date
    ReportMap map{};
    QList<ReportSection> sections{};
};

/// Legend, scale bar and north arrow of a map in one strip, as wide as the picture is drawn:
/// 1000 × kMapKeyHeight units of its view box. Without a legend and a scale it has the arrow alone.
QByteArray mapKeySvg(const ReportMap& map);
inline constexpr int kMapKeyHeight = 84;

/// A page for browsers: one file that needs no other, with everything embedded.
QString reportHtml(const Report& report);

} // namespace marsview
