#include "ui/dialogs/large_maps_page.h"

#include "core/prepare/map_folder.h"
#include "core/raster/raster_file.h"
#include "ui/text/number_text.h"

#include <QDateTime>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>

namespace marsview {
namespace {

constexpr int kMemoryStep = 256;         // MB
constexpr int kBoundMax = 100'000;       // GB
constexpr std::size_t kMega = 1'048'576; // as the cache counts
constexpr int kNameRole = Qt::UserRole;
constexpr int kInUseRole = Qt::UserRole + 1;

enum Column { Name, Size, LastUsed };

QDateTime dateOf(std::filesystem::file_time_type time)
{
    const auto system = std::chrono::file_clock::to_sys(time);
    return QDateTime::fromMSecsSinceEpoch(
        std::chrono::duration_cast<std::chrono::milliseconds>(system.time_since_epoch()).count());
}

} // namespace

LargeMapsPage::LargeMapsPage(const LargeMapDefaults& standard, QWidget* parent)
    : QWidget(parent)
    , standard_(standard)
    , memory_(new QSpinBox(this))
    , folder_(new QLineEdit(this))
    , bound_(new QSpinBox(this))
    , maps_(new QTreeWidget(this))
    , total_(new QLabel(this))
    , fetched_folder_(new QLineEdit(this))
    , fetched_bound_(new QSpinBox(this))
    , fetched_total_(new QLabel(this))
    , empty_button_(new QPushButton(tr("&Empty…"), this))
{
    const auto whole_mb = static_cast<int>(2 * defaultMemoryBudget() / kMega);
    memory_->setRange(0, whole_mb);
    memory_->setSingleStep(kMemoryStep);
    //: Megabytes, after a number
    memory_->setSuffix(tr(" MB"));
    const QString usual = countText(standard_.tile_bytes / kMega);
    //: In place of the number 0: a usual amount of memory
    memory_->setSpecialValueText(
        //: %1 is a number of megabytes
        tr("Automatic (%1)").arg(leftToRight(tr("%1 MB").arg(usual))));
    memory_->setGroupSeparatorShown(true);
    memory_->setKeyboardTracking(false); // not every digit on the way
    memory_->setObjectName(QStringLiteral("tileMemory"));
    memory_->setAccessibleName(tr("Memory for tiles of large maps"));
    memory_->setToolTip(
        tr("Tiles of large maps that are shown or touched stay in memory up to this size; the "
           "least recently used are evicted first"));
    folder_->setReadOnly(true);
    folder_->setAccessibleName(tr("Folder of prepared maps"));
    folder_->setMinimumWidth(220);
    auto* choose_button = new QPushButton(tr("&Choose…"), this);
    open_button_ = new QPushButton(tr("O&pen"), this);
    open_button_->setToolTip(tr("Show the folder in the file manager"));
    bound_->setRange(0, kBoundMax);
    bound_->setSingleStep(10);
    //: Gigabytes, after a number
    bound_->setSuffix(tr(" GB"));
    bound_->setGroupSeparatorShown(true);
    bound_->setKeyboardTracking(false);
    bound_->setAccessibleName(tr("Maximum size of prepared maps"));
    bound_->setToolTip(tr("When a new map needs room, the least recently used maps are removed"));
    maps_->setAccessibleName(tr("Prepared maps"));
    maps_->setObjectName(QStringLiteral("preparedMaps"));
    // As low as the first page; it grows with the dialog.
    maps_->setMinimumHeight(6 * maps_->fontMetrics().height());
    maps_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
    maps_->setHeaderLabels({tr("Prepared map"), tr("Size"), tr("Last used")});
    maps_->setRootIsDecorated(false);
    maps_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    maps_->setUniformRowHeights(true);
    maps_->header()->setFocusPolicy(Qt::NoFocus); // there is nothing to be done with it
    maps_->header()->setStretchLastSection(false);
    maps_->header()->setSectionResizeMode(Name, QHeaderView::Stretch);
    maps_->header()->setSectionResizeMode(Size, QHeaderView::ResizeToContents);
    maps_->header()->setSectionResizeMode(LastUsed, QHeaderView::ResizeToContents);
    remove_button_ = new QPushButton(tr("&Remove"), this);
    remove_button_->setObjectName(QStringLiteral("removePrepared"));
    remove_all_button_ = new QPushButton(tr("Remove &All…"), this);
    for (QPushButton* button : {choose_button, open_button_, remove_button_, remove_all_button_}) {
        button->setAutoDefault(false);
    }

    auto* folder_row = new QHBoxLayout;
    folder_row->addWidget(folder_, 1);
    folder_row->addWidget(choose_button);
    folder_row->addWidget(open_button_);
    auto* form = new QFormLayout;
    form->addRow(tr("Prepared maps"), folder_row);
    form->addRow(tr("&Maximum size"), bound_);
    auto* foot = new QHBoxLayout;
    foot->addWidget(total_, 1);
    foot->addWidget(remove_button_);
    foot->addSpacing(12); // the button that removes everything is set apart
    foot->addWidget(remove_all_button_);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(maps_, 1);
    layout->addLayout(foot);
    layout->addWidget(makeFetchedBox());

    connect(memory_, &QSpinBox::valueChanged, this, &LargeMapsPage::changed);
    connect(bound_, &QSpinBox::valueChanged, this, &LargeMapsPage::changed);
    connect(choose_button, &QPushButton::clicked, this, &LargeMapsPage::chooseFolder);
    connect(open_button_, &QPushButton::clicked, this, [this] {
        QDesktopServices::openUrl(QUrl::fromLocalFile(QString::fromStdString(folder().string())));
    });
    connect(maps_, &QTreeWidget::itemSelectionChanged, this, &LargeMapsPage::showSelection);
    connect(remove_button_, &QPushButton::clicked, this, &LargeMapsPage::removeSelected);
    connect(remove_all_button_, &QPushButton::clicked, this, &LargeMapsPage::removeAll);
}

void LargeMapsPage::fill(const Preferences& preferences)
{
    memory_->setValue(preferences.tile_memory_mb);
    bound_->setValue(preferences.map_folder_gb);
    fetched_bound_->setValue(preferences.fetched_gb);
    chosen_folder_ = preferences.map_folder;
    showFolder();
}

void LargeMapsPage::apply(Preferences& preferences) const
{
    preferences.tile_memory_mb =
        memory_->value() == 0 ? 0 : std::max(memory_->value(), kTileMemoryMbMin);
    preferences.map_folder_gb = bound_->value();
    preferences.fetched_gb = fetched_bound_->value();
    preferences.map_folder = chosen_folder_;
}

// The tiles from servers are stored next to the prepared maps.
QWidget* LargeMapsPage::makeFetchedBox()
{
    fetched_folder_->setReadOnly(true);
    fetched_folder_->setAccessibleName(tr("Folder of tiles from servers"));
    fetched_bound_->setRange(0, kBoundMax);
    //: Gigabytes, after a number
    fetched_bound_->setSuffix(tr(" GB"));
    fetched_bound_->setSpecialValueText(tr("Automatic (%1)").arg(bytesText(kFetchedBytesMax)));
    fetched_bound_->setGroupSeparatorShown(true);
    fetched_bound_->setKeyboardTracking(false);
    fetched_bound_->setAccessibleName(tr("Maximum size of tiles from servers"));
    fetched_bound_->setToolTip(
        tr("When new tiles need room, the least recently used tiles are removed"));
    fetched_total_->setObjectName(QStringLiteral("fetchedTotal"));
    empty_button_->setObjectName(QStringLiteral("emptyFetched"));
    empty_button_->setAutoDefault(false);
    auto* foot = new QHBoxLayout;
    foot->addWidget(fetched_total_, 1);
    foot->addWidget(empty_button_);
    auto* box = new QWidget(this);
    auto* form = new QFormLayout(box);
    form->setContentsMargins(0, 12, 0, 0); // a gap above
    form->addRow(tr("Tiles from servers"), fetched_folder_);
    form->addRow(tr("Ma&ximum size"), fetched_bound_);
    form->addRow(foot);
    connect(fetched_bound_, &QSpinBox::valueChanged, this, &LargeMapsPage::changed);
    connect(empty_button_, &QPushButton::clicked, this, &LargeMapsPage::emptyFetched);
    return box;
}

std::filesystem::path LargeMapsPage::folder() const
{
    return chosen_folder_.isEmpty() ? standard_.folder
                                    : std::filesystem::path(chosen_folder_.toStdString());
}

void LargeMapsPage::chooseFolder()
{
    auto* dialog = new QFileDialog(this, tr("Folder of Prepared Maps"),
                                   QString::fromStdString(folder().string()));
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& chosen) {
        const bool is_standard =
            QFileInfo(chosen).absoluteFilePath() ==
            QFileInfo(QString::fromStdString(standard_.folder.string())).absoluteFilePath();
        chosen_folder_ = is_standard ? QString() : chosen;
        showFolder();
        Q_EMIT changed();
    });
    dialog->open();
}

void LargeMapsPage::showFolder()
{
    const QString path = QDir::toNativeSeparators(QString::fromStdString(folder().string()));
    folder_->setText(path);
    folder_->setToolTip(path);
    listMaps();
    countFetched();
}

void LargeMapsPage::listMaps()
{
    maps_->clear();
    const bool is_there = QFileInfo(QString::fromStdString(folder().string())).isDir();
    open_button_->setEnabled(is_there);
    std::uint64_t bytes = 0;
    bool is_any_free = false; // to be removed
    QString problem;
    bound_->setSpecialValueText(tr("Automatic"));
    if (is_there) {
        const Result<MapFolder> opened = MapFolder::open(folder());
        const auto listed =
            opened ? opened->list() : Result<std::vector<PreparedMap>>(opened.error());
        if (listed) {
            for (const PreparedMap& map : *listed) {
                const QString source = QString::fromStdString(map.source);
                const QString name = QString::fromStdString(map.name);
                auto* item = new QTreeWidgetItem(maps_);
                const QString shown = source.isEmpty() ? name : QFileInfo(source).fileName();
                //: Of a prepared map that some window shows
                item->setText(Name, map.is_in_use ? tr("%1 (in use)").arg(shown) : shown);
                item->setToolTip(Name, source.isEmpty() ? name : source);
                item->setText(Size, bytesText(map.bytes));
                item->setTextAlignment(Size, Qt::AlignRight | Qt::AlignVCenter);
                item->setText(LastUsed,
                              QLocale().toString(dateOf(map.last_used), QLocale::ShortFormat));
                item->setData(Name, kNameRole, name);
                item->setData(Name, kInUseRole, map.is_in_use);
                bytes += map.bytes;
                is_any_free = is_any_free || !map.is_in_use;
            }
        } else {
            problem = QString::fromStdString(listed.error().message);
        }
        if (opened) {
            //: In place of the number 0: a usual bound; %1 is a size
            bound_->setSpecialValueText(
                tr("Automatic (%1)").arg(bytesText(opened->defaultBytesMax())));
        }
    }
    const int count = maps_->topLevelItemCount();
    total_->setText(!problem.isEmpty() ? problem
                    : count == 0       ? tr("Nothing has been prepared here.")
                    //: %1 is a size
                    : count == 1 ? tr("One map, %1").arg(bytesText(bytes))
                                 //: %n maps that take %1 together
                                 : tr("%n maps, %1", nullptr, count).arg(bytesText(bytes)));
    total_->setWordWrap(!problem.isEmpty());
    remove_all_button_->setEnabled(is_any_free);
    showSelection();
}

void LargeMapsPage::showSelection()
{
    remove_button_->setEnabled(!maps_->selectedItems().isEmpty());
}

void LargeMapsPage::removeSelected()
{
    QStringList names;
    for (const QTreeWidgetItem* item : maps_->selectedItems()) {
        names.append(item->data(Name, kNameRole).toString());
    }
    removeMaps(names);
}

void LargeMapsPage::removeAll()
{
    auto* box = new QMessageBox(
        QMessageBox::Question, tr("Remove All Prepared Maps"),
        tr("Remove all prepared maps? The maps themselves stay; they are prepared again when they "
           "are opened, which takes minutes."),
        QMessageBox::Cancel, this);
    QPushButton* remove = box->addButton(tr("Remove &All"), QMessageBox::DestructiveRole);
    box->setDefaultButton(QMessageBox::Cancel);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setWindowModality(Qt::WindowModal);
    connect(remove, &QPushButton::clicked, this, [this] {
        QStringList names;
        for (int i = 0; i < maps_->topLevelItemCount(); ++i) {
            const QTreeWidgetItem* item = maps_->topLevelItem(i);
            if (!item->data(Name, kInUseRole).toBool()) {
                names.append(item->data(Name, kNameRole).toString());
            }
        }
        removeMaps(names);
    });
    box->show();
}

void LargeMapsPage::countFetched()
{
    const std::string fetched = fetchedTilesFolder(folder());
    const QString path = QDir::toNativeSeparators(QString::fromStdString(fetched));
    fetched_folder_->setText(path);
    fetched_folder_->setToolTip(path);
    fetched_total_->setText(tr("Calculating…"));
    empty_button_->setEnabled(false);
    jobs_.run([this, fetched, path](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        const KeptTiles kept = keptTilesIn(fetched);
        outlet->post([this, path, kept] { showFetched(path, kept, {}); });
    });
}

void LargeMapsPage::showFetched(const QString& folder, KeptTiles kept, const QString& problem)
{
    if (folder != fetched_folder_->text()) {
        return; // another folder was chosen in the meantime
    }
    const auto count = static_cast<int>(std::min<std::uint64_t>(kept.count, 1'000'000'000));
    fetched_total_->setText(!problem.isEmpty() ? problem
                            : kept.bytes == 0  ? tr("No tiles are stored here.")
                            //: %1 is a size
                            : count == 1
                                ? tr("One tile, %1").arg(bytesText(kept.bytes))
                                //: %n tiles that take %1 together
                                : tr("%n tiles, %1", nullptr, count).arg(bytesText(kept.bytes)));
    fetched_total_->setWordWrap(!problem.isEmpty());
    empty_button_->setEnabled(kept.bytes > 0);
}

void LargeMapsPage::emptyFetched()
{
    auto* box = new QMessageBox(
        QMessageBox::Question, tr("Remove Tiles from Servers"),
        tr("Remove all downloaded tiles? They are downloaded again when they are viewed or "
           "touched."),
        QMessageBox::Cancel, this);
    QPushButton* remove = box->addButton(tr("&Remove"), QMessageBox::DestructiveRole);
    box->setDefaultButton(QMessageBox::Cancel);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setWindowModality(Qt::WindowModal);
    connect(remove, &QPushButton::clicked, this, [this] {
        const std::string fetched = fetchedTilesFolder(folder());
        const QString path = fetched_folder_->text();
        fetched_total_->setText(tr("Removing…"));
        empty_button_->setEnabled(false);
        jobs_.run([this, fetched, path](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
            const Status removed = removeKeptTiles(fetched);
            const QString problem =
                removed ? QString() : QString::fromStdString(removed.error().message);
            const KeptTiles kept = keptTilesIn(fetched);
            outlet->post([this, path, kept, problem] { showFetched(path, kept, problem); });
        });
    });
    box->show();
}

void LargeMapsPage::removeMaps(const QStringList& names)
{
    QString problem;
    const Result<MapFolder> opened = MapFolder::open(folder());
    for (const QString& name : names) {
        const Status removed = opened ? opened->remove(name.toStdString()) : opened.error();
        if (!removed && problem.isEmpty()) {
            problem = QString::fromStdString(removed.error().message);
        }
    }
    listMaps();
    if (!problem.isEmpty()) {
        total_->setText(problem);
        total_->setWordWrap(true);
    }
}

} // namespace marsview
