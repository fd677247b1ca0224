#include "ui/render/opengl/unfinished_draws.h"

namespace marsview {
namespace {

// Some 100 bytes each.
constexpr std::size_t kTrianglesPerPiece = 65'536;
constexpr std::size_t kPiecesMax = 8;

constexpr GLuint64 kSecond = 1'000'000'000;

} // namespace

UnfinishedDraws::~UnfinishedDraws()
{
    for (const GLsync fence : sent_) {
        glDeleteSync(fence);
    }
}

void UnfinishedDraws::add(std::size_t triangles)
{
    unsent_ += triangles;
    if (unsent_ < kTrianglesPerPiece) {
        return;
    }
    unsent_ = 0;
    sent_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    glFlush();
    if (sent_.size() > kPiecesMax) {
        waitForOldest();
    }
}

void UnfinishedDraws::waitForOldest()
{
    while (glClientWaitSync(sent_.front(), 0, kSecond) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(sent_.front());
    sent_.pop_front();
}

} // namespace marsview
