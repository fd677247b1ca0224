#include "ui/commands/stretch_control.h"

#include "ui/controllers/histogram_maker.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/stretch_dialog.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>

#include <algorithm>

namespace marsview {
namespace {

// In the map, where the dialog hides little of it.
constexpr QPoint kDialogCorner(12, 12);

} // namespace

StretchControl::StretchControl(SessionController& session,
                               const WindowActions& actions,
                               const QWidget& map,
                               QWidget* parent)
    : QObject(parent)
    , session_(session)
    , actions_(actions)
    , map_(map)
    , histograms_(new HistogramMaker(this))
    , dialog_(new StretchDialog(parent))
{
    connect(actions.stretch_group, &QActionGroup::triggered, this,
            [this](QAction* action) { choose(static_cast<StretchKind>(action->data().toInt())); });
    const auto stretch_to_view = [this] { session_.stretchToView(session_.session().active); };
    connect(actions.stretch_to_view, &QAction::triggered, this, stretch_to_view);
    connect(actions.edit_stretch, &QAction::triggered, this, &StretchControl::open);
    connect(dialog_, &StretchDialog::stretchRequested, this, [this](const ColorStretch& stretch) {
        session_.setStretch(session_.session().active, stretch);
    });
    connect(dialog_, &StretchDialog::stretchDragged, this, [this](const ColorStretch& stretch) {
        session_.setStretch(session_.session().active, stretch, ChangeKind::OfDrag);
    });
    connect(dialog_, &StretchDialog::slopesRequested, this,
            [this](const std::optional<SlopeRange>& slopes) {
                session_.setSlopeRange(session_.session().active, slopes);
            });
    connect(dialog_, &StretchDialog::slopesDragged, this, [this](const SlopeRange& slopes) {
        session_.setSlopeRange(session_.session().active, slopes, ChangeKind::OfDrag);
    });
    connect(dialog_, &StretchDialog::dragEnded, &session_, &SessionController::endDrag);
    connect(dialog_, &StretchDialog::stretchToViewRequested, this, stretch_to_view);
    connect(&session_, &SessionController::sessionChanged, this, &StretchControl::show);
    connect(&session_, &SessionController::sceneChanged, this, &StretchControl::show);
    connect(histograms_, &HistogramMaker::made, this, &StretchControl::show);
    show();
}

void StretchControl::setHeightUnit(HeightUnit unit)
{
    dialog_->setHeightUnit(unit);
}

void StretchControl::open()
{
    if (!is_placed_) {
        is_placed_ = true;
        dialog_->move(
            map_.mapToGlobal(kDialogCorner)); // afterwards it reopens at its last position
    }
    dialog_->show();
    dialog_->raise();
    dialog_->activateWindow();
    show();
}

void StretchControl::choose(StretchKind kind)
{
    const Layer* layer = activeLayer(session_.session());
    if (layer == nullptr) {
        return;
    }
    if (session_.session().look.mode == ShadingMode::Slope) {
        session_.setSlopeRange(layer->id, kind == StretchKind::Fixed
                                              ? std::optional(session_.slopeRangeOf(*layer))
                                              : std::nullopt);
        if (kind == StretchKind::Fixed) {
            open();
            dialog_->edit(kind);
        }
        return;
    }
    ColorStretch stretch = layer->stretch;
    const HeightRange now = session_.stretchedRangeOf(*layer);
    if (kind != StretchKind::Fixed || isStretchRange(now.minimum_m, now.maximum_m)) {
        stretch.kind = kind;
        if (kind == StretchKind::Fixed) {
            stretch.low = now.minimum_m;
            stretch.high = now.maximum_m;
        }
        session_.setStretch(layer->id, stretch);
    }
    if (kind == StretchKind::Percentile || kind == StretchKind::Fixed) {
        open();
        dialog_->edit(kind);
    }
}

bool StretchControl::isInScene() const
{
    const Layer* layer = activeLayer(session_.session());
    return layer != nullptr && session_.isInScene(*layer);
}

void StretchControl::show()
{
    actions_.showStretchToView(activeLayer(session_.session()) != nullptr, isInScene());
    if (!dialog_->isVisible()) {
        return;
    }
    const Layer* layer = activeLayer(session_.session());
    if (layer == nullptr) {
        dialog_->setContent({});
        return;
    }
    const bool is_slope = session_.session().look.mode == ShadingMode::Slope;
    dialog_->setContent(
        {.layer = QString::fromStdString(layer->name),
         .stretch = layer->stretch,
         .stretched = session_.stretchedRangeOf(*layer),
         .all = layer->map->heightfield().range().value_or(HeightRange{}),
         .ramp = &rampOf(*layer),
         .histogram = histograms_->find(layer->map),
         .is_in_picture = isInScene(),
         .slopes = is_slope ? std::optional(session_.slopeRangeOf(*layer)) : std::nullopt,
         .are_slopes_chosen = layer->slope_range.has_value(),
         .slope_histogram = is_slope ? layer->map->slopes() : SlopeHistogram{}});
}

} // namespace marsview
