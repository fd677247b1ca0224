#include "ui/status_readout.h"

#include "core/session/dataset.h"
#include "ui/reserved_label.h"

#include <QActionGroup>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kDisplayNameWidth = 150; // pixels at which a long CRS name is cut short

// A place of the scene on the grid of another map in the same CRS.
GridPoint onGridOf(const Dataset& dataset, const Dataset& scene, GridPoint grid)
{
    if (&dataset == &scene) {
        return grid;
    }
    if (const auto place = scene.georeference().toGeographic(grid)) {
        if (const auto there = dataset.georeference().toGrid(*place)) {
            return *there; // the right turn of longitude
        }
    }
    return dataset.georeference().toGrid(scene.georeference().toMap(grid));
}

} // namespace

StatusReadout::StatusReadout(QWidget* parent)
    : QWidget(parent)
    , coordinate_(new ReservedLabel(QStringLiteral("−00,000,000.0, −00,000,000.0 m"), this))
    , toggle_button_(new QToolButton(this))
    , display_button_(new QToolButton(this))
    , display_group_(new QActionGroup(this))
    , height_(new ReservedLabel(QStringLiteral("−00,000.0 m above areoid"), this))
    , detail_(new ReservedLabel(tr("detail %1 px").arg(QStringLiteral("00.0")), this))
{
    coordinate_->setAccessibleName(tr("Position under the pointer"));
    height_->setAccessibleName(tr("Height under the pointer"));
    detail_->setAccessibleName(tr("Largest error of the picture"));
    toggle_button_->setText(QStringLiteral("⇄"));
    toggle_button_->setObjectName(QStringLiteral("toggleDisplay"));
    toggle_button_->setAutoRaise(true);
    toggle_button_->setAccessibleName(tr("Switch between map and geographic coordinates"));
    toggle_button_->setToolTip(tr("Switch between map coordinates and latitude and longitude"));
    display_button_->setAccessibleName(tr("Coordinate system of the position"));
    display_button_->setToolTip(tr("In which terms positions are shown"));
    display_button_->setPopupMode(QToolButton::InstantPopup);
    display_button_->setAutoRaise(true);
    display_button_->setMenu(new QMenu(display_button_));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(6, 0, 6, 0);
    layout->setSpacing(4);
    layout->addWidget(coordinate_);
    layout->addWidget(toggle_button_);
    layout->addWidget(display_button_);
    layout->addSpacing(8);
    layout->addWidget(height_);
    layout->addSpacing(8);
    layout->addWidget(detail_);
    layout->addStretch(1);
    connect(toggle_button_, &QToolButton::clicked, this, [this] {
        toggleDisplay();
        Q_EMIT displayChosen(display_);
    });
    setDatasets(nullptr, nullptr);
}

void StatusReadout::setDatasets(const std::shared_ptr<const Dataset>& scene,
                                const std::shared_ptr<const Dataset>& active)
{
    if (scene != scene_) {
        hit_.reset();
    }
    scene_ = scene;
    active_ = active;
    display_button_->setVisible(scene_ != nullptr);
    toggle_button_->setVisible(scene_ != nullptr);
    detail_->setVisible(scene_ != nullptr);
    if (scene_) {
        const auto displays = coordinateDisplays(scene_->info());
        const bool has_wanted =
            std::find(displays.begin(), displays.end(), wanted_) != displays.end();
        display_ = is_display_wanted_ && has_wanted ? wanted_ : displays.front();
        toggle_button_->setEnabled(displays.size() > 1);
        fillMenu();
        reserveWidths();
    }
    showDetail();
    refresh();
}

void StatusReadout::setHit(const std::optional<RayHit>& hit)
{
    hit_ = hit;
    refresh();
}

void StatusReadout::setDisplay(CoordinateDisplay display)
{
    wanted_ = display;
    is_display_wanted_ = true;
    setDatasets(scene_, active_);
}

void StatusReadout::toggleDisplay()
{
    if (scene_) {
        setDisplay(display_ == CoordinateDisplay::Map ? coordinateDisplays(scene_->info()).front()
                                                      : CoordinateDisplay::Map);
    }
}

void StatusReadout::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    if (scene_) {
        reserveWidths();
    }
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

// How far a preview is from its map, nobody knows yet.
void StatusReadout::showDetail()
{
    if (is_loading_ || has_problem_) {
        detail_->setWholeText(
            //: In place of how far the picture may be from the full map: pieces are on their way
            is_loading_ ? tr("loading…")
                        //: The same: pieces of it cannot be read
                        : tr("incomplete"));
        return;
    }
    detail_->setWholeText(scene_ && scene_->isPreview()
                              //: In place of how far the picture may be from the full map
                              ? tr("preview")
                              //: How far the picture may be from the full map, in pixels
                              : tr("detail %1 px").arg(numberText(detail_px_, 1)));
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

void StatusReadout::fillMenu()
{
    QMenu* menu = display_button_->menu();
    menu->clear();
    int width = 0;
    const auto shortened = [this](const QString& name) {
        return fontMetrics().elidedText(name, Qt::ElideMiddle, kDisplayNameWidth);
    };
    for (const CoordinateDisplay display : coordinateDisplays(scene_->info())) {
        const QString name = displayName(display, scene_->info());
        const QString text = display == CoordinateDisplay::Map
                                 ? tr("Map: %1").arg(name)
                                 : tr("Latitude and longitude, %1").arg(name);
        QAction* action = menu->addAction(text);
        action->setCheckable(true);
        action->setChecked(display == display_);
        display_group_->addAction(action);
        connect(action, &QAction::triggered, this, [this, display] {
            setDisplay(display);
            Q_EMIT displayChosen(display);
        });
        width = std::max(width, fontMetrics().horizontalAdvance(shortened(name)));
    }
    display_button_->setText(shortened(displayName(display_, scene_->info())));
    display_button_->setFixedWidth(width + 28); // as wide in all terms, with the arrow
}

// As wide as anything that this map will show, so that nothing moves while the numbers change.
void StatusReadout::reserveWidths()
{
    const QFontMetrics metrics(font());
    QString longest = tr("pointer off the map");
    const auto keep_longer = [&metrics](QString& kept, const QString& other) {
        if (metrics.horizontalAdvance(other) > metrics.horizontalAdvance(kept)) {
            kept = other;
        }
    };
    const Georeference& georeference = scene_->georeference();
    const double last_column = static_cast<double>(georeference.columns() - 1);
    const double last_row = static_cast<double>(georeference.rows() - 1);
    for (const CoordinateDisplay display : coordinateDisplays(scene_->info())) {
        for (const GridPoint grid : {GridPoint{0.0, 0.0}, GridPoint{last_column, 0.0},
                                     GridPoint{0.0, last_row}, GridPoint{last_column, last_row}}) {
            keep_longer(longest, coordinateText(display, scene_->info(), georeference, grid));
        }
    }
    coordinate_->setLongest(longest + QStringLiteral("00")); // digits differ in width
    QString highest;
    for (const auto& dataset : {scene_, active_}) {
        if (dataset) {
            const HeightRange range = dataset->heightfield().range().value_or(HeightRange{});
            keep_longer(highest, heightText(dataset->info(), range, range.minimum_m, unit_));
            keep_longer(highest, heightText(dataset->info(), range, range.maximum_m, unit_));
        }
    }
    height_->setLongest(tr("≈ %1").arg(highest) + QLatin1Char('0'));
}

StatusReadout::ReadHeight StatusReadout::heightAt(const RayHit& hit) const
{
    const auto read = [this](const Dataset& dataset, GridPoint grid, double height_m) {
        const Heightfield& heightfield = dataset.heightfield();
        const bool is_exact = heightfield.isExact(grid);
        if (heightfield.isTiled() && is_exact) {
            height_m = heightfield.heightNow(grid); // the ray may have come a moment too early
        }
        ReadHeight height{.text = heightText(dataset.info(),
                                             heightfield.range().value_or(HeightRange{}), height_m,
                                             unit_)};
        if (dataset.isPreview()) {
            height.why_rough = tr("Read from a preview; exact once the map is prepared");
        } else if (!is_exact) {
            height.why_rough = tr("Read from a coarser level; the samples here are being read");
        }
        return height;
    };
    if (active_ && active_ != scene_) {
        const GridPoint grid = onGridOf(*active_, *scene_, hit.grid);
        const double height_m = active_->heightfield().heightNow(grid);
        if (std::isfinite(height_m)) {
            return read(*active_, grid, height_m);
        }
    }
    return read(*scene_, hit.grid, hit.height_m);
}

void StatusReadout::refresh()
{
    if (!scene_ || !hit_) {
        //: In place of a coordinate
        coordinate_->setWholeText(scene_ ? tr("pointer off the map") : QString());
        coordinate_->setEnabled(false);
        height_->setWholeText({});
        height_->setToolTip({});
        return;
    }
    coordinate_->setEnabled(true);
    coordinate_->setWholeText(
        coordinateText(display_, scene_->info(), scene_->georeference(), hit_->grid));
    const ReadHeight height = heightAt(*hit_);
    //: A height that is not quite sure yet
    height_->setWholeText(height.why_rough.isEmpty() ? height.text : tr("≈ %1").arg(height.text));
    height_->setToolTip(height.why_rough);
}

} // namespace marsview
