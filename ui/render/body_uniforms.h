// What programs that draw on a body need beside the flat scene's.
#pragma once

#include "core/view/camera.h"
#include "ui/render/body_atlas.h"
#include "ui/render/gl_program.h"

namespace marsview {

/// Sets them in the program in use. The atlas' textures are bound from `first_unit` on.
void setBodyUniforms(const GlProgram& program,
                     const CameraPose& pose,
                     const BodySubject& subject,
                     GLint first_unit);

} // namespace marsview
