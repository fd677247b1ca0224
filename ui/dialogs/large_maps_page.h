// The page of the preferences that is about maps too large to be held.
#pragma once

#include "core/tiles/tile_disk_cache.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/preferences.h"

#include <QWidget>

#include <cstddef>
#include <filesystem>

class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QTreeWidget;

namespace marsview {

/// The defaults of the program.
struct LargeMapDefaults {
    std::filesystem::path folder; // of prepared maps
    std::size_t tile_bytes = 0;   // of memory for tiles
};

/// Where prepared maps are stored, which there are and how much they may take, and the same for
/// tiles from servers. How much memory tiles take is a field that the owner places.
class LargeMapsPage final : public QWidget {
    Q_OBJECT

public:
    explicit LargeMapsPage(const LargeMapDefaults& standard, QWidget* parent = nullptr);

    /// For the memory of tiles. A child of this page until it is put into another layout.
    QSpinBox* memoryField() const noexcept { return memory_; }

    void fill(const Preferences& preferences);
    /// Writes the values of this page into `preferences`.
    void apply(Preferences& preferences) const;

Q_SIGNALS:
    void changed();

private:
    std::filesystem::path folder() const;
    void chooseFolder();
    void showFolder();
    void listMaps();
    void showSelection();
    void removeSelected();
    void removeAll();
    void removeMaps(const QStringList& names);
    QWidget* makeFetchedBox();
    void countFetched();
    void showFetched(const QString& folder, KeptTiles kept, const QString& problem);
    void emptyFetched();

    LargeMapDefaults standard_;
    QString chosen_folder_; // empty: the standard one
    QSpinBox* memory_ = nullptr;
    QLineEdit* folder_ = nullptr;
    QPushButton* open_button_ = nullptr;
    QSpinBox* bound_ = nullptr;
    QTreeWidget* maps_ = nullptr;
    QLabel* total_ = nullptr;
    QPushButton* remove_button_ = nullptr;
    QPushButton* remove_all_button_ = nullptr;
    QLineEdit* fetched_folder_ = nullptr;
    QSpinBox* fetched_bound_ = nullptr;
    QLabel* fetched_total_ = nullptr;
    QPushButton* empty_button_ = nullptr;
    DetachedJobs jobs_{*this}; // a disk may be slow
};

} // namespace marsview
