#include "ui/render/body_uniforms.h"

#include "core/globe/body_camera.h"

#include <array>
#include <cstddef>

namespace marsview {
namespace {

GLfloat asFloat(double value)
{
    return static_cast<GLfloat>(value);
}

// A pole of the map that the triangles next to a row lead to, and its height.
std::array<GLfloat, 4>
poleFromEye(const CameraPose& pose, const BodySubject& subject, BodyGrid::Pole pole, float height_m)
{
    const double height =
        subject.exaggeration * (subject.surface->baseMeters() + static_cast<double>(height_m));
    const Vec3 p = subject.grid->atPole(pole, height) - pose.eye;
    return {asFloat(p.x), asFloat(p.y), asFloat(p.z), height_m};
}

} // namespace

void setBodyUniforms(const GlProgram& program,
                     const CameraPose& pose,
                     const BodySubject& subject,
                     GLint first_unit)
{
    constexpr std::array<const char*, BodyAtlas::kTextures> kTextures{"u_near", "u_far", "u_east",
                                                                      "u_north"};
    for (std::size_t i = 0; i < kTextures.size(); ++i) {
        glUniform1i(program.uniform(kTextures[i]), first_unit + static_cast<GLint>(i));
    }
    const Ellipsoid& ellipsoid = subject.grid->ellipsoid();
    const double axes = ellipsoid.equatorial_m / ellipsoid.polar_m;
    const BodyLattice::Split eye = subject.lattice.split(pose.eye);
    glUniform3f(program.uniform("u_eye_far"), asFloat(eye.cube[0]), asFloat(eye.cube[1]),
                asFloat(eye.cube[2]));
    glUniform3f(program.uniform("u_eye_near"), asFloat(eye.within[0]), asFloat(eye.within[1]),
                asFloat(eye.within[2]));
    glUniform1f(program.uniform("u_lattice"), asFloat(subject.lattice.side_m));
    glUniform1f(program.uniform("u_axes_squared"), asFloat(axes * axes));
    glUniform1f(program.uniform("u_exaggeration"), asFloat(subject.exaggeration));

    const BodyPlace target = placeOf(pose.eye + pose.axes.forward * pose.distance_m, ellipsoid);
    const LocalAxes local = localAxes(ellipsoid, target.foot);
    std::array<GLfloat, 9> columns{};
    std::size_t i = 0;
    for (const Vec3& axis : {local.east, local.north, local.up}) {
        for (const double value : {axis.x, axis.y, axis.z}) {
            columns[i++] = asFloat(value);
        }
    }
    glUniformMatrix3fv(program.uniform("u_target"), 1, GL_FALSE, columns.data());

    const std::array<GLfloat, 4> first =
        poleFromEye(pose, subject, subject.grid->poleAtFirstRow(), subject.pole_heights_m.front());
    const std::array<GLfloat, 4> last =
        poleFromEye(pose, subject, subject.grid->poleAtLastRow(), subject.pole_heights_m.back());
    glUniform4fv(program.uniform("u_pole[0]"), 1, first.data());
    glUniform4fv(program.uniform("u_pole[1]"), 1, last.data());
}

} // namespace marsview
