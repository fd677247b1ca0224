#include "ui/panels/vector_file_list.h"

#include "ui/widgets/caption.h"
#include "ui/widgets/icons.h"

#include <QFileInfo>
#include <QKeySequence>
#include <QLabel>
#include <QListWidget>
#include <QScopedValueRollback>
#include <QShortcut>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr int kColorSide = 12;
constexpr int kRowsMax = 6; // without scrolling
constexpr int kPathRole = Qt::UserRole;

QString pathOf(const QListWidgetItem* item)
{
    return item != nullptr ? item->data(kPathRole).toString() : QString();
}

} // namespace

VectorFileList::VectorFileList(QWidget* parent)
    : QWidget(parent)
    , list_(new QListWidget(this))
{
    list_->setAccessibleName(tr("Vector files, topmost first"));
    list_->setObjectName(QStringLiteral("vectorFiles"));
    list_->setFrameShape(QFrame::NoFrame);
    list_->setTextElideMode(Qt::ElideMiddle);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    list_->setContextMenuPolicy(Qt::CustomContextMenu);
    list_->setTabKeyNavigation(false);
    list_->setSpacing(1);
    auto* caption = makeCaption(tr("Vector files"), this);
    caption->setContentsMargins(6, 6, 6, 2);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(caption);
    layout->addWidget(list_);
    hide();

    connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
        if (!is_filling_) {
            Q_EMIT visibilityRequested(pathOf(item), item->checkState() == Qt::Checked);
        }
    });
    connect(list_, &QListWidget::itemActivated, this,
            [this](const QListWidgetItem* item) { Q_EMIT goToRequested(pathOf(item)); });
    connect(list_, &QWidget::customContextMenuRequested, this, [this](QPoint position) {
        if (const QListWidgetItem* item = list_->itemAt(position)) {
            Q_EMIT menuRequested(pathOf(item), list_->viewport()->mapToGlobal(position));
        }
    });
    auto* close = new QShortcut(QKeySequence::Delete, list_);
    close->setContext(Qt::WidgetShortcut);
    connect(close, &QShortcut::activated, this, [this] {
        if (const QListWidgetItem* item = list_->currentItem()) {
            Q_EMIT closeRequested(pathOf(item));
        }
    });
}

void VectorFileList::setFiles(const std::vector<File>& files)
{
    if (files == files_) {
        return;
    }
    files_ = files;
    const QScopedValueRollback filling(is_filling_, true);
    const QString current = pathOf(list_->currentItem());
    while (list_->count() > static_cast<int>(files.size())) {
        delete list_->takeItem(list_->count() - 1);
    }
    while (list_->count() < static_cast<int>(files.size())) {
        list_->addItem(new QListWidgetItem);
    }
    int row = 0;
    int height = 0;
    for (const File& file : files) {
        fill(*list_->item(row), file);
        if (file.path == current) {
            list_->setCurrentRow(row);
        }
        if (row < kRowsMax) {
            height += list_->sizeHintForRow(row) + 2 * list_->spacing();
        }
        ++row;
    }
    list_->setFixedHeight(height + list_->spacing());
    setVisible(!files.empty());
}

void VectorFileList::fill(QListWidgetItem& item, const File& file)
{
    const QString name = QFileInfo(file.path).fileName();
    item.setData(kPathRole, file.path);
    item.setIcon(swatch(file.color, kColorSide));
    item.setText(file.reason.isEmpty() ? name : name + QLatin1Char('\n') + file.reason);
    item.setToolTip(file.path);
    item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item.setCheckState(file.is_visible ? Qt::Checked : Qt::Unchecked);
}

} // namespace marsview
