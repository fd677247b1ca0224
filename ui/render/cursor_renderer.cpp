#include "ui/render/cursor_renderer.h"

#include "ui/render/cursor_solids.h"

#include <utility>

namespace marsview {

struct CursorRenderer::Impl {
    std::unique_ptr<CursorSolids> solids;
};

CursorRenderer::CursorRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

CursorRenderer::~CursorRenderer() = default;

Result<std::unique_ptr<CursorRenderer>> CursorRenderer::create()
{
    Result<std::unique_ptr<CursorSolids>> solids = CursorSolids::create();
    if (!solids) {
        return std::move(solids).error();
    }
    return std::unique_ptr<CursorRenderer>(
        new CursorRenderer(std::make_unique<Impl>(Impl{.solids = std::move(solids).value()})));
}

void CursorRenderer::draw(const CursorPicture& cursor,
                          const OrbitCamera& camera,
                          const Viewport& viewport,
                          const ClipRange& clip)
{
    impl_->solids->draw(cursor, {}, camera, viewport, clip);
}

} // namespace marsview
