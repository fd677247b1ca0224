// File › Export Report.
#pragma once

#include "ui/pictures/picture_scenes.h"
#include "ui/report/report_contents.h"

#include <QImage>
#include <QObject>
#include <QPointer>
#include <QString>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

class QAction;
class QDialog;
class QMenu;
class QWidget;

namespace marsview {

class PictureDrawing;
class TerrainView;

/// Asks for title, credit and contents, then for a file: HTML (.html) or PDF (.pdf), as its name
/// ends. Draws the picture between the events of the GUI thread. One report at a time. Lives in the
/// GUI thread; must not outlive what it is made of.
class ReportExporter final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QWidget& window;
        QMenu& menu;              // the entry is inserted there,
        QAction* after = nullptr; // after this
        TerrainView& view;
        PictureScenes scenes;
        const MeasureController& measuring;
        const AnnotationController& annotating;
        std::function<QString()> project; // its file; empty if it was never saved
        std::function<const Session&()> session;
        std::function<HeightUnit()> unit;
        std::function<CoordinateFormat()> format;
    };

    explicit ReportExporter(const Parts& parts, QObject* parent = nullptr);
    ~ReportExporter() override;

    /// Whose picture a report has.
    PictureScene& scene() const { return parts_.scenes.shown(); }
    /// The menu entry.
    QAction* action() const noexcept { return action_; }
    /// Opens the dialog. Not while isExporting().
    void ask();
    /// Null while it is closed.
    QDialog* dialog() const noexcept { return dialog_; }
    /// Not while isExporting(); the view has a map.
    void exportTo(const QString& file, const ReportChoice& choice);
    bool isExporting() const noexcept { return drawing_ != nullptr; }
    /// No file is written. canceled() follows.
    void cancel();

Q_SIGNALS:
    /// `share` of the picture is drawn.
    void progressed(const QString& file, double share);
    // One of these ends it.
    void saved(const QString& file);
    void failed(const QString& problem);
    void canceled();

private:
    void chooseFile(const ReportChoice& choice);
    void write(QImage picture);
    void end();

    Parts parts_;
    QAction* action_ = nullptr;
    QPointer<QDialog> dialog_;
    QString folder_;
    QString credit_; // as it was typed last
    QString file_;
    std::optional<Report> report_; // that is being exported
    std::vector<PicturePart> labels_;
    std::unique_ptr<PictureDrawing> drawing_; // null unless isExporting()
};

} // namespace marsview
