// Progress of loading and of building overviews, in the status bar.
#pragma once

#include <QString>
#include <QWidget>

#include <optional>

class QLabel;
class QProgressBar;
class QToolButton;

namespace marsview {

struct LoadReport;
struct PrepareProgress;

/// The map or file that is read, or else the picture that is saved, or else the map whose overviews
/// are built, with progress and a button that stops it. Hidden otherwise.
class LoadStatus final : public QWidget {
    Q_OBJECT

public:
    explicit LoadStatus(QWidget* parent = nullptr);

    void showReport(const LoadReport& report);
    void endLoading();
    /// Another file is read or written, for which `text` has the words. Shown while nothing loads.
    void showFileWork(const QString& text, const QString& file, double share);
    void endFileWork();
    /// Shown while nothing loads. `share` of it is drawn; 1 while it is written.
    void showSaving(const QString& file, double share);
    void endSaving();
    /// Shown while nothing loads and no picture is saved.
    void showPreparing(const PrepareProgress& progress);
    void endPreparing();

Q_SIGNALS:
    void cancelRequested();
    void cancelFileWorkRequested();
    void cancelSavingRequested();
    void stopPreparingRequested();

private:
    enum class Work { None, Loading, Files, Saving, Preparing };
    struct Shown {
        QString text;
        QString tip;
        std::optional<int> percent = 0; // empty: unknown
    };
    Work work() const;
    void showWhatGoesOn();
    void showProgress(const Shown& shown);

    bool is_loading_ = false;
    bool is_at_files_ = false;
    bool is_saving_ = false;
    bool is_preparing_ = false;
    Shown loading_;
    Shown files_;
    Shown saving_;
    Shown preparing_;
    QLabel* label_ = nullptr;
    QProgressBar* bar_ = nullptr;
    QToolButton* cancel_ = nullptr;
};

} // namespace marsview
