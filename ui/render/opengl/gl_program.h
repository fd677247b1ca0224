// Compiling shaders.
#pragma once

#include "core/base/result.h"

#include <memory>
#include <string>

namespace marsview {

/// A linked OpenGL program. Create, use and destroy with the same context current.
class GlProgram {
public:
    static Result<GlProgram> create(const char* vertex_source, const char* fragment_source);

    GlProgram(GlProgram&& other) noexcept;
    GlProgram& operator=(GlProgram&& other) noexcept;
    ~GlProgram();

    unsigned int id() const noexcept { return id_; }
    /// -1 where the program has no such uniform; OpenGL ignores writes to that.
    int uniform(const char* name) const;

private:
    explicit GlProgram(unsigned int id)
        : id_(id)
    {}

    unsigned int id_ = 0;
};

} // namespace marsview
