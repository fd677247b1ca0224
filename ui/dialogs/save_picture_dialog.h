// Choosing the size and the contents of a saved picture.
#pragma once

#include <QDialog>
#include <QSize>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace marsview {

struct PictureLimits {
    int side_max = 16384;               // pixels; what the graphics driver draws
    qint64 pixel_count_max = 1LL << 27; // of width × height
};

struct PictureChoice {
    QSize size; // pixels
    bool has_legend = true;
    bool has_scale = true;  // compass and scale bar
    bool has_labels = true; // and lines: names, graticule, measurements
};

class SavePictureDialog final : public QDialog {
    Q_OBJECT

public:
    /// `view_size` is that of the map on screen, in pixels.
    SavePictureDialog(QSize view_size, const PictureLimits& limits, QWidget* parent = nullptr);

    PictureChoice choice() const;

Q_SIGNALS:
    /// The size is chosen, but the dialog stays until it is accepted.
    void fileRequested();

private:
    void showSize();
    QString problem() const;

    QSize view_size_;
    PictureLimits limits_;
    QComboBox* sizes_ = nullptr;
    QSpinBox* width_ = nullptr;
    QSpinBox* height_ = nullptr;
    QCheckBox* legend_ = nullptr;
    QCheckBox* scale_ = nullptr;
    QCheckBox* labels_ = nullptr;
    QLabel* note_ = nullptr;
    QPushButton* save_ = nullptr;
};

} // namespace marsview
