#include "ui/commands/help_commands.h"

#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/about_dialog.h"
#include "ui/dialogs/guide_window.h"
#include "ui/window/keys_dialog.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QMainWindow>
#include <QOpenGLContext>
#include <QOpenGLFunctions>

namespace marsview {

HelpCommands::HelpCommands(QMainWindow& window, TerrainView& view, const WindowActions& actions)
    : window_(window)
    , view_(view)
{
    connect(actions.guide, &QAction::triggered, this, &HelpCommands::showGuide);
    connect(actions.keys, &QAction::triggered, this, &HelpCommands::showKeys);
    connect(actions.about, &QAction::triggered, this, &HelpCommands::showAbout);
}

void HelpCommands::showAbout()
{
    QString driver;
    if (view_.context() != nullptr) {
        view_.makeCurrent();
        const auto* name =
            reinterpret_cast<const char*>(view_.context()->functions()->glGetString(GL_RENDERER));
        driver = QString::fromLatin1(name);
        view_.doneCurrent();
    }
    auto* dialog = new AboutDialog(driver, &window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void HelpCommands::showGuide()
{
    if (guide_ == nullptr) {
        guide_ = new GuideWindow(guidePagesIn(guideFolder()), &window_);
    }
    guide_->show();
    guide_->raise();
    guide_->activateWindow();
}

void HelpCommands::showKeys()
{
    auto* dialog = new KeysDialog(*window_.menuBar(), &window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
}

} // namespace marsview
