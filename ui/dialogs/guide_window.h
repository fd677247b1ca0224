// The user guide in a window: the pages of resources/guide, searchable.
#pragma once

#include <QDialog>
#include <QString>
#include <QVector>

class QLabel;
class QLineEdit;
class QListWidget;
class QTextBrowser;

namespace marsview {

/// A page of the guide.
struct GuidePage {
    QString file;  // name in the guide's folder, "touching.md"
    QString title; // its first heading
    QString text;  // Markdown
};

/// The pages in `folder`, in the order in which README.md links to them. Pages that cannot be read
/// are left out; empty if README.md is missing.
QVector<GuidePage> guidePagesIn(const QString& folder);

/// The folder of the guide that is installed with this program; empty if it is missing.
QString guideFolder();

class GuideWindow final : public QDialog {
    Q_OBJECT

public:
    /// Not modal: people read it next to the map.
    explicit GuideWindow(QVector<GuidePage> pages, QWidget* parent = nullptr);

    /// Shows a page; `file` may carry an anchor ("touching.md#recordings"). Other addresses open in
    /// the desktop's browser.
    void open(const QString& file);

private:
    void showPage(int row);
    void search();
    void findNext();

    QVector<GuidePage> pages_;
    QLineEdit* search_;
    QLabel* outcome_;
    QListWidget* list_;
    QTextBrowser* text_;
};

} // namespace marsview
