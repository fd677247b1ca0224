#include "ui/render/opengl/egl_context.h"

#include <array>
#include <epoxy/egl.h>
#include <fmt/format.h>

namespace marsview {
namespace {

Error refusal(const char* step)
{
    return {ErrorCode::Unsupported,
            fmt::format("no OpenGL without a window on this machine ({} failed, EGL error {:#x}); "
                        "install a graphics driver or Mesa's software one",
                        step, eglGetError())};
}

// Mesa's surfaceless platform if available: it needs neither a display server nor a graphics
// card. Otherwise the driver's default.
EGLDisplay openDisplay()
{
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display != EGL_NO_DISPLAY) {
            return display;
        }
    }
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

} // namespace

Result<std::unique_ptr<EglContext>> EglContext::create()
{
    std::unique_ptr<EglContext> context(new EglContext);
    const EGLDisplay display = openDisplay();
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        return refusal("opening a display");
    }
    context->display_ = display;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        return refusal("choosing OpenGL");
    }
    constexpr std::array<EGLint, 7> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT,   EGL_NONE,        EGL_NONE,
                                            EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, kConfig.data(), &config, 1, &count);
    constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    context->context_ = eglCreateContext(display, count > 0 ? config : EGL_NO_CONFIG_KHR,
                                         EGL_NO_CONTEXT, kVersion.data());
    if (context->context_ == EGL_NO_CONTEXT) {
        return refusal("making a context for OpenGL 3.3");
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context_) == EGL_FALSE) {
        return refusal("using a context without a surface");
    }
    return context;
}

EglContext::~EglContext()
{
    if (display_ == nullptr) {
        return;
    }
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != nullptr) {
        eglDestroyContext(display_, context_);
    }
    eglTerminate(display_);
}

} // namespace marsview
