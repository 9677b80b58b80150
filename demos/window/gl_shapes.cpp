#include "demos/window/gl_shapes.h"

#include <GL/gl.h>
#include <GL/glu.h>
#include <algorithm>
#include <cmath>
#include <memory>

namespace ode_predictive_space::window
{
namespace
{
constexpr int facets = 24; // around a curved shape

struct QuadricDeleter
{
    void operator()(GLUquadric *quadric) const { gluDeleteQuadric(quadric); }
};

/// Restores OpenGL's state at its end: drawstuff expects no other drawing.
class StateKept
{
public:
    StateKept()
    {
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        glMatrixMode(GL_MODELVIEW);
        glPushMatrix();
    }
    ~StateKept()
    {
        glPopMatrix();
        glPopAttrib();
    }
    StateKept(const StateKept &) = delete;
    StateKept &operator=(const StateKept &) = delete;
};

void paint(const Colour &colour, float opacity)
{
    const float rgba[4] = {colour.red, colour.green, colour.blue, opacity};
    glColor4fv(rgba);
    const float ambient[4] = {0.5f * colour.red, 0.5f * colour.green, 0.5f * colour.blue, opacity};
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, ambient);
    glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, rgba);
}

/// Turns the z axis into a direction.
void turn_z_to(const Vector3 &direction)
{
    const Vector3 axis = Vector3::UnitZ().cross(direction);
    const double angle = std::atan2(axis.norm(), direction.z()) * 180 / 3.14159265358979323846;
    // When z already has that direction, or the opposite one, any perpendicular axis will do.
    const Vector3 around = axis.norm() > 1e-9 ? axis : Vector3::UnitX();
    glRotated(angle, around.x(), around.y(), around.z());
}

/// A picture of a glass ball: opaque at the rim. Mapped by the direction in which a surface faces, as seen from the camera.
GLuint make_rim_texture()
{
    constexpr int size = 64;
    std::vector<unsigned char> alpha(size * size);
    for (int y = 0; y < size; ++y)
    {
        for (int x = 0; x < size; ++x)
        {
            // In a sphere map, the distance r from the middle belongs to a normal that is turned away from us by
            // asin(r): the cosine is what faces us.
            const double u = 2 * (x + 0.5) / size - 1;
            const double v = 2 * (y + 0.5) / size - 1;
            const double facing = std::sqrt(std::max(0.0, 1 - u * u - v * v));
            alpha[static_cast<std::size_t>(y * size + x)] =
                static_cast<unsigned char>(255 * (0.12 + 0.88 * std::pow(1 - facing, 2.5)));
        }
    }
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, size, size, 0, GL_ALPHA, GL_UNSIGNED_BYTE, alpha.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

void look_like_glass()
{
    static const GLuint rim = make_rim_texture(); // one window per process
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, rim);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    for (const auto &[coordinate, generator] : {std::pair{GL_S, GL_TEXTURE_GEN_S}, {GL_T, GL_TEXTURE_GEN_T}})
    {
        glTexGeni(static_cast<GLenum>(coordinate), GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
        glEnable(static_cast<GLenum>(generator));
    }
    glDisable(GL_LIGHTING);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
}
} // namespace

void draw_background(const Colour &above, const Colour &below)
{
    const StateKept kept;
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_LIGHTING);
    glDisable(GL_TEXTURE_2D);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glShadeModel(GL_SMOOTH);
    glLoadIdentity();
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glBegin(GL_QUADS);
    glColor3f(above.red, above.green, above.blue);
    glVertex2f(1, 1);
    glVertex2f(-1, 1);
    glColor3f(below.red, below.green, below.blue);
    glVertex2f(-1, -1);
    glVertex2f(1, -1);
    glEnd();
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
}

void draw_lines(const std::vector<Segment> &lines, const Colour &colour, float opacity, float width)
{
    const StateKept kept;
    glDisable(GL_LIGHTING);
    glDisable(GL_TEXTURE_2D);
    glEnable(GL_LINE_SMOOTH);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glLineWidth(width);
    glColor4f(colour.red, colour.green, colour.blue, opacity);
    glBegin(GL_LINES);
    for (const auto &[from, to] : lines)
    {
        glVertex3dv(from.data());
        glVertex3dv(to.data());
    }
    glEnd();
}

void draw_arrow(const Vector3 &from, const Vector3 &along, double thickness, const Colour &colour)
{
    const StateKept kept;
    const std::unique_ptr<GLUquadric, QuadricDeleter> quadric(gluNewQuadric());
    const double length = along.norm();
    const double head = std::min(2.5 * thickness, length);
    glDisable(GL_TEXTURE_2D);
    glDisable(GL_CULL_FACE);
    glEnable(GL_LIGHTING);
    glShadeModel(GL_SMOOTH);
    paint(colour, 1);
    glTranslated(from.x(), from.y(), from.z());
    turn_z_to(along);
    gluCylinder(quadric.get(), thickness / 2, thickness / 2, length - head, facets, 1);
    glTranslated(0, 0, length - head);
    gluCylinder(quadric.get(), thickness, 0, head, facets, 1);
    gluDisk(quadric.get(), 0, thickness, facets, 1);
}

void draw_glass_balls(const std::vector<EnvelopeBall> &balls, const Colour &colour, float opacity)
{
    const StateKept kept;
    const std::unique_ptr<GLUquadric, QuadricDeleter> quadric(gluNewQuadric());
    look_like_glass();
    paint(colour, opacity);
    for (const EnvelopeBall &ball : balls)
    {
        glPushMatrix();
        glTranslated(ball.centre.x(), ball.centre.y(), ball.centre.z());
        gluSphere(quadric.get(), ball.radius, facets, facets);
        glPopMatrix();
    }
}
} // namespace ode_predictive_space::window
