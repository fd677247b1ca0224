#include "ui/render/body_uniforms.h"

#include "core/globe/body_camera.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>

namespace marsview {
namespace {

constexpr double kOverlapCells = 0.05;

GLfloat asFloat(double value)
{
    return static_cast<GLfloat>(value);
}

// The pole that the triangles next to the first or last row end at, and its height.
std::array<GLfloat, 4>
poleFromEye(const CameraPose& pose, const BodySubject& subject, BodyGrid::Pole pole, float height_m)
{
    const double height =
        subject.exaggeration * (subject.surface->baseMeters() + static_cast<double>(height_m));
    const Vec3 p = subject.grid->atPole(pole, height) - pose.eye;
    return {asFloat(p.x), asFloat(p.y), asFloat(p.z), height_m};
}

// Where other maps lie over this one.
void setCovers(const GlProgram& program, const BodySubject& subject, GLint first_unit)
{
    for (std::size_t i = 0; i < subject.covers.size(); ++i) {
        const BodyCover& cover = subject.covers[i];
        const auto set_pole = [&](std::size_t pole, BodyGrid::Pole at) {
            std::optional<GridPoint> start;
            const std::array<float, 3> place =
                placeOnCover(cover, subject.grid->atPole(at, 0.0), start);
            const std::string name =
                fmt::format("u_cover_pole[{}]", pole * subject.covers.size() + i);
            glUniform3fv(program.uniform(name.c_str()), 1, place.data());
        };
        set_pole(0, subject.grid->poleAtFirstRow());
        set_pole(1, subject.grid->poleAtLastRow());
        const std::string element = fmt::format("[{}]", i);
        glUniform1i(program.uniform(("u_cover_place" + element).c_str()),
                    first_unit + static_cast<GLint>(BodyAtlas::kTextures + i));
        glUniform1f(program.uniform(("u_cover_turn" + element).c_str()), asFloat(cover.turn()));
        // Its outermost samples overlap a little: places are exact to a few hundredths of a cell.
        constexpr float kEverywhere = 1e6F;
        const BodyGrid& above = cover.locator->grid();
        const float columns = asFloat(kOverlapCells / cover.last_column);
        const float rows = asFloat(kOverlapCells / cover.last_row);
        const bool has_first_pole = above.poleAtFirstRow() != BodyGrid::Pole::None;
        const bool has_last_pole = above.poleAtLastRow() != BodyGrid::Pole::None;
        glUniform4f(
            program.uniform(("u_cover_range" + element).c_str()),
            above.closes() ? -kEverywhere : columns, above.closes() ? kEverywhere : 1.0F - columns,
            has_first_pole ? -kEverywhere : rows, has_last_pole ? kEverywhere : 1.0F - rows);
    }
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
    setCovers(program, subject, first_unit);
}

} // namespace marsview
