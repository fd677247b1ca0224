// The list of vector files that are drawn on the map.
#pragma once

#include <QColor>
#include <QString>
#include <QWidget>

#include <vector>

class QListWidget;
class QListWidgetItem;

namespace marsview {

/// A caption and a row for each file, the one drawn last first: whether it is shown, its color and
/// its name. Hidden when there are no files. Requests changes, but makes none.
class VectorFileList final : public QWidget {
    Q_OBJECT

public:
    struct File {
        QString path;
        QColor color;
        bool is_visible = true;
        QString reason{}; // why it is not drawn although it is visible; empty if it is
        bool operator==(const File&) const = default;
    };

    explicit VectorFileList(QWidget* parent = nullptr);

    void setFiles(const std::vector<File>& files);
    QListWidget* list() const noexcept { return list_; }

Q_SIGNALS:
    void visibilityRequested(const QString& path, bool is_visible);
    void goToRequested(const QString& path);
    void closeRequested(const QString& path);
    /// At a position of the screen.
    void menuRequested(const QString& path, QPoint position);

private:
    void fill(QListWidgetItem& item, const File& file);

    std::vector<File> files_;
    QListWidget* list_ = nullptr;
    bool is_filling_ = false;
};

} // namespace marsview
