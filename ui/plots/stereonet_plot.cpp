#include "ui/plots/stereonet_plot.h"

#include <QFileInfo>
#include <QFontMetricsF>
#include <QImage>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QPdfWriter>
#include <QSvgGenerator>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr int kPictureSide = 600; // points
constexpr int kPngScale = 2;      // pixels per point of a PNG picture
constexpr double kMargin = 4.0;
constexpr double kTick = 5.0;
constexpr double kPoleRadius = 3.5;
constexpr double kReach = 12.0; // of a click
constexpr std::size_t kSectors = 36;

// The circle of the net, below the letter of north.
QRectF circleIn(const QRectF& area, const QFont& font)
{
    const double letter = QFontMetricsF(font).height();
    const double side =
        std::max(10.0, std::min(area.width(), area.height() - letter - kTick) - 2.0 * kMargin);
    const QPointF middle(area.center().x(), area.center().y() + 0.5 * (letter + kTick));
    return {middle.x() - 0.5 * side, middle.y() - 0.5 * side, side, side};
}

QPointF placeOn(const QRectF& circle, const NetPoint& point)
{
    const double radius = 0.5 * circle.width();
    return circle.center() + QPointF(radius * point.right, -radius * point.up);
}

QPainterPath lineOn(const QRectF& circle, const std::vector<NetPoint>& points)
{
    QPainterPath path;
    for (const NetPoint& point : points) {
        const QPointF place = placeOn(circle, point);
        path.elementCount() == 0 ? path.moveTo(place) : path.lineTo(place);
    }
    return path;
}

} // namespace

StereonetPlot::StereonetPlot(QWidget* parent)
    : QWidget(parent)
{
    setAccessibleName(tr("Stereonet"));
    setToolTip(tr("Equal-area net, lower hemisphere. Click a pole to select its plane"));
}

void StereonetPlot::setPlanes(std::vector<NetPlane> planes, std::uint32_t current)
{
    planes_ = std::move(planes);
    current_ = current;
    std::vector<PlaneOrientation> orientations;
    for (const NetPlane& plane : planes_) {
        orientations.push_back(plane.plane);
    }
    statistics_ =
        orientations.empty() ? std::nullopt : std::optional(orientationStatistics(orientations));
    update();
}

void StereonetPlot::setDiagram(Diagram diagram)
{
    diagram_ = diagram;
    update();
}

QSize StereonetPlot::sizeHint() const
{
    return {220, 220};
}

QSize StereonetPlot::minimumSizeHint() const
{
    return {110, 110};
}

std::optional<QPointF> StereonetPlot::placeOf(std::uint32_t id) const
{
    for (const NetPlane& plane : planes_) {
        if (plane.id == id) {
            return placeOn(circleIn(rect(), font()), netPoint(poleOf(plane.plane)));
        }
    }
    return std::nullopt;
}

void StereonetPlot::mousePressEvent(QMouseEvent* event)
{
    if (event->button() != Qt::LeftButton || diagram_ != Diagram::Stereonet) {
        QWidget::mousePressEvent(event);
        return;
    }
    const NetPlane* nearest = nullptr;
    double least = kReach;
    for (const NetPlane& plane : planes_) {
        const QPointF way = *placeOf(plane.id) - event->position();
        if (const double distance = std::hypot(way.x(), way.y()); distance <= least) {
            nearest = &plane;
            least = distance;
        }
    }
    if (nearest != nullptr) {
        Q_EMIT planeChosen(nearest->id);
    }
}

void StereonetPlot::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    draw(painter, rect(),
         {.paper = palette().color(QPalette::Base),
          .ink = palette().color(QPalette::Text),
          .faint = palette().color(QPalette::PlaceholderText),
          .highlight = palette().color(QPalette::Highlight)});
}

void StereonetPlot::draw(QPainter& painter, const QRectF& area, const Colors& colors) const
{
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF circle = circleIn(area, painter.font());
    drawFrame(painter, circle, colors);
    diagram_ == Diagram::Stereonet ? drawNet(painter, circle, colors)
                                   : drawRose(painter, circle, colors);
}

void StereonetPlot::drawFrame(QPainter& painter, const QRectF& circle, const Colors& colors) const
{
    painter.setPen(QPen(colors.ink, 1.2));
    painter.setBrush(colors.paper);
    painter.drawEllipse(circle);
    const double radius = 0.5 * circle.width();
    for (int i = 0; i < 36; ++i) {
        const double angle = i * std::numbers::pi / 18.0;
        const QPointF way(std::sin(angle), -std::cos(angle));
        const double inner = radius - (i % 9 == 0 ? kTick : 0.5 * kTick);
        painter.drawLine(circle.center() + way * inner, circle.center() + way * radius);
    }
    const double letter = QFontMetricsF(painter.font()).height();
    //: North, on diagrams
    painter.drawText(
        QRectF(circle.center().x() - letter, circle.top() - letter - 1.0, 2.0 * letter, letter),
        Qt::AlignCenter, tr("N"));
    painter.setPen(QPen(colors.faint, 1.0));
    painter.drawLine(circle.center() - QPointF(kTick, 0.0), circle.center() + QPointF(kTick, 0.0));
    painter.drawLine(circle.center() - QPointF(0.0, kTick), circle.center() + QPointF(0.0, kTick));
}

void StereonetPlot::drawNet(QPainter& painter, const QRectF& circle, const Colors& colors) const
{
    painter.setBrush(Qt::NoBrush);
    for (const bool is_current : {false, true}) { // the current one over the others
        const QColor color = is_current ? colors.highlight : colors.ink;
        for (const NetPlane& plane : planes_) {
            if ((plane.id == current_) != is_current) {
                continue;
            }
            QColor line = color;
            line.setAlphaF(is_current ? 1.0F : 0.55F);
            painter.setPen(QPen(line, is_current ? 1.8 : 1.0));
            painter.drawPath(lineOn(circle, greatCircle(plane.plane)));
            painter.setPen(QPen(line, 1.0, Qt::DashLine));
            for (const auto& piece : plane.ellipse) {
                painter.drawPath(lineOn(circle, piece));
            }
            painter.setPen(Qt::NoPen);
            painter.setBrush(color);
            painter.drawEllipse(placeOn(circle, netPoint(poleOf(plane.plane))), kPoleRadius,
                                kPoleRadius);
            painter.setBrush(Qt::NoBrush);
        }
    }
    if (statistics_ && statistics_->count > 1) {
        const QPointF mean = placeOn(circle, netPoint(poleOf(statistics_->mean)));
        painter.setPen(QPen(colors.ink, 1.6));
        painter.drawEllipse(mean, 2.0 * kPoleRadius, 2.0 * kPoleRadius);
        painter.setPen(QPen(colors.ink, 1.6, Qt::DotLine));
        painter.drawPath(lineOn(circle, greatCircle(statistics_->mean)));
    }
}

void StereonetPlot::drawRose(QPainter& painter, const QRectF& circle, const Colors& colors) const
{
    std::vector<PlaneOrientation> orientations;
    for (const NetPlane& plane : planes_) {
        orientations.push_back(plane.plane);
    }
    const std::vector<double> rose = strikeRose(orientations, kSectors);
    const double most = *std::max_element(rose.begin(), rose.end());
    if (!(most > 0.0)) {
        return;
    }
    QColor fill = colors.highlight;
    fill.setAlphaF(0.7F);
    painter.setBrush(fill);
    painter.setPen(QPen(colors.ink, 0.8));
    const double step_deg = 360.0 / static_cast<double>(kSectors);
    for (std::size_t i = 0; i < kSectors; ++i) {
        // Areas are as the shares.
        const double radius = 0.5 * circle.width() * std::sqrt(rose[i] / most);
        if (radius > 0.0) {
            const QRectF box(circle.center() - QPointF(radius, radius),
                             QSizeF(2.0 * radius, 2.0 * radius));
            const double from_east_deg = 90.0 - static_cast<double>(i + 1) * step_deg;
            painter.drawPie(box, qRound(16.0 * from_east_deg), qRound(16.0 * step_deg));
        }
    }
}

QSize StereonetPlot::pictureSize()
{
    return {kPictureSide, kPictureSide};
}

bool StereonetPlot::savePicture(const QString& path) const
{
    const Colors colors{
        .paper = Qt::white, .ink = Qt::black, .faint = Qt::gray, .highlight = QColor(176, 58, 30)};
    const QString suffix = QFileInfo(path).suffix().toLower();
    const QRect page(0, 0, kPictureSide, kPictureSide);
    if (suffix == QStringLiteral("svg")) {
        QSvgGenerator file;
        file.setFileName(path);
        file.setSize(page.size());
        file.setViewBox(page);
        file.setTitle(tr("Stereonet"));
        QPainter painter;
        if (!painter.begin(&file)) {
            return false;
        }
        painter.setFont(font());
        draw(painter, page, colors);
        return painter.end();
    }
    if (suffix == QStringLiteral("pdf")) {
        QPdfWriter file(path);
        constexpr int kPointsPerInch = 72;
        file.setResolution(kPointsPerInch);
        file.setPageSize(QPageSize(QSizeF(page.size()), QPageSize::Point));
        file.setPageMargins(QMarginsF());
        QPainter painter;
        if (!painter.begin(&file)) {
            return false;
        }
        painter.setFont(font());
        draw(painter, page, colors);
        return painter.end();
    }
    QImage image(page.size() * kPngScale, QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    painter.scale(kPngScale, kPngScale);
    painter.setFont(font());
    draw(painter, page, colors);
    painter.end();
    return image.save(path);
}

} // namespace marsview
