#include "ui/views/saved_views_panel.h"

#include "ui/views/view_thumbnails.h"
#include "ui/widgets/focus_frame.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QScopedValueRollback>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr int kViewIdRole = Qt::UserRole;

ViewId viewIdOf(const QListWidgetItem& item)
{
    return ViewId{item.data(kViewIdRole).toUInt()};
}

QToolButton* makeViewButton(QAction* action, Qt::ToolButtonStyle style, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setToolButtonStyle(style);
    button->setAccessibleName(action->text().remove(QLatin1Char('&')));
    return button;
}

// In place of a picture that has not been drawn yet.
QPixmap placeholder(const QWidget& widget)
{
    const double ratio = widget.devicePixelRatioF();
    QPixmap pixmap((QSizeF(ViewThumbnails::kSize) * ratio).toSize());
    pixmap.setDevicePixelRatio(ratio);
    QColor color = widget.palette().color(QPalette::Text);
    color.setAlpha(24);
    pixmap.fill(Qt::transparent);
    QPainter(&pixmap).fillRect(QRect({}, ViewThumbnails::kSize), color);
    return pixmap;
}

// A selected picture keeps its colors.
QIcon iconOf(const QPixmap& pixmap)
{
    QIcon icon;
    for (const QIcon::Mode mode : {QIcon::Normal, QIcon::Selected, QIcon::Active}) {
        icon.addPixmap(pixmap, mode);
    }
    return icon;
}

} // namespace

SavedViewsPanel::SavedViewsPanel(QWidget* parent)
    : QWidget(parent)
    , list_(new QListWidget(this))
    , pages_(new QStackedLayout)
{
    list_->setAccessibleName(tr("Saved views"));
    list_->setObjectName(QStringLiteral("savedViews"));
    list_->setFrameShape(QFrame::NoFrame);
    new FocusFrame(list_, FocusFrame::Ground::Panel);
    list_->setIconSize(ViewThumbnails::kSize);
    list_->setSpacing(2);
    list_->setWordWrap(true);
    list_->setTextElideMode(Qt::ElideRight);
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::EditKeyPressed);
    list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setResizeMode(QListView::Adjust);
    list_->setDragDropMode(QAbstractItemView::InternalMove);
    list_->setDefaultDropAction(Qt::MoveAction);
    list_->setContextMenuPolicy(Qt::ActionsContextMenu);
    list_->setTabKeyNavigation(false);

    auto* empty = new QLabel(this);
    empty->setObjectName(QStringLiteral("noViews"));
    empty->setAlignment(Qt::AlignCenter);
    empty->setWordWrap(true);
    empty->setContentsMargins(12, 12, 12, 12);
    empty->setForegroundRole(QPalette::PlaceholderText);
    empty_ = empty;
    pages_->addWidget(list_);
    pages_->addWidget(empty_);
    pages_->setCurrentWidget(empty_);

    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(2);
    buttons->setContentsMargins(6, 4, 6, 4);
    foot_ = buttons;
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(pages_, 1);
    layout->addLayout(buttons);

    connect(list_, &QListWidget::itemActivated, this,
            [this](const QListWidgetItem* item) { Q_EMIT goRequested(viewIdOf(*item)); });
    connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
        if (!is_filling_) {
            Q_EMIT nameRequested(viewIdOf(*item), item->text());
        }
    });
    connect(list_, &QListWidget::currentItemChanged, this, [this] {
        if (!is_filling_) {
            Q_EMIT currentChanged();
        }
    });
    // Queued: the list has finished the drop by then.
    connect(
        list_->model(), &QAbstractItemModel::rowsMoved, this,
        [this](const QModelIndex&, int from, int, const QModelIndex&, int to) {
            const int row = to > from ? to - 1 : to;
            if (const QListWidgetItem* item = list_->item(row); !is_filling_ && item != nullptr) {
                Q_EMIT moveRequested(viewIdOf(*item), static_cast<std::size_t>(row));
            }
        },
        Qt::QueuedConnection);
}

void SavedViewsPanel::setActions(const SavedViewActions& actions)
{
    for (QAction* action : {actions.go_to, actions.update, actions.rename, actions.move_up,
                            actions.move_down, actions.remove}) {
        list_->addAction(action);
    }
    qobject_cast<QLabel*>(empty_)->setText(
        //: %1 is a key
        tr("No saved views.\nMove the map to a view worth keeping and press %1. "
           "A double click on a saved view flies back to it.")
            .arg(actions.save->shortcut().toString(QKeySequence::NativeText)));
    auto* foot = qobject_cast<QHBoxLayout*>(foot_);
    foot->addWidget(makeViewButton(actions.save, Qt::ToolButtonTextBesideIcon, this));
    for (QAction* action : {actions.fly_through, actions.move_up, actions.move_down}) {
        foot->addWidget(makeViewButton(action, Qt::ToolButtonIconOnly, this));
    }
    foot->addStretch(1); // apart, so that it is not pressed by accident
    foot->addWidget(makeViewButton(actions.remove, Qt::ToolButtonIconOnly, this));
}

QListWidgetItem* SavedViewsPanel::itemOf(ViewId id) const
{
    for (int row = 0; row < list_->count(); ++row) {
        if (viewIdOf(*list_->item(row)) == id) {
            return list_->item(row);
        }
    }
    return nullptr;
}

void SavedViewsPanel::setViews(const std::vector<SavedView>& views)
{
    const ViewId before = current();
    const int row_before = list_->currentRow();
    {
        const QScopedValueRollback filling(is_filling_, true);
        const QPixmap none = placeholder(*this);
        for (int row = list_->count() - 1; row >= 0; --row) {
            const ViewId id = viewIdOf(*list_->item(row));
            if (std::none_of(views.begin(), views.end(),
                             [id](const SavedView& view) { return view.id == id; })) {
                delete list_->takeItem(row);
            }
        }
        for (std::size_t i = 0; i < views.size(); ++i) {
            QListWidgetItem* item = itemOf(views[i].id);
            const int row = static_cast<int>(i);
            if (item == nullptr) {
                item = new QListWidgetItem(iconOf(none), {});
                item->setFlags((item->flags() | Qt::ItemIsEditable) & ~Qt::ItemIsDropEnabled);
                item->setData(kViewIdRole, static_cast<uint>(views[i].id));
                list_->insertItem(row, item);
            } else if (list_->row(item) != row) {
                list_->insertItem(row, list_->takeItem(list_->row(item)));
            }
            item->setText(QString::fromStdString(views[i].name));
        }
        if (QListWidgetItem* item = itemOf(before)) {
            list_->setCurrentItem(item);
        } else {
            list_->setCurrentRow(std::clamp(row_before, 0, std::max(0, list_->count() - 1)));
        }
    }
    pages_->setCurrentWidget(views.empty() ? empty_ : static_cast<QWidget*>(list_));
    Q_EMIT currentChanged();
}

void SavedViewsPanel::setThumbnail(ViewId id, const QPixmap& picture)
{
    if (QListWidgetItem* item = itemOf(id); item != nullptr && !picture.isNull()) {
        const QScopedValueRollback filling(is_filling_, true);
        item->setIcon(iconOf(picture));
    }
}

void SavedViewsPanel::setDescription(ViewId id, const QString& text)
{
    if (QListWidgetItem* item = itemOf(id)) {
        const QScopedValueRollback filling(is_filling_, true);
        item->setToolTip(text);
        item->setData(Qt::AccessibleDescriptionRole, text);
    }
}

ViewId SavedViewsPanel::current() const
{
    const QListWidgetItem* item = list_->currentItem();
    return item != nullptr ? viewIdOf(*item) : ViewId::None;
}

void SavedViewsPanel::select(ViewId id)
{
    if (QListWidgetItem* item = itemOf(id)) {
        list_->setCurrentItem(item);
        list_->scrollToItem(item);
    }
}

void SavedViewsPanel::editName(ViewId id)
{
    if (QListWidgetItem* item = itemOf(id)) {
        select(id);
        list_->setFocus(Qt::ShortcutFocusReason);
        list_->editItem(item);
    }
}

void SavedViewsPanel::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    Q_EMIT shown(true);
}

void SavedViewsPanel::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    Q_EMIT shown(false);
}

} // namespace marsview
