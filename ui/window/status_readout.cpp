#include "ui/window/status_readout.h"

#include "core/session/map.h"
#include "ui/widgets/coordinate_field.h"
#include "ui/widgets/coordinate_menu.h"
#include "ui/widgets/reserved_label.h"

#include <QAction>
#include <QFontMetrics>
#include <QFrame>
#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <cmath>
#include <initializer_list>

namespace marsview {
namespace {

constexpr int kPartGap = 8;             // between all parts, in pixels
constexpr double kDetailLeastPx = 0.05; // less is 0.0 in the text
constexpr int kNameWidthMax = 150;      // pixels at which a long CRS name is elided

QString outsideText()
{
    //: In place of a coordinate: nothing of the map is pointed at
    return StatusReadout::tr("outside the map");
}

QString sourceName(ReadingSource source)
{
    switch (source) {
    case ReadingSource::Stylus:
        //: Before a coordinate: the place under the stylus of a haptic device
        return StatusReadout::tr("Stylus");
    case ReadingSource::Crosshair:
        //: Before a coordinate: the place in the middle of the picture
        return StatusReadout::tr("Center");
    case ReadingSource::Pointer:
        break;
    }
    //: Before a coordinate: the place under the mouse pointer
    return StatusReadout::tr("Pointer");
}

// As wide as the longest name of a source.
QString longestSource(const QFontMetrics& metrics)
{
    QString longest;
    for (const ReadingSource source :
         {ReadingSource::Pointer, ReadingSource::Stylus, ReadingSource::Crosshair}) {
        const QString name = sourceName(source);
        if (metrics.horizontalAdvance(name) > metrics.horizontalAdvance(longest)) {
            longest = name;
        }
    }
    return longest;
}

// A thin line between two parts of the readout.
QWidget* makeRule(QWidget* parent)
{
    auto* rule = new QFrame(parent);
    rule->setFrameShape(QFrame::VLine);
    rule->setFrameShadow(QFrame::Plain);
    rule->setForegroundRole(QPalette::Mid);
    rule->setFixedHeight(parent->fontMetrics().height());
    return rule;
}

} // namespace

StatusReadout::StatusReadout(QWidget* parent)
    : QWidget(parent)
    , source_(new ReservedLabel(longestSource(fontMetrics()), this))
    , coordinate_(new CoordinateField(this))
    , format_button_(new QToolButton(this))
    , height_(new ReservedLabel({}, this))
    , detail_(new ReservedLabel(leftToRight(tr("detail %1 px").arg(QStringLiteral("00.0"))), this))
    , height_rule_(makeRule(this))
    , detail_rule_(makeRule(this))
{
    source_->setAccessibleName(tr("Source of the position"));
    source_->setObjectName(QStringLiteral("readingSource"));
    source_->setForegroundRole(QPalette::PlaceholderText);
    coordinate_->setAccessibleName(tr("Position under the pointer, the stylus or the crosshair"));
    coordinate_->setAccessibleDescription(tr("Ctrl+C copies it"));
    coordinate_->setObjectName(QStringLiteral("coordinates"));
    height_->setAccessibleName(tr("Elevation under the pointer, the stylus or the crosshair"));
    height_->setObjectName(QStringLiteral("elevation"));
    detail_->setAccessibleName(tr("Largest error of the picture"));
    format_button_->setObjectName(QStringLiteral("coordinateFormat"));
    format_button_->setAccessibleName(tr("Coordinate format"));
    format_button_->setToolTip(tr("Coordinate format"));
    format_button_->setPopupMode(QToolButton::InstantPopup);
    format_button_->setAutoRaise(true);
    auto* menu = new QMenu(format_button_);
    format_button_->setMenu(menu);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        fillMenu(*menu);
    });
    coordinate_->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(coordinate_, &QWidget::customContextMenuRequested, this, [this, menu](QPoint position) {
        if (scene_) {
            menu->popup(coordinate_->mapToGlobal(position));
        }
    });
    connect(coordinate_, &CoordinateField::copyRequested, this, [this] {
        if (copy_action_ != nullptr) {
            copy_action_->trigger();
        }
    });
    connect(coordinate_, &CoordinateField::focusChanged, this, &StatusReadout::focusChanged);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(kPartGap, 0, kPartGap, 0);
    layout->setSpacing(kPartGap);
    layout->addWidget(source_);
    layout->addWidget(coordinate_);
    layout->addWidget(format_button_);
    layout->addWidget(height_rule_);
    layout->addWidget(height_);
    layout->addWidget(detail_rule_);
    layout->addWidget(detail_);
    layout->addStretch(1);
    setSource(ReadingSource::Pointer);
    setMaps(nullptr, nullptr);
}

void StatusReadout::setMaps(const std::shared_ptr<const Map>& scene,
                            const std::shared_ptr<const Map>& active)
{
    if (scene != scene_) {
        place_.reset();
        is_place_known_ = false;
    }
    if (!scene || !scene_) {
        detail_px_.reset(); // that of a picture without a map
    }
    const auto set = [](const std::shared_ptr<const Map>& map, std::shared_ptr<const Map>& kept,
                        std::optional<ClosedSurface>& surface) {
        if (map != kept) {
            kept = map;
            surface.reset();
            if (map) {
                surface.emplace(map->georeference(), map->heightfield());
            }
        }
    };
    set(scene, scene_, scene_surface_);
    set(active, active_, active_surface_);
    for (QWidget* part : std::initializer_list<QWidget*>{
             source_, coordinate_, format_button_, height_rule_, height_, detail_rule_, detail_}) {
        part->setVisible(scene_ != nullptr);
    }
    reserveWidths();
    showDetail();
    refresh();
    layout()->activate(); // the first picture of a map may take longer than to the next event
}

void StatusReadout::setPlace(const std::optional<ReadPlace>& place)
{
    place_ = place;
    is_place_known_ = true;
    refresh();
}

void StatusReadout::setSource(ReadingSource source)
{
    source_->setWholeText(sourceName(source));
}

void StatusReadout::setFormat(const CoordinateFormat& format)
{
    format_ = format;
    reserveWidths();
    refresh();
}

void StatusReadout::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    reserveWidths();
    refresh();
}

void StatusReadout::setDetail(double pixels)
{
    detail_px_ = pixels;
    showDetail();
}

void StatusReadout::setLoading(bool is_loading)
{
    is_loading_ = is_loading;
    showDetail();
}

void StatusReadout::setProblem(const QString& problem)
{
    has_problem_ = !problem.isEmpty();
    showDetail();
}

// The error of a preview is not measured yet.
void StatusReadout::showDetail()
{
    const bool is_drawn = detail_px_.has_value();
    if (is_loading_ || has_problem_ || !is_drawn) {
        detail_->setWholeText(
            //: Shown instead of the error of the picture: pieces are on their way
            is_loading_ || !is_drawn ? tr("loading…")
                                     //: The same: pieces of it cannot be read
                                     : tr("incomplete"));
        return;
    }
    detail_->setWholeText(
        scene_ && scene_->isPreview()
            //: Shown instead of the error of the picture
            ? tr("preview")
            : *detail_px_ < kDetailLeastPx
                  //: Shown instead of the error of the picture: it has none
                  ? tr("full detail")
                  //: How far the picture may be from the full map, in pixels
                  : leftToRight(tr("detail %1 px").arg(numberText(*detail_px_, 1))));
}

QString StatusReadout::sourceLabel() const
{
    return source_->wholeText();
}

QString StatusReadout::coordinateLabel() const
{
    return coordinate_->wholeText();
}

QString StatusReadout::heightLabel() const
{
    return height_->wholeText();
}

QString StatusReadout::detailLabel() const
{
    return detail_->wholeText();
}

QString StatusReadout::plainPosition() const
{
    return scene_ && place_
               ? plainPositionText(format_, *scene_, place_->hit.grid, place_->screen_pixel_m)
               : QString();
}

void StatusReadout::fillMenu(QMenu& menu)
{
    if (!scene_) {
        return;
    }
    fillCoordinateMenu(menu, format_, scene_->info(),
                       [this](const CoordinateFormat& format) { Q_EMIT formatChosen(format); });
    if (copy_action_ != nullptr) {
        menu.addSeparator();
        menu.addAction(copy_action_);
    }
}

// As wide as the longest text on this map, so that nothing moves while numbers change.
void StatusReadout::reserveWidths()
{
    if (!scene_) {
        return;
    }
    const QFontMetrics metrics(font());
    const auto keep_longer = [&metrics](QString& kept, const QString& other) {
        if (metrics.horizontalAdvance(other) > metrics.horizontalAdvance(kept)) {
            kept = other;
        }
    };
    const Georeference& georeference = scene_->georeference();
    const double last_column = static_cast<double>(georeference.columns() - 1);
    const double last_row = static_cast<double>(georeference.rows() - 1);
    QString longest = outsideText();
    for (const GridPoint grid :
         {GridPoint{0.0, 0.0}, GridPoint{last_column, 0.0}, GridPoint{0.0, last_row},
          GridPoint{last_column, last_row}, GridPoint{last_column / 2.0, last_row / 2.0}}) {
        keep_longer(longest, positionText(format_, *scene_, grid));
    }
    coordinate_->setLongest(longest + QStringLiteral("000")); // digits differ in number and width
    QString highest;
    for (const auto& map : {scene_, active_}) {
        if (map) {
            const HeightRange range = map->heightfield().range().value_or(HeightRange{});
            keep_longer(highest, heightText(map->info(), range, range.minimum_m, unit_));
            keep_longer(highest, heightText(map->info(), range, range.maximum_m, unit_));
        }
    }
    height_->setLongest(tr("≈ %1").arg(highest) + QLatin1Char('0'));
    format_button_->setText(
        metrics.elidedText(formatName(format_, scene_->info()), Qt::ElideMiddle, kNameWidthMax));
}

StatusReadout::ReadHeight StatusReadout::heightAt(const RayHit& hit) const
{
    const auto read = [this](const Map& map, const ClosedSurface& surface, GridPoint grid,
                             double height_m) {
        const Heightfield& heightfield = map.heightfield();
        const bool is_exact = surface.isExact(grid);
        if (heightfield.isTiled() && is_exact) {
            height_m = surface.height(grid); // the ray may have come a moment too early
        }
        if (std::isnan(height_m)) {
            //: In place of an elevation: the map has none there
            return ReadHeight{.text = tr("no data"), .why_rough = {}};
        }
        ReadHeight height{.text =
                              heightText(map.info(), heightfield.range().value_or(HeightRange{}),
                                         height_m, unit_)};
        if (map.isPreview()) {
            height.why_rough = tr("Read from a preview; exact once the overviews are built");
        } else if (!is_exact) {
            height.why_rough = tr("Read from a coarser level; the samples here are being read");
        }
        return height;
    };
    if (active_ && active_ != scene_) {
        const GridPoint grid = active_->georeference().toGrid(hit.grid, scene_->georeference());
        const double height_m = active_->heightfield().heightNow(grid);
        if (std::isfinite(height_m)) {
            return read(*active_, *active_surface_, grid, height_m);
        }
    }
    return read(*scene_, *scene_surface_, hit.grid, hit.height_m);
}

void StatusReadout::refresh()
{
    if (!scene_ || !place_) {
        coordinate_->showText(scene_ && is_place_known_ ? outsideText() : QString(), false);
        height_->setWholeText({});
        height_->setHint({});
        return;
    }
    coordinate_->showText(positionText(format_, *scene_, place_->hit.grid, place_->screen_pixel_m),
                          true);
    const ReadHeight height = heightAt(place_->hit);
    height_->setHint(height.why_rough);
    height_->setWholeText(height.why_rough.isEmpty() ? height.text
                                                     //: An elevation that is not exact yet
                                                     : leftToRight(tr("≈ %1").arg(height.text)));
}

} // namespace marsview
