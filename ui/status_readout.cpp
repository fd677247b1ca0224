#include "ui/status_readout.h"

#include "core/session/dataset.h"

#include <QActionGroup>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>

#include <algorithm>

namespace marsview {
namespace {

constexpr int kDisplayNameWidth = 220; // pixels at which a long CRS name is cut short

} // namespace

StatusReadout::StatusReadout(QWidget* parent)
    : QWidget(parent)
    , coordinate_(new QLabel(this))
    , display_button_(new QToolButton(this))
    , display_group_(new QActionGroup(this))
    , height_(new QLabel(this))
{
    coordinate_->setAccessibleName(tr("Position under the pointer"));
    height_->setAccessibleName(tr("Height under the pointer"));
    display_button_->setAccessibleName(tr("Coordinate system of the position"));
    display_button_->setToolTip(tr("In which terms positions are shown"));
    display_button_->setPopupMode(QToolButton::InstantPopup);
    display_button_->setAutoRaise(true);
    display_button_->setMenu(new QMenu(display_button_));
    coordinate_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    height_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    // Wide enough for the longest that is usual, so that nothing moves while the numbers change.
    const QFontMetrics metrics(font());
    coordinate_->setMinimumWidth(
        metrics.horizontalAdvance(QStringLiteral("−00,000,000.0, −00,000,000.0 m")));
    height_->setMinimumWidth(metrics.horizontalAdvance(QStringLiteral("−00,000.0 m above areoid")));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(6, 0, 6, 0);
    layout->setSpacing(4);
    layout->addWidget(coordinate_);
    layout->addWidget(display_button_);
    layout->addSpacing(16);
    layout->addWidget(height_);
    layout->addStretch(1);
    setDataset(nullptr);
}

void StatusReadout::setDataset(const std::shared_ptr<const Dataset>& dataset)
{
    dataset_ = dataset;
    hit_.reset();
    display_button_->setVisible(dataset_ != nullptr);
    if (dataset_) {
        const auto displays = coordinateDisplays(dataset_->info());
        if (std::find(displays.begin(), displays.end(), display_) == displays.end() ||
            display_ == CoordinateDisplay::Map) {
            display_ = displays.front();
        }
        fillMenu();
    }
    refresh();
}

void StatusReadout::setHit(const std::optional<RayHit>& hit)
{
    hit_ = hit;
    refresh();
}

void StatusReadout::setDisplay(CoordinateDisplay display)
{
    display_ = display;
    fillMenu();
    refresh();
}

QString StatusReadout::coordinateLabel() const
{
    return coordinate_->text();
}

QString StatusReadout::heightLabel() const
{
    return height_->text();
}

void StatusReadout::fillMenu()
{
    QMenu* menu = display_button_->menu();
    menu->clear();
    for (const CoordinateDisplay display : coordinateDisplays(dataset_->info())) {
        const QString name = displayName(display, dataset_->info());
        const QString text = display == CoordinateDisplay::Map
                                 ? tr("Map: %1").arg(name)
                                 : tr("Longitude and latitude, %1").arg(name);
        QAction* action = menu->addAction(text);
        action->setCheckable(true);
        action->setChecked(display == display_);
        display_group_->addAction(action);
        connect(action, &QAction::triggered, this, [this, display] { setDisplay(display); });
    }
    const QString name = displayName(display_, dataset_->info());
    display_button_->setText(fontMetrics().elidedText(name, Qt::ElideMiddle, kDisplayNameWidth));
}

void StatusReadout::refresh()
{
    if (!dataset_ || !hit_) {
        coordinate_->setText(dataset_ ? QStringLiteral("–") : QString());
        height_->setText({});
        return;
    }
    const RasterInfo& info = dataset_->info();
    coordinate_->setText(coordinateText(display_, info, dataset_->georeference(), hit_->grid));
    height_->setText(
        heightText(info, dataset_->heightfield().range().value_or(HeightRange{}), hit_->height_m));
}

} // namespace marsview
