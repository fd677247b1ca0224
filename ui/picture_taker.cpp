#include "ui/picture_taker.h"

#include "ui/canvas/terrain_view.h"
#include "ui/main_window.h"

#include <QImageWriter>
#include <QPixmap>

namespace marsview {

PictureTaker::PictureTaker(MainWindow& window, const QString& file, QObject* parent)
    : QObject(parent)
    , window_(window)
    , file_(file)
{
    window.view()->setCrosshairAllowed(false);
    // Queued: the window handles the results of the event before its picture is taken.
    connect(&window, &MainWindow::settled, this, &PictureTaker::take, Qt::QueuedConnection);
    connect(&window, &MainWindow::openFailed, this, &PictureTaker::report);
    connect(window.view(), &TerrainView::unavailable, this, &PictureTaker::report);
}

void PictureTaker::take()
{
    if (is_finished_) {
        return;
    }
    QImageWriter writer(file_);
    if (!writer.write(window_.grab().toImage())) {
        report(tr("%1: the picture cannot be written (%2); choose a writable folder "
                  "and a name that ends in .png or .jpg")
                   .arg(file_, writer.errorString()));
        return;
    }
    report({});
}

void PictureTaker::report(const QString& problem)
{
    if (!is_finished_) {
        is_finished_ = true;
        Q_EMIT finished(problem);
    }
}

} // namespace marsview
