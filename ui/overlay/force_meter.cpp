#include "ui/overlay/force_meter.h"

#include "ui/text/haptics_text.h"
#include "ui/text/overlay_text.h"
#include "ui/widgets/plate.h"

#include <QFontMetrics>
#include <QPainter>
#include <QPainterPath>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kBarWidth = 110;
constexpr int kBarHeight = 8;
constexpr int kGap = 8;

// The little picture of space: seen obliquely from the user's side.
constexpr double kDepthShown = 0.45;
constexpr double kHeightShown = 0.9;
constexpr double kRimShown = 0.85;

// Forces weaker than this share of the largest have no direction worth showing.
constexpr double kDirectionFrom = 0.01;

} // namespace

ForceMeter::ForceMeter(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Force"));
    setAccessibleDescription(tr("Force of the terrain on the stylus"));
}

void ForceMeter::setForce(const Vec3& force_n, double force_n_max)
{
    const Vec3 force = isFinite(force_n) ? force_n : Vec3{};
    const double most = force_n_max > 0.0 && std::isfinite(force_n_max) ? force_n_max : 1.0;
    if (is_in_use_ && force == force_n_ && most == force_n_max_) {
        return;
    }
    const QSize room = sizeHint();
    force_n_ = force;
    force_n_max_ = most;
    is_in_use_ = true;
    const QString spoken = spokenText();
    if (spoken != accessibleName()) {
        setAccessibleName(spoken);
    }
    if (sizeHint() != room) {
        updateGeometry();
        Q_EMIT roomChanged();
    }
    update();
}

void ForceMeter::release()
{
    if (is_in_use_) {
        is_in_use_ = false;
        force_n_ = {};
        setAccessibleName(tr("Force"));
        Q_EMIT roomChanged();
    }
}

QString ForceMeter::text() const
{
    return forceText(length(force_n_), force_n_max_);
}

QString ForceMeter::spokenText() const
{
    //: %1 is a force, for example "1.2 N", coarse enough not to change all the time
    constexpr double kCoarser = 10.0; // one decimal less
    return tr("Force %1").arg(forceText(length(force_n_), kCoarser * force_n_max_));
}

QSize ForceMeter::sizeHint() const
{
    if (!is_in_use_) {
        return {0, 0};
    }
    const QFontMetrics metrics(font());
    const int number = metrics.horizontalAdvance(forceText(force_n_max_, force_n_max_));
    const int space = metrics.height() * 9 / 4;
    return {space + kGap + kBarWidth + kGap + number + 2 * kPlatePadding,
            space + 2 * (kPlatePadding - 3)};
}

void ForceMeter::paintEvent(QPaintEvent* /*event*/)
{
    if (!is_in_use_) {
        return;
    }
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    drawPlate(painter, rect());
    const QFontMetrics metrics(font());
    const QRect inside = rect().adjusted(kPlatePadding, 0, -kPlatePadding, 0);
    const auto placed = [&](const QRect& r) {
        return QStyle::visualRect(layoutDirection(), inside, r);
    };
    const double share = std::min(1.0, length(force_n_) / force_n_max_);
    const QColor color = share >= 1.0 ? QColor(255, 179, 71) : QColor(112, 196, 255);

    // Space is not mirrored: right is right in every language.
    const int side = metrics.height() * 9 / 4;
    const QRectF space = placed({inside.left(), (height() - side) / 2, side, side});
    const double reach = side / 2.0 - 2.0;
    const QPointF middle = space.center() + QPointF(0.0, reach * 0.2);
    painter.setPen(QPen(overlayFaintColor(), 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(middle, reach * kRimShown, reach * kRimShown * kDepthShown);
    if (share > kDirectionFrom) {
        const Vec3 u = normalized(force_n_);
        const QPointF tip = QPointF(u.x, -u.y * kDepthShown - u.z * kHeightShown) * reach;
        const double shown = std::hypot(tip.x(), tip.y());
        painter.setPen(QPen(color, 2.0, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(middle, middle + tip);
        if (shown > 4.0) {
            const QPointF along = tip / shown;
            const QPointF aside(-along.y(), along.x());
            painter.setPen(Qt::NoPen);
            painter.setBrush(color);
            painter.drawPolygon(QPolygonF{middle + tip + along * 2.0,
                                          middle + tip - along * 5.0 + aside * 3.5,
                                          middle + tip - along * 5.0 - aside * 3.5});
        }
    } else {
        painter.setPen(Qt::NoPen);
        painter.setBrush(overlayFaintColor());
        painter.drawEllipse(middle, 2.0, 2.0);
    }

    const QRect bar =
        placed({inside.left() + side + kGap, (height() - kBarHeight) / 2, kBarWidth, kBarHeight});
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(255, 255, 255, 50));
    painter.drawRoundedRect(bar, kBarHeight / 2.0, kBarHeight / 2.0);
    QRectF filled = bar;
    filled.setWidth(bar.width() * share);
    if (isRightToLeft()) {
        filled.moveRight(bar.right() + 1);
    }
    painter.save();
    QPainterPath outline;
    outline.addRoundedRect(bar, kBarHeight / 2.0, kBarHeight / 2.0);
    painter.setClipPath(outline);
    painter.fillRect(filled, color);
    painter.restore();

    const int number_left = inside.left() + side + kGap + kBarWidth + kGap;
    const Qt::Alignment trailing =
        QStyle::visualAlignment(layoutDirection(), Qt::AlignRight) | Qt::AlignVCenter;
    drawText(painter, placed({number_left, 0, inside.right() + 1 - number_left, height()}),
             trailing, text());
}

} // namespace marsview
