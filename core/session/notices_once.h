// Notices that are shown to the user once.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

/// The first caller to take them shows them. Any thread.
class NoticesOnce {
public:
    void add(std::string notice)
    {
        const std::lock_guard lock(mutex_);
        notices_.push_back(std::move(notice));
    }

    /// All notices not taken yet.
    std::vector<std::string> take()
    {
        const std::lock_guard lock(mutex_);
        return std::exchange(notices_, {});
    }

private:
    std::mutex mutex_;
    std::vector<std::string> notices_;
};

} // namespace marsview
