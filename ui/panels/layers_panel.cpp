#include "ui/panels/layers_panel.h"

#include "ui/panels/layer_delegate.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/vector_file_list.h"
#include "ui/text/core_text.h"
#include "ui/text/ramp_text.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListView>
#include <QLocale>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStackedLayout>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include <chrono>

namespace marsview {
namespace {

QToolButton* makeButton(QAction* action, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

// After the last change of a number that is stepped or dragged.
constexpr std::chrono::milliseconds kFeatherDelay{300};

} // namespace

LayersPanel::LayersPanel(const LayerActions& actions, QWidget* parent)
    : QWidget(parent)
    , model_(new LayerModel(this))
    , list_(new QListView(this))
    , vector_files_(new VectorFileList(this))
    , empty_(new QLabel(this))
    , ramps_(new QComboBox(this))
    , feather_label_(new QLabel(tr("&Blend edges over"), this))
    , feather_(new QSpinBox(this))
    , feather_timer_(new QTimer(this))
    , pages_(new QStackedLayout)
{
    list_->setAccessibleName(tr("Layers, topmost first"));
    list_->setObjectName(QStringLiteral("layers"));
    list_->setFrameShape(QFrame::NoFrame);
    list_->setModel(model_);
    list_->setItemDelegate(new LayerDelegate(*model_, this));
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setResizeMode(QListView::Adjust);
    list_->setDragDropMode(QAbstractItemView::InternalMove);
    list_->setDefaultDropAction(Qt::MoveAction);
    list_->setContextMenuPolicy(Qt::ActionsContextMenu);
    list_->setTabKeyNavigation(false);
    for (QAction* action : {actions.go_to, actions.prepare, actions.rename, actions.move_up,
                            actions.move_down, actions.finest_first, actions.remove}) {
        list_->addAction(action);
    }

    open_key_ = actions.open->shortcut().toString(QKeySequence::NativeText);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setContentsMargins(12, 12, 12, 12);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    pages_->addWidget(list_);
    pages_->addWidget(empty_);

    ramps_->setAccessibleName(tr("Color ramp of the active layer"));
    ramps_->setObjectName(QStringLiteral("ramp"));
    ramps_->setIconSize({32, 12});
    ramps_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    ramps_->setMinimumContentsLength(6);
    //: A color ramp: the one that suits the map's body
    ramps_->addItem(tr("Automatic"), QString());
    for (const ColorRamp& ramp : colorRamps()) {
        ramps_->addItem(rampIcon(ramp), rampName(ramp), textFrom(ramp.name));
    }
    auto* ramp_row = new QHBoxLayout;
    ramp_row->setSpacing(8);
    auto* ramp_label = new QLabel(tr("Color &ramp"), this);
    ramp_label->setBuddy(ramps_);
    ramp_row->addWidget(ramp_label);
    ramp_row->addWidget(ramps_, 1);

    feather_->setObjectName(QStringLiteral("feather"));
    feather_->setAccessibleName(tr("Cells over which the edges of the active layer are blended"));
    feather_->setRange(0, static_cast<int>(kFeatherCellsMax));
    feather_->setSingleStep(5);
    feather_->setKeyboardTracking(false);
    //: Edges are not blended
    feather_->setSpecialValueText(tr("Off"));
    //: Follows a number of cells of a grid
    feather_->setSuffix(tr(" cells"));
    feather_->setToolTip(
        tr("Where this layer ends, it goes smoothly into the layers below it: in the picture and "
           "for touch. Elevations that are read stay those of the layer."));
    feather_label_->setBuddy(feather_);
    feather_timer_->setSingleShot(true);
    feather_timer_->setInterval(kFeatherDelay);
    auto* feather_row = new QHBoxLayout;
    feather_row->setSpacing(8);
    feather_row->addWidget(feather_label_);
    feather_row->addWidget(feather_, 1);

    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(2);
    buttons->addWidget(makeButton(actions.open, this));
    for (QAction* action : {actions.move_up, actions.move_down}) {
        QToolButton* button = makeButton(action, this);
        button->setToolButtonStyle(Qt::ToolButtonIconOnly);
        button->setAccessibleName(action->text().remove(QLatin1Char('&')));
        buttons->addWidget(button);
    }
    buttons->addStretch(1); // apart, so that it is not pressed by accident
    buttons->addWidget(makeButton(actions.remove, this));

    auto* foot = new QVBoxLayout;
    foot->setContentsMargins(6, 4, 6, 4);
    foot->addLayout(ramp_row);
    foot->addLayout(feather_row);
    foot->addLayout(buttons);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(pages_, 1);
    layout->addWidget(vector_files_);
    layout->addLayout(foot);

    connect(model_, &LayerModel::visibilityRequested, this, &LayersPanel::visibilityRequested);
    connect(model_, &LayerModel::nameRequested, this, &LayersPanel::nameRequested);
    connect(model_, &LayerModel::moveRequested, this, &LayersPanel::moveRequested);
    connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& current) {
                if (model_->isHeader(current)) {
                    // Home and a click may lead here; the view is in the middle of it.
                    QMetaObject::invokeMethod(this, &LayersPanel::showActive, Qt::QueuedConnection);
                } else if (!is_filling_ && current.isValid()) {
                    Q_EMIT activationRequested(model_->idAt(current));
                }
            });
    connect(ramps_, &QComboBox::activated, this, [this](int item) {
        Q_EMIT rampRequested(model_->session().active, ramps_->itemData(item).toString());
    });
    connect(feather_, &QSpinBox::valueChanged, feather_timer_, qOverload<>(&QTimer::start));
    connect(feather_, &QSpinBox::editingFinished, this, &LayersPanel::requestFeather);
    connect(feather_timer_, &QTimer::timeout, this, &LayersPanel::requestFeather);
    showActive();
}

void LayersPanel::setSession(const Session& session, bool can_feather)
{
    const QScopedValueRollback filling(is_filling_, true);
    if (session.active != model_->session().active) {
        feather_timer_->stop();
    }
    model_->setSession(session);
    feather_label_->setVisible(can_feather);
    feather_->setVisible(can_feather);
    showActive();
}

void LayersPanel::requestFeather()
{
    feather_timer_->stop();
    const Layer* layer = activeLayer(model_->session());
    const auto cells = static_cast<std::size_t>(feather_->value());
    if (layer != nullptr && layer->feather_cells != cells) {
        Q_EMIT featherRequested(layer->id, cells);
    }
}

void LayersPanel::setHeightUnit(HeightUnit unit)
{
    model_->setHeightUnit(unit);
}

void LayersPanel::editName()
{
    list_->setFocus();
    list_->edit(list_->currentIndex());
}

// In place of layers: what to do, or that those of a project are on their way or missing.
QString LayersPanel::emptyText() const
{
    QStringList missing;
    for (const MissingLayer& layer : model_->session().missing) {
        if (!layer.problem.empty()) {
            missing.append(isolated(QString::fromStdString(layer.record.name)));
        }
    }
    if (!missing.isEmpty()) {
        //: %1 are the names of layers of a project
        return tr("Missing: %1.\nLocate or remove what is missing in the notice above the map.")
            .arg(QLocale().createSeparatedList(missing));
    }
    return model_->session().missing.empty()
               ? tr("No layers.\nDrop a DEM here or press %1 to open one.").arg(open_key_)
               //: The layers of a project are being opened
               : tr("Opening…");
}

void LayersPanel::showActive()
{
    const QModelIndex index = model_->indexOfLayer(model_->session().active);
    pages_->setCurrentWidget(index.isValid() ? static_cast<QWidget*>(list_) : empty_);
    empty_->setText(emptyText());
    if (index.isValid() && index != list_->currentIndex()) {
        list_->setCurrentIndex(index);
    }
    list_->doItemsLayout(); // a reason for not being shown makes a row taller
    ramps_->setEnabled(index.isValid());
    const Layer* layer = activeLayer(model_->session());
    ramps_->setCurrentIndex(layer != nullptr ? ramps_->findData(QString::fromStdString(layer->ramp))
                                             : 0);
    if (!feather_timer_->isActive()) { // otherwise it is being changed
        const QSignalBlocker blocker(feather_);
        feather_->setValue(layer != nullptr ? static_cast<int>(layer->feather_cells) : 0);
    }
}

} // namespace marsview
