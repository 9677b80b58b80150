// On which side of things the probe is: the contact of a sphere, from tick to tick.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_TRACKER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_TRACKER_H

#include "ode_predictive_space/haptics/contact/held_geoms.h"
#include "ode_predictive_space/haptics/contact/numbered_touches.h"
#include "ode_predictive_space/haptics/contact/sphere_slide.h"
#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include <string_view>

namespace ode_predictive_space::haptics
{
/// Whether all numbers of a touch are.
bool is_finite(const Touch &touch);

/// Leaves out the touches beyond the capacity. @return whether there were any.
bool keep_within_capacity(std::vector<Touch> &touches);

/// One notice for all touches and geoms beyond the capacity.
constexpr std::string_view capacity_notice = "More than 256 surfaces are touched or near at once. Those that are "
                                             "farthest away, or hold off least, give no force.";
static_assert(touch_capacity == 256);

/// Keeps a proxy of the tool, which never passes a surface: each tick it goes from where it was towards the tool. With
/// respect to each geom its place is remembered in the geom's frame, so that it goes with what moves and turns. What holds
/// the proxy off the tool is touched, from the proxy's side.
///
/// Each tick: begin(), aim(), add_if_near() for each geom that the near callback tells, follow(), touches(). The region() in which
/// geoms are looked for holds all that the proxy touches: the contact of a geom that is not told has ended.
///
/// In two threads there are two. The servo's owns the sides: each tick it is given the geoms that the scene's found at the
/// last step, where they are by now. The scene's goes on from the servo's memory in each step: adopt(), and hand_over()
/// after all add_if_near().
class ContactTracker
{
public:
    explicit ContactTracker(double radius);

    /// A ball in the scene.
    struct Region
    {
        Vector3 centre = Vector3::Zero(); ///< m
        double radius = 0;                ///< m
    };

    void set_margin(double margin) { margin_ = margin; }

    /// N/m; of what has no material of its own. While a force is rendered, the proxy catches up no faster than the force may change.
    void set_stiffness(double stiffness) { stiffness_ = stiffness; }

    /// s; for how long bodies get the force of a tick.
    void set_tick_length(double seconds) { tick_length_ = seconds; }

    /// Forget what is near, but not on which side of it the proxy is.
    void begin();

    /// Forget that, too: the tool is somewhere else now, and nothing lies between.
    void forget();

    /// Of the scene's tracker, after begin(): another one, which has gone on meanwhile, knows where the proxy is.
    void adopt(const ContactMemory &memory);

    void aim(const Vector3 &tool) { course_.aim(tool); }

    const Vector3 &tool() const { return course_.tool; } ///< m; in the scene's frame

    /// m; in the scene's frame: the proxy before it follows.
    const Vector3 &start() const { return course_.start; }

    /// Where to look for geoms.
    Region region() const;

    /// m; the same where a geom has carried it since the tick before.
    Vector3 start_beside(dGeomID geom) const;

    /// Triangles of a mesh that were touched in the tick before.
    TriangleList touched_triangles(dGeomID geom) const;

    void add(NearbyGeom geom) { insert(std::move(geom), 0); }

    /// The same for a geom whose surface is in the region(). The nearest comes first, so that what is felt does not depend on which
    /// geoms around the region a space tells, and in which order.
    void add_if_near(NearbyGeom geom);

    /// Whether there were more geoms in this tick than the capacity: the farthest ones were left out.
    bool exceeds_capacity() const { return near_.exceeds_capacity(); }

    /// Hands the geoms that were added to the scene's tracker over to that of the servo.
    ///
    /// @param time s; when this was so.
    void hand_over(NearbyGeoms &geoms, double time) const;

    /// The proxy goes as near to the tool as it can.
    void follow();

    /// How many triangles were visited in this tick.
    std::size_t visited() const { return visited_; }

    /// m; in the scene's frame.
    const Vector3 &proxy() const { return course_.proxy; }

    /// Append what is touched, or nearer than the margin.
    ///
    /// @return whether that is all: false when something of a touch is not a number. Such a touch is left out.
    bool touches(TouchView view, std::vector<Touch> &touches);

    /// Of the servo's tracker, after follow(): for adopt().
    void remember_in(ContactMemory &memory) const;

private:
    /// The tool, and the proxy that follows it. m; the scene's frame.
    struct Course
    {
        bool has_proxy = false;
        Vector3 tool = Vector3::Zero();
        Vector3 travel = Vector3::Zero(); ///< of the tool, since the tick before
        Vector3 start = Vector3::Zero();  ///< the proxy when the tick began
        Vector3 proxy = Vector3::Zero();  ///< when it was over

        void aim(const Vector3 &to);
    };

    void insert(NearbyGeom geom, double distance);
    bool is_gone(const TouchOfGeom &told) const;
    double longest_way() const;
    double way_of_force() const;
    double way_of_bodies() const;
    SphereSlide::Task task() const;
    bool held_by_body() const;
    void settle();
    Vector3 lag_at(const Vector3 &place) const;
    Vector3 remaining_lift() const;
    void tell_together(TouchView view);
    double tell_planes(const Vector3 &lag);
    double yield_at(const SlidePlane &plane) const;
    bool share_out(TouchView view);
    void tell_each_object();

    double radius_;
    double margin_ = 0;
    double stiffness_ = 1000;
    double tick_length_ = 0.001;
    Course course_;
    HeldGeoms near_;
    /// What carried the proxy is gone, and it has not come to rest since: no force but by what it touches.
    bool released_ = false;
    bool carries_on_ = false; ///< in the tick before, the proxy was on its way to the tool, and touched nothing
    double catch_up_ = 0;     ///< m; how far the proxy may go in a tick beyond the tool's way, by what was near before
    SphereSlide slide_;
    std::vector<SlidePlace> places_;        ///< of the slide
    bool common_ = true;                    ///< all geoms see the proxy at the same place
    std::size_t visited_ = 0;               ///< triangles
    std::vector<ConstraintPlane> yielding_; ///< what the slide found, with shares
    NumberedTouches told_;
};
} // namespace ode_predictive_space::haptics

#endif
