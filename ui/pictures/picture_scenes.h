// The scene of the window that pictures are drawn of.
#pragma once

#include "ui/pictures/picture_scene.h"

#include <QWidget>

#include <variant>

namespace marsview {

/// Both scenes of a window, of which one is shown. All outlive this.
struct PictureScenes {
    PictureScene& flat;
    PictureScene& globe;
    const QWidget& globe_view;

    PictureScene& shown() const { return globe_view.isHidden() ? flat : globe; }
    /// The one that a path is in.
    PictureScene& of(const CameraPath& path) const { return path.isOnBody() ? globe : flat; }
    /// The one with such cameras.
    PictureScene& of(const SceneCamera& camera) const
    {
        return std::holds_alternative<OrbitCamera>(camera) ? flat : globe;
    }
};

} // namespace marsview
