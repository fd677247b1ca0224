// Taking a picture of the window once it shows the whole map.
#pragma once

#include <QObject>
#include <QString>

namespace marsview {

class MainWindow;

/// Waits for the window's map to be drawn completely, grabs the window as it is on screen, and
/// writes it to a file. Reports once.
class PictureTaker final : public QObject {
    Q_OBJECT

public:
    PictureTaker(MainWindow& window, const QString& file, QObject* parent = nullptr);

Q_SIGNALS:
    /// Empty where the picture was written; else "FILE: WHY".
    void finished(const QString& problem);

private:
    void take();
    void report(const QString& problem);

    MainWindow& window_;
    QString file_;
    bool is_finished_ = false;
};

} // namespace marsview
