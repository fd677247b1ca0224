#include "ui/project/project_menu.h"

#include "ui/controllers/session_controller.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/icons.h"

#include <QAction>
#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QKeySequence>
#include <QLocale>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>

#include <utility>

namespace marsview {
namespace {

// How often, and for how long, the copies of programs are looked at that may be about to end.
constexpr int kLookAgainMs = 250;
constexpr qint64 kLookingMs = 120'000;

QString nameOf(const QString& file)
{
    return isolated(QFileInfo(file).completeBaseName());
}

} // namespace

ProjectMenu::ProjectMenu(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
{
    look_again_.setInterval(kLookAgainMs);
    connect(&look_again_, &QTimer::timeout, this, &ProjectMenu::lookAtCopiesInUse);
    QMenu& menu = parts_.file_menu;
    QAction* first = menu.actions().isEmpty() ? nullptr : menu.actions().constFirst();
    const auto add = [&](const QString& text, const QKeySequence& key, const QString& name) {
        auto* action = new QAction(text, this);
        action->setShortcut(key);
        action->setObjectName(name);
        menu.insertAction(first, action);
        return action;
    };
    new_ = add(tr("&New Project"), QKeySequence::New, QStringLiteral("newProject"));
    new_->setIcon(lineIcon(QStringLiteral("new")));
    new_->setToolTip(tr("Close all layers and start an empty project"));
    open_ = add(tr("Open Pro&ject…"), QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_O),
                QStringLiteral("openProject"));
    open_->setIcon(lineIcon(QStringLiteral("open-project")));
    open_->setToolTip(tr("Open the layers, colors and view that were saved in a project"));
    recent_menu_ = new QMenu(tr("Rec&ent Projects"), &menu);
    recent_menu_->setIcon(lineIcon(QStringLiteral("recent")));
    menu.insertMenu(first, recent_menu_);
    save_ = add(tr("&Save Project"), QKeySequence::Save, QStringLiteral("saveProject"));
    save_->setIcon(lineIcon(QStringLiteral("save")));
    save_->setToolTip(tr("Save the layers, colors and view"));
    save_as_ = add(tr("Sa&ve Project As…"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S),
                   QStringLiteral("saveProjectAs"));
    save_as_->setIcon(lineIcon(QStringLiteral("save-as")));
    menu.insertSeparator(first);
    recent_ =
        new RecentFiles(*recent_menu_, parts_.memory, this, QStringLiteral("projects/recent"));

    connect(new_, &QAction::triggered, this, [this] {
        Q_EMIT requested();
        saveThen([this] { parts_.project.startNew(); });
    });
    connect(open_, &QAction::triggered, this, &ProjectMenu::chooseProject);
    connect(save_, &QAction::triggered, this,
            [this] { parts_.project.file().isEmpty() ? saveAs({}) : parts_.project.save(); });
    connect(save_as_, &QAction::triggered, this, [this] { saveAs({}); });
    connect(recent_, &RecentFiles::chosen, this, [this](const QString& file) { open(file); });
    connect(&parts_.project, &ProjectController::opened, recent_, &RecentFiles::add);
    connect(&parts_.project, &ProjectController::saved, recent_, &RecentFiles::add);
    connect(&parts_.session, &SessionController::sessionChanged, this, &ProjectMenu::showMissing);
}

bool ProjectMenu::hasQuestion() const
{
    const Session& session = parts_.session.session();
    return parts_.has_questions && parts_.project.isModified() &&
           !(session.layers.empty() && session.missing.empty() && parts_.project.file().isEmpty());
}

void ProjectMenu::saveThen(const std::function<void()>& next)
{
    if (!hasQuestion()) {
        next();
        return;
    }
    if (parts_.project.isSaving()) {
        connect(
            &parts_.project, &ProjectController::idle, this, [this, next] { saveThen(next); },
            Qt::SingleShotConnection);
        return;
    }
    auto* box = new QMessageBox(&parts_.window);
    box->setObjectName(QStringLiteral("unsavedChanges"));
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setWindowModality(Qt::WindowModal);
    box->setIcon(QMessageBox::Question);
    box->setWindowTitle(tr("Unsaved Changes"));
    box->setTextFormat(Qt::PlainText);
    box->setText(parts_.project.file().isEmpty()
                     ? tr("Save the layers and settings as a project?")
                     //: %1 is a project
                     : tr("Save the changes to %1?").arg(nameOf(parts_.project.file())));
    box->setStandardButtons(QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
    box->setDefaultButton(QMessageBox::Save);
    box->button(QMessageBox::Discard)->setText(tr("&Don't Save"));
    connect(box, &QMessageBox::finished, this, [this, next](int answer) {
        if (answer == QMessageBox::Discard) {
            parts_.project.discardAutosave();
            next();
        } else if (answer == QMessageBox::Save) {
            if (parts_.project.file().isEmpty()) {
                saveAs(next);
            } else {
                parts_.project.save(next);
            }
        }
    });
    box->open();
}

QString ProjectMenu::folder() const
{
    if (!parts_.project.file().isEmpty()) {
        return QFileInfo(parts_.project.file()).absolutePath();
    }
    const Layer* active = activeLayer(parts_.session.session());
    if (active == nullptr || active->is_sample) {
        return QDir::homePath();
    }
    const QFileInfo map(QString::fromStdString(active->map->spec().path));
    const QFileInfo folder(map.absolutePath());
    const bool is_bundled = folder == QFileInfo(parts_.bundled_maps);
    return map.exists() && !is_bundled && folder.isWritable() ? folder.absoluteFilePath()
                                                              : QDir::homePath();
}

void ProjectMenu::saveAs(const std::function<void()>& next)
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Save Project As"), folder());
    dialog->setObjectName(QStringLiteral("saveProjectDialog"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilter(tr("MarsView projects (*.mvproj)"));
    dialog->setDefaultSuffix(QStringLiteral("mvproj"));
    const Layer* active = activeLayer(parts_.session.session());
    dialog->selectFile(!parts_.project.file().isEmpty() ? parts_.project.file()
                       : active != nullptr
                           ? QFileInfo(QString::fromStdString(active->name)).completeBaseName() +
                                 QStringLiteral(".mvproj")
                           //: The name of a new project's file
                           : tr("project") + QStringLiteral(".mvproj"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, next](const QString& file) { parts_.project.saveAs(file, next); });
    dialog->open();
}

void ProjectMenu::chooseProject()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Open Project"), folder());
    dialog->setObjectName(QStringLiteral("openProjectDialog"));
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters({tr("MarsView projects (*.mvproj)"), tr("All files (*)")});
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) { open(file); });
    dialog->open();
}

void ProjectMenu::open(const QString& project, const QStringList& maps)
{
    Q_EMIT requested();
    const auto open_it = [this, maps](const ReadProject& read) {
        saveThen([this, maps, read] {
            parts_.project.open(read);
            parts_.session.open(maps);
        });
    };
    parts_.project.read(project, open_it, [this, maps] { parts_.session.open(maps); });
}

void ProjectMenu::offerRecovery()
{
    if (!parts_.has_questions) {
        return;
    }
    in_use_ = parts_.project.copiesInUse();
    offerLeftover();
    if (!in_use_.empty()) {
        looking_.start();
        look_again_.start();
    }
}

void ProjectMenu::lookAtCopiesInUse()
{
    if (question_) {
        return; // one at a time
    }
    const std::set<std::filesystem::path> before =
        std::exchange(in_use_, parts_.project.copiesInUse());
    std::erase_if(in_use_,
                  [&before](const std::filesystem::path& copy) { return !before.contains(copy); });
    if (in_use_.empty() || looking_.hasExpired(kLookingMs)) {
        look_again_.stop();
    }
    if (in_use_.size() < before.size()) {
        offerLeftover(&before);
    }
}

// One that the user was not asked about; null: of all.
void ProjectMenu::offerLeftover(const std::set<std::filesystem::path>* of)
{
    for (const LeftoverProject& leftover : parts_.project.leftovers()) {
        if (!asked_.contains(leftover.copy) && (of == nullptr || of->contains(leftover.copy))) {
            ask(leftover);
            return;
        }
    }
}

void ProjectMenu::ask(const LeftoverProject& leftover)
{
    asked_.insert(leftover.copy);
    auto* box = new QMessageBox(&parts_.window);
    question_ = box;
    box->setObjectName(QStringLiteral("recovery"));
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setWindowModality(Qt::WindowModal);
    box->setIcon(QMessageBox::Question);
    box->setWindowTitle(tr("Restore Project"));
    box->setTextFormat(Qt::PlainText);
    const QString time =
        QLocale().toString(QFileInfo(QString::fromStdString(leftover.copy.string())).lastModified(),
                           QLocale::ShortFormat);
    const QString file = QString::fromStdString(leftover.file.string());
    box->setText(file.isEmpty()
                     //: %1 is date and time
                     ? tr("MarsView ended unexpectedly. Restore the unsaved layers and settings "
                          "(%1)?")
                           .arg(time)
                     //: %1 is a project, %2 is date and time
                     : tr("MarsView ended unexpectedly. Restore the unsaved changes to %1 (%2)?")
                           .arg(nameOf(file), time));
    QPushButton* restore = box->addButton(tr("&Restore"), QMessageBox::AcceptRole);
    QPushButton* drop = box->addButton(tr("&Delete"), QMessageBox::DestructiveRole);
    QPushButton* later = box->addButton(tr("Ask &Later"), QMessageBox::RejectRole);
    restore->setObjectName(QStringLiteral("restore"));
    drop->setObjectName(QStringLiteral("delete"));
    box->setDefaultButton(restore);
    box->setEscapeButton(later);
    connect(box, &QMessageBox::finished, this, [this, box, restore, drop, leftover] {
        if (box->clickedButton() == restore) {
            saveThen([this, leftover] { parts_.project.recover(leftover); });
        } else if (box->clickedButton() == drop) {
            ProjectAutosave::remove(leftover);
            offerLeftover(); // the next one
        }
    });
    box->open();
}

QString ProjectMenu::title() const
{
    const QString& file = parts_.project.file();
    return file.isEmpty() ? QString() : nameOf(file) + QStringLiteral("[*]");
}

void ProjectMenu::locate(LayerId id)
{
    for (const MissingLayer& missing : parts_.session.session().missing) {
        if (missing.id == id) {
            auto* dialog = new QFileDialog(
                &parts_.window,
                //: Title of a file dialog; %1 is a layer
                tr("Locate %1").arg(isolated(QString::fromStdString(missing.record.name))),
                folder());
            dialog->setObjectName(QStringLiteral("locateDialog"));
            dialog->setFileMode(QFileDialog::ExistingFile);
            dialog->setAttribute(Qt::WA_DeleteOnClose);
            connect(dialog, &QFileDialog::fileSelected, &parts_.session,
                    [this, id](const QString& file) { parts_.session.locate(id, file); });
            dialog->open();
            return;
        }
    }
}

// Layers that are still loading have no problem yet.
void ProjectMenu::showMissing()
{
    QList<Notice> notices;
    for (const MissingLayer& missing : parts_.session.session().missing) {
        if (missing.problem.empty()) {
            continue;
        }
        const LayerId id = missing.id;
        notices.append(
            {.id = QStringLiteral("missing: %1").arg(static_cast<uint>(id)),
             //: %1 is a layer, %2 says which file cannot be opened, and why
             .text = tr("The layer “%1” is missing. %2")
                         .arg(isolated(QString::fromStdString(missing.record.name)),
                              asSentence(missing.problem)),
             .actions = {{tr("&Locate…"), [this, id] { locate(id); }},
                         {tr("&Remove Layer"), [this, id] { parts_.session.removeMissing(id); }}},
             //: On a button with a menu: what to do about a missing layer
             .menu_text = tr("Missing Layer")});
    }
    parts_.notices.setNotices(NoticeSource::Project, notices);
}

} // namespace marsview
