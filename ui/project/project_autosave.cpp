#include "ui/project/project_autosave.h"

#include "core/base/durable_file.h"

#include <QUuid>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// The member of a copy that names the project's own file, as JSON.
constexpr const char* kFileMember = "autosave_of";

fs::path lockOf(const fs::path& copy)
{
    return copy.string() + ".lock";
}

} // namespace

ProjectAutosave::ProjectAutosave(fs::path folder, QObject* parent)
    : QObject(parent)
    , folder_(std::move(folder))
{
    pool_.setMaxThreadCount(1);
}

ProjectAutosave::~ProjectAutosave()
{
    wait();
}

// The folder, the name of the copy, and the lock.
bool ProjectAutosave::begin()
{
    if (folder_.empty() || !copy_.empty()) {
        return !copy_.empty();
    }
    std::error_code problem;
    fs::create_directories(folder_, problem);
    const fs::path copy =
        folder_ / (QUuid::createUuid().toString(QUuid::Id128).toStdString() + ".mvproj");
    auto lock = FileLock::tryLock(lockOf(copy).string(), FileLock::Kind::Exclusive);
    if (!lock || !*lock) {
        return false;
    }
    lock_ = std::move(*lock);
    copy_ = copy;
    return true;
}

void ProjectAutosave::write(const Project& project, const fs::path& file)
{
    if (!begin()) {
        return;
    }
    // Paths of a copy are absolute: nothing lies in or next to this folder.
    pool_.start([named = project, file, copy = copy_]() mutable {
        named.others[kFileMember] = QStringLiteral("\"%1\"")
                                        .arg(QString::fromStdString(file.string())
                                                 .replace(QLatin1Char('\\'), QStringLiteral("\\\\"))
                                                 .replace(QLatin1Char('"'), QStringLiteral("\\\"")))
                                        .toStdString();
        const auto text = projectText(named, {.project = copy.parent_path(), .bundled = {}});
        if (text) {
            // If it cannot be written, the project itself is still there.
            [[maybe_unused]] const Status status = replaceFile(copy, *text);
        }
    });
}

void ProjectAutosave::discard()
{
    wait();
    if (!copy_.empty()) {
        std::error_code ignored;
        fs::remove(copy_, ignored);
        lock_.reset();
        copy_.clear();
    }
}

std::vector<LeftoverProject> ProjectAutosave::leftovers() const
{
    std::vector<std::pair<fs::file_time_type, LeftoverProject>> found;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder_, problem)) {
        const fs::path& copy = entry.path();
        if (!isProjectPath(copy.string()) || FileLock::isHeld(lockOf(copy).string())) {
            continue;
        }
        auto project = readProject(copy, {});
        if (!project) {
            continue;
        }
        LeftoverProject leftover{.copy = copy, .file = {}, .project = std::move(*project)};
        if (const auto file = leftover.project.others.extract(kFileMember)) {
            std::string name = file.mapped();
            if (name.size() >= 2) {
                leftover.file = QString::fromStdString(name.substr(1, name.size() - 2))
                                    .replace(QStringLiteral("\\\""), QStringLiteral("\""))
                                    .replace(QStringLiteral("\\\\"), QStringLiteral("\\"))
                                    .toStdString();
            }
        }
        found.emplace_back(entry.last_write_time(problem), std::move(leftover));
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<LeftoverProject> leftovers;
    for (auto& [time, leftover] : found) {
        leftovers.push_back(std::move(leftover));
    }
    return leftovers;
}

void ProjectAutosave::remove(const LeftoverProject& leftover)
{
    std::error_code ignored;
    fs::remove(leftover.copy, ignored);
    fs::remove(lockOf(leftover.copy), ignored);
}

} // namespace marsview
