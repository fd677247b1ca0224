#include "ui/render/relief_loader.h"

#include <algorithm>

namespace marsview {
namespace {

// Of a tile that could not be read.
constexpr std::chrono::seconds kRetryAfter{3};

// One core is left to the thread that draws.
std::size_t threadCount()
{
    const std::size_t cores = std::max(2U, std::thread::hardware_concurrency());
    return std::min<std::size_t>(cores - 1, 4);
}

} // namespace

ReliefTileId reliefTileOf(const DetailNode& node)
{
    return {node.level - kReliefLevelMin, node.column, node.row};
}

ReliefLoader::ReliefLoader(std::function<void()> notify)
    : notify_(std::move(notify))
{
    for (std::size_t i = 0; i < threadCount(); ++i) {
        threads_.emplace_back([this] { run(); });
    }
}

ReliefLoader::~ReliefLoader()
{
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
        wanted_.clear();
    }
    has_work_.notify_all();
}

std::size_t ReliefLoader::request(std::vector<ReliefRequest> requests)
{
    std::size_t count = 0;
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(failures_, [](const Failure& failure) {
            return failure.retry_at <= std::chrono::steady_clock::now();
        });
        problem_.reset();
        std::erase_if(requests, [this](const ReliefRequest& request) {
            const auto failure =
                std::find_if(failures_.begin(), failures_.end(),
                             [&](const Failure& f) { return f.key == request.key; });
            if (failure == failures_.end()) {
                return false;
            }
            problem_ = failure->error;
            return true;
        });
        count = requests.size();
        std::erase_if(requests, [this](const ReliefRequest& request) {
            return std::find(in_work_.begin(), in_work_.end(), request.key) != in_work_.end() ||
                   std::any_of(finished_.begin(), finished_.end(), [&](const ReliefResult& result) {
                       return result.key == request.key;
                   });
        });
        std::reverse(requests.begin(), requests.end());
        wanted_ = std::move(requests);
    }
    has_work_.notify_all();
    return count;
}

std::vector<ReliefResult> ReliefLoader::take(std::size_t count_max)
{
    const std::lock_guard lock(mutex_);
    const auto count = static_cast<std::ptrdiff_t>(std::min(count_max, finished_.size()));
    std::vector<ReliefResult> taken(std::make_move_iterator(finished_.begin()),
                                    std::make_move_iterator(finished_.begin() + count));
    finished_.erase(finished_.begin(), finished_.begin() + count);
    return taken;
}

bool ReliefLoader::isLoading() const
{
    const std::lock_guard lock(mutex_);
    return !wanted_.empty() || !in_work_.empty();
}

void ReliefLoader::waitForPending()
{
    std::unique_lock lock(mutex_);
    has_result_.wait(lock, [this] { return wanted_.empty() && in_work_.empty(); });
}

std::optional<std::chrono::steady_clock::time_point> ReliefLoader::nextRetry() const
{
    std::optional<std::chrono::steady_clock::time_point> next;
    for (const Failure& failure : failures_) {
        if (!failure.is_reported) {
            next = next ? std::min(*next, failure.retry_at) : failure.retry_at;
        }
    }
    return next;
}

bool ReliefLoader::takeDueRetries()
{
    bool is_any = false;
    for (Failure& failure : failures_) {
        if (!failure.is_reported && failure.retry_at <= std::chrono::steady_clock::now()) {
            failure.is_reported = true;
            is_any = true;
        }
    }
    return is_any;
}

void ReliefLoader::run()
{
    std::unique_lock lock(mutex_);
    while (true) {
        while (!is_stopping_ && wanted_.empty()) {
            if (const auto retry_at = nextRetry()) {
                has_work_.wait_until(lock, *retry_at);
            } else {
                has_work_.wait(lock);
            }
            if (!is_stopping_ && takeDueRetries() && notify_) {
                lock.unlock();
                notify_();
                lock.lock();
            }
        }
        if (is_stopping_) {
            return;
        }
        const ReliefRequest request = std::move(wanted_.back());
        wanted_.pop_back();
        in_work_.push_back(request.key);
        lock.unlock();
        Result<ReliefTile> tile =
            loadReliefTile(*request.heightfield, request.frame, reliefTileOf(request.key.node),
                           request.slope_max, request.sides);
        lock.lock();
        std::erase(in_work_, request.key);
        if (tile) {
            finished_.push_back({request.key, std::move(*tile)});
        } else {
            failures_.push_back({request.key, std::chrono::steady_clock::now() + kRetryAfter,
                                 std::move(tile).error()});
            has_work_.notify_all(); // there is a time to wake up at
        }
        has_result_.notify_all();
        if (notify_ && !is_stopping_) {
            lock.unlock();
            notify_();
            lock.lock();
        }
    }
}

} // namespace marsview
