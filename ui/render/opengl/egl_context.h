// An OpenGL context without a window, a display server or Qt.
#pragma once

#include "core/base/result.h"

#include <memory>

namespace marsview {

/// A context that is current on the thread that made it, for as long as it lives. Draw into frame
/// buffer objects: it has no surface.
class EglContext {
public:
    /// Unsupported where the machine has no driver for it.
    static Result<std::unique_ptr<EglContext>> create();
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

private:
    EglContext() = default;

    void* display_ = nullptr;
    void* context_ = nullptr;
};

} // namespace marsview
