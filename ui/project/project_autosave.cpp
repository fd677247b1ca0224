#include "ui/project/project_autosave.h"

#include "core/base/durable_file.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QUuid>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Members of a copy: the project's own file as JSON text, and where its annotations are.
constexpr const char* kFileMember = "autosave_of";
constexpr const char* kLogMember = "autosave_annotations";
constexpr const char* kLogEnding = ".annotations";
// A log is written again as a whole when most of its lines are of the past.
constexpr std::size_t kLinesPerItemMax = 2;
constexpr std::size_t kLinesMin = 10000;

fs::path lockOf(const fs::path& copy)
{
    return copy.string() + ".lock";
}

std::string textOf(const QJsonValue& value)
{
    const QByteArray list = QJsonDocument(QJsonArray{value}).toJson(QJsonDocument::Compact);
    return list.mid(1, list.size() - 2).toStdString(); // without the brackets
}

QJsonValue valueIn(const std::string& text)
{
    return QJsonDocument::fromJson(QByteArray::fromStdString("[" + text + "]")).array().at(0);
}

LoggedAnnotation loggedOf(const AnnotationItem& item)
{
    return {.id = item.id,
            .layer = static_cast<std::uint32_t>(item.layer),
            .annotation = annotationOf(item)};
}

} // namespace

// Runs on the pool's thread, and owns nothing that it must not release there.
struct ProjectAutosave::Job {
    const ProjectState* before = nullptr;
    const ProjectState* after = nullptr;
    std::optional<AnnotationLog> log;
    fs::path new_log;
    fs::path copy;
    bool is_written = false;

    // If a copy cannot be written, the one before and the project itself are still there.
    void run()
    {
        const fs::path old_log = log ? log->path() : fs::path();
        const auto bytes = writeLog();
        if (!bytes) {
            return;
        }
        Project named = after->project;
        named.others[kFileMember] = textOf(QString::fromStdString(after->file.string()));
        if (log) {
            QJsonArray layers;
            for (const LayerId layer : after->layers) {
                layers.append(static_cast<qint64>(layer));
            }
            named.others[kLogMember] = textOf(QJsonObject{
                {QStringLiteral("log"), QString::fromStdString(log->path().filename().string())},
                {QStringLiteral("bytes"), static_cast<qint64>(*bytes)},
                {QStringLiteral("layers"), layers}});
        }
        // Paths of a copy are absolute: nothing lies in or next to this folder.
        const auto text = projectText(named, {.project = copy.parent_path(), .bundled = {}});
        is_written = text && replaceFile(copy, *text);
        if (is_written && !old_log.empty() && (!log || log->path() != old_log)) {
            std::error_code ignored;
            fs::remove(old_log, ignored);
        }
    }
    Result<std::uint64_t> writeLog()
    {
        const ItemList<AnnotationItem>& items = after->annotations;
        const bool is_whole =
            !log || before == nullptr || log->lines() > kLinesPerItemMax * items.size() + kLinesMin;
        if (is_whole && items.empty()) {
            log.reset();
            return std::uint64_t{0};
        }
        if (is_whole) {
            auto created = AnnotationLog::create(new_log);
            if (!created) {
                return created.error();
            }
            log = std::move(*created);
        }
        Status status = Done{};
        const ItemList<AnnotationItem> none;
        ItemList<AnnotationItem>::forEachChange(
            is_whole ? none : before->annotations, items,
            [&](const AnnotationItem* was, const AnnotationItem* is) {
                if (!status) {
                    return;
                }
                if (is != nullptr && is->isComplete()) {
                    status = log->put(loggedOf(*is));
                } else if (was != nullptr) {
                    status = log->remove(was->id);
                }
            });
        if (!status) {
            return status.error();
        }
        return log->commit();
    }
};

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

void ProjectAutosave::write(ProjectState state, std::function<void()> then)
{
    if (then) {
        after_next_.push_back(std::move(then));
    }
    next_ = std::make_shared<const ProjectState>(std::move(state));
    start();
}

void ProjectAutosave::start()
{
    if (job_ || !next_) {
        return;
    }
    if (!begin()) {
        next_.reset();
        return;
    }
    writing_ = std::exchange(next_, nullptr);
    std::move(after_next_.begin(), after_next_.end(), std::back_inserter(after_writing_));
    after_next_.clear();
    job_ = std::make_shared<Job>();
    job_->before = written_.get();
    job_->after = writing_.get();
    job_->log = std::exchange(log_, std::nullopt);
    job_->new_log = folder_ / (copy_.stem().string() + "-" + std::to_string(++logs_) + kLogEnding);
    job_->copy = copy_;
    pool_.start([this, job = job_] {
        job->run();
        QMetaObject::invokeMethod(
            this,
            [this, job] {
                if (job_ == job) {
                    finish();
                }
            },
            Qt::QueuedConnection);
    });
}

// The job has run.
void ProjectAutosave::finish()
{
    const std::shared_ptr<Job> job = std::exchange(job_, nullptr);
    written_ = job->is_written ? std::exchange(writing_, nullptr) : nullptr;
    writing_.reset();
    log_ = std::exchange(job->log, std::nullopt);
    if (!job->is_written) {
        log_.reset(); // what it has is not known
    } else {
        for (const auto& then : std::exchange(after_writing_, {})) {
            then();
        }
    }
    if (std::exchange(is_discarding_, false)) {
        removeCopy();
    } else if (job->is_written) {
        Q_EMIT copied();
    }
    start();
}

void ProjectAutosave::wait()
{
    while (job_) {
        pool_.waitForDone();
        finish();
    }
}

void ProjectAutosave::discard()
{
    next_.reset();
    is_discarding_ = job_ != nullptr;
    if (!is_discarding_) {
        removeCopy();
    }
}

void ProjectAutosave::removeCopy()
{
    if (copy_.empty()) {
        return;
    }
    std::error_code ignored;
    fs::remove(copy_, ignored);
    if (log_) {
        fs::remove(log_->path(), ignored);
        log_.reset();
    }
    written_.reset();
    lock_.reset();
    copy_.clear();
}

std::vector<LeftoverProject> ProjectAutosave::leftovers() const
{
    std::vector<std::pair<fs::file_time_type, LeftoverProject>> found;
    std::error_code problem;
    std::set<fs::path> logs; // of copies
    for (const auto& entry : fs::directory_iterator(folder_, problem)) {
        const fs::path& copy = entry.path();
        if (!isProjectPath(copy.string()) || FileLock::isHeld(lockOf(copy).string())) {
            continue;
        }
        auto project = readProject(copy, {});
        if (!project) {
            continue;
        }
        LeftoverProject leftover;
        leftover.copy = copy;
        leftover.project = std::move(*project);
        if (const auto file = leftover.project.others.extract(kFileMember)) {
            leftover.file = valueIn(file.mapped()).toString().toStdString();
        }
        if (const auto log = leftover.project.others.extract(kLogMember)) {
            const QJsonObject stated = valueIn(log.mapped()).toObject();
            leftover.log = folder_ / stated[QStringLiteral("log")].toString().toStdString();
            leftover.log_bytes =
                static_cast<std::uint64_t>(stated[QStringLiteral("bytes")].toInteger());
            for (const QJsonValue& layer : stated[QStringLiteral("layers")].toArray()) {
                leftover.log_layers.push_back(static_cast<std::uint32_t>(layer.toInteger()));
            }
            const auto length = fs::file_size(leftover.log, problem);
            if (problem || length < leftover.log_bytes) {
                continue;
            }
            logs.insert(leftover.log.filename());
        }
        found.emplace_back(entry.last_write_time(problem), std::move(leftover));
    }
    removeLogsWithoutCopy(logs);
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<LeftoverProject> leftovers;
    for (auto& [time, leftover] : found) {
        leftovers.push_back(std::move(leftover));
    }
    return leftovers;
}

std::set<fs::path> ProjectAutosave::copiesInUse() const
{
    std::set<fs::path> found;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder_, problem)) {
        const fs::path& copy = entry.path();
        if (copy != copy_ && isProjectPath(copy.string()) &&
            FileLock::isHeld(lockOf(copy).string())) {
            found.insert(copy);
        }
    }
    return found;
}

// Of programs that ended before the project file of a first copy was written.
void ProjectAutosave::removeLogsWithoutCopy(const std::set<fs::path>& known) const
{
    std::error_code problem;
    std::vector<fs::path> unknown;
    for (const auto& entry : fs::directory_iterator(folder_, problem)) {
        const std::string name = entry.path().filename().string();
        const auto dash = name.rfind('-');
        if (!name.ends_with(kLogEnding) || dash == std::string::npos ||
            known.contains(entry.path().filename())) {
            continue;
        }
        const fs::path copy = folder_ / (name.substr(0, dash) + ".mvproj");
        if (!fs::exists(copy, problem) && !FileLock::isHeld(lockOf(copy).string())) {
            unknown.push_back(entry.path());
        }
    }
    for (const fs::path& log : unknown) {
        fs::remove(log, problem);
    }
}

Result<Project> ProjectAutosave::wholeProject(const LeftoverProject& leftover, JobMonitor& monitor)
{
    Project project = leftover.project;
    if (leftover.log.empty()) {
        return project;
    }
    auto logged = readAnnotationLog(leftover.log, leftover.log_bytes, monitor);
    if (!logged) {
        return logged.error();
    }
    project.annotations.reserve(logged->size());
    for (LoggedAnnotation& each : *logged) {
        const auto layer = each.layer ? std::find(leftover.log_layers.begin(),
                                                  leftover.log_layers.end(), *each.layer)
                                      : leftover.log_layers.end();
        project.annotations.push_back({.annotation = std::move(each.annotation),
                                       .layer = layer != leftover.log_layers.end()
                                                    ? std::optional(static_cast<std::size_t>(
                                                          layer - leftover.log_layers.begin()))
                                                    : std::nullopt});
    }
    return project;
}

void ProjectAutosave::remove(const LeftoverProject& leftover)
{
    std::error_code ignored;
    if (!leftover.log.empty()) {
        fs::remove(leftover.log, ignored);
    }
    fs::remove(leftover.copy, ignored);
    fs::remove(lockOf(leftover.copy), ignored);
}

} // namespace marsview
