// Saving a picture of the map: size, contents, file.
#pragma once

#include "core/view/camera.h"
#include "ui/dialogs/save_picture_dialog.h"

#include <QImage>
#include <QObject>
#include <QString>

namespace marsview {

class MapOverlays;
class TerrainView;

/// Asks for size and contents, then for a file, and writes the picture of what was seen when it was
/// asked for. Lives in the GUI thread; view, overlays and the parent outlive it.
class PictureSaver final : public QObject {
    Q_OBJECT

public:
    enum class Memory { Settings, WindowOnly };

    PictureSaver(TerrainView& view, MapOverlays& overlays, Memory memory, QWidget* parent);

    /// `name` is offered for the file, without ending.
    void start(const QString& name);

    /// The picture with the overlays that are chosen and shown. Null, and failed(), where it cannot
    /// be drawn.
    QImage picture(const OrbitCamera& camera, const PictureChoice& choice);
    /// The folder of the last picture, at first the user's folder of pictures.
    QString folder() const;

Q_SIGNALS:
    void saved(const QString& file);
    void failed(const QString& problem);

private:
    void chooseFile(const QString& name, const OrbitCamera& camera, const PictureChoice& choice);
    void save(const QString& file, const OrbitCamera& camera, const PictureChoice& choice);

    TerrainView& view_;
    MapOverlays& overlays_;
    Memory memory_;
    QWidget* window_ = nullptr;
    QString folder_;
};

} // namespace marsview
