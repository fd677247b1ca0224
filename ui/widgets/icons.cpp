#include "ui/widgets/icons.h"

#include "core/base/check.h"

#include <QFile>
#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QSvgRenderer>

#include <optional>

// At namespace scope, as Qt's macro has to be used.
static void initIcons()
{
    Q_INIT_RESOURCE(icons);
}

namespace marsview {
namespace {

QString lineFile(const QString& name)
{
    initIcons();
    return QStringLiteral(":/marsview/line/%1.svg").arg(name);
}

// Draws a file whose lines have the color "currentColor".
class LineIconEngine final : public QIconEngine {
public:
    LineIconEngine(QByteArray svg, std::optional<QColor> color)
        : svg_(std::move(svg))
        , color_(color)
    {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override
    {
        QByteArray svg = svg_;
        svg.replace("currentColor", colorFor(mode).name().toLatin1());
        QSvgRenderer renderer(svg);
        painter->setRenderHint(QPainter::Antialiasing);
        renderer.render(painter, rect);
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override
    {
        QPixmap pixmap(size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paint(&painter, QRect(QPoint(), size), mode, state);
        return pixmap;
    }

    QIconEngine* clone() const override { return new LineIconEngine(svg_, color_); }

private:
    QColor colorFor(QIcon::Mode mode) const
    {
        const QPalette palette = QGuiApplication::palette();
        switch (mode) {
        case QIcon::Disabled:
            return palette.color(QPalette::Disabled, QPalette::ButtonText);
        case QIcon::Selected:
            return palette.color(QPalette::Active, QPalette::HighlightedText);
        case QIcon::Normal:
        case QIcon::Active:
            break;
        }
        return color_.value_or(palette.color(QPalette::Active, QPalette::ButtonText));
    }

    QByteArray svg_;
    std::optional<QColor> color_; // none: the palette's
};

QIcon iconOf(const QString& name, std::optional<QColor> color)
{
    QFile file(lineFile(name));
    MARSVIEW_CHECK(file.open(QIODevice::ReadOnly));
    return QIcon(new LineIconEngine(file.readAll(), color));
}

} // namespace

QIcon lineIcon(const QString& name)
{
    return iconOf(name, std::nullopt);
}

QIcon lineIcon(const QString& name, const QColor& color)
{
    return iconOf(name, color);
}

QIcon swatch(const QColor& color, int side)
{
    QPixmap pixmap(side, side);
    pixmap.fill(color);
    return pixmap;
}

QIcon programIcon()
{
    initIcons();
    QSvgRenderer renderer(QStringLiteral(":/marsview/program.svg"));
    QIcon icon;
    for (const int side : {16, 24, 32, 48, 64, 128, 256}) {
        QPixmap pixmap(side, side);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        renderer.render(&painter, QRectF(0.0, 0.0, side, side));
        icon.addPixmap(pixmap);
    }
    return icon;
}

} // namespace marsview
