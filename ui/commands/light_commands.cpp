#include "ui/commands/light_commands.h"

#include "core/globe/sunlight.h"
#include "ui/commands/scene_commands.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/light_popup.h"
#include "ui/globe/globe_view.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/window_actions.h"

#include <QAction>

namespace marsview {

LightCommands::LightCommands(const Parts& parts)
    : parts_(parts)
{
    SessionController& session = parts_.session;
    const LightPopup& popup = parts_.popup;
    connect(parts_.actions.light, &QAction::triggered, this, [this] {
        showInPopup();
        parts_.popup.openBelow(parts_.tool_bar.lightAnchor());
    });
    connect(&popup, &LightPopup::lightChanged, &session, &SessionController::setLight);
    connect(&popup, &LightPopup::frameChosen, this, [this](LightFrame frame) {
        frame == LightFrame::Body ? fixOnBody() : parts_.session.fixLightInView();
    });
    connect(&popup, &LightPopup::subsolarPointChosen, &session,
            &SessionController::setSubsolarPoint);
    connect(&popup, &LightPopup::overheadRequested, this,
            [this] { parts_.session.setSubsolarPoint(parts_.globe.cameraGoal().target); });
    const auto follow = [this] {
        if (parts_.popup.isVisible()) {
            showInPopup();
        }
    };
    connect(&session, &SessionController::sessionChanged, this, follow);
    connect(&parts_.scene, &SceneCommands::shownChanged, this, follow);
    connect(&parts_.globe, &GlobeView::sceneChanged, this, follow);
}

void LightCommands::showInPopup()
{
    const bool is_lit = parts_.scene.isGlobeShown() && parts_.globe.terrain() != nullptr;
    parts_.popup.setBody(is_lit ? &parts_.globe.terrain()->map()->info() : nullptr);
    parts_.popup.setLook(parts_.session.session().look);
}

// The first time with the sun where the light of the view is at the middle of the picture.
void LightCommands::fixOnBody()
{
    const TerrainLook& look = parts_.session.session().look;
    if (look.subsolar || parts_.globe.terrain() == nullptr) {
        parts_.session.setSubsolarPoint(look.subsolar.value_or(GeographicPoint{}));
        return;
    }
    parts_.session.setSubsolarPoint(subsolarPoint(parts_.globe.cameraGoal().target,
                                                  look.light_azimuth, look.light_altitude,
                                                  parts_.globe.scene().ellipsoid()));
}

} // namespace marsview
