// The contact of a sphere from tick to tick, with the side from which it entered each object.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_TRACKER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_TRACKER_H

#include "ode_predictive_space/haptics/contact/held_geoms.h"
#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/contact/sphere_slide.h"
#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include <string_view>

namespace ode_predictive_space::haptics
{
bool is_finite(const Touch &touch);

/// Drops the touches beyond the capacity. @return whether any was dropped.
bool keep_within_capacity(std::vector<Touch> &touches);

constexpr std::string_view capacity_notice = "More than 256 surfaces are touched or near at once. Those that are "
                                             "farthest away, or push least, give no force.";
static_assert(touch_capacity == 256);

struct TouchOfGeom
{
    dGeomID geom;
    Touch touch;
};

/// Keeps a proxy of the tool, which never passes a surface: in each tick it moves towards the tool. Its place is stored in the
/// frame of each geom, so that moving geoms carry it. The surfaces that hold the proxy off the tool are touched. Call order in
/// each tick: begin(), aim(), add_if_near() for each geom of the near callback, follow(), touches(). The region() contains all
/// touched surfaces, so the contact of a geom that is not reported has ended.
///
/// With two threads there are two trackers. The servo's owns the sides of entry: in each tick it gets the geoms that the
/// scene's tracker found at the last step, moved to their present poses. The scene's continues from the servo's memory:
/// adopt(), and near() after all add_if_near().
class ContactTracker
{
public:
    explicit ContactTracker(double radius);

    struct Region
    {
        Vector3 centre = Vector3::Zero(); ///< m
        double radius = 0;                ///< m
    };

    void set_margin(double margin) { margin_ = margin; }
    double margin() const { return margin_; }

    /// N/m; for objects without a material. It bounds how fast the proxy may catch up.
    void set_stiffness(double stiffness) { stiffness_ = stiffness; }

    void set_tick_length(double seconds) { tick_length_ = seconds; }

    /// Forgets the geoms, but not the sides of entry.
    void begin();

    /// Forgets the sides, too: the tool was put elsewhere.
    void forget();

    /// For the scene's tracker, after begin(): takes the proxy of the servo's tracker.
    void adopt(const ContactMemory &memory);

    void aim(const Vector3 &tool) { course_.aim(tool); }

    const Vector3 &tool() const { return course_.tool; } ///< m; in the scene's frame

    /// m; the proxy before follow(), in the scene's frame.
    const Vector3 &start() const { return course_.start; }

    Region region() const;

    /// m; start(), carried by the motion of a geom since the tick before.
    Vector3 start_beside(dGeomID geom) const;

    TriangleList touched_triangles(dGeomID geom) const;

    void add(NearbyGeom geom, double distance = 0);

    /// Adds a geom if its surface is in the region(). The nearest comes first, so that the result does not depend on the space.
    void add_if_near(NearbyGeom geom);

    bool exceeds_capacity() const { return near_.exceeds_capacity(); }

    const std::vector<HeldGeom> &near() const { return near_.list(); }

    void follow();

    std::size_t visited() const { return visited_; }

    const Vector3 &proxy() const { return course_.proxy; }

    /// Appends the touches, and surfaces nearer than the margin. @return false when a touch was left out as not finite.
    bool touches(TouchView view, std::vector<Touch> &touches);

    /// For the servo's tracker, after follow(): fills in the memory for adopt().
    void remember_in(ContactMemory &memory) const;

private:
    struct Course
    {
        bool has_proxy = false;
        Vector3 tool = Vector3::Zero();
        Vector3 travel = Vector3::Zero(); ///< of the tool, since the tick before
        Vector3 start = Vector3::Zero();  ///< the proxy when the tick began
        Vector3 proxy = Vector3::Zero();  ///< when it was over

        void aim(const Vector3 &to);
    };

    bool is_gone(const TouchOfGeom &reported) const;
    double longest_travel() const;
    double travel_of_force() const;
    double travel_of_bodies() const;
    SphereSlide::Task task() const;
    bool held_by_body() const;
    void settle();
    Vector3 lag_at(const Vector3 &place) const;
    Vector3 remaining_lift() const;
    void report_together(TouchView view);
    void report_former_carriers(const Vector3 &lag);
    double report_planes(const Vector3 &lag);
    double yield_at(const SlidePlane &plane) const;
    bool share_out(TouchView view);
    void report_each_object();

    double radius_;
    double margin_ = 0;
    double stiffness_ = 1000;
    double tick_length_ = 0.001;
    Course course_;
    HeldGeoms near_;
    /// A geom that carried the proxy is gone, and the proxy has not reached the tool since: only present touches give a force.
    bool released_ = false;
    bool carries_on_ = false; ///< the proxy was moving to the tool without a touch in the tick before
    double catch_up_ = 0;     ///< m; allowed travel of the proxy beyond the tool's travel
    SphereSlide slide_;
    std::vector<SlidePlace> places_;        ///< of the slide
    bool common_ = true;                    ///< all geoms have the same place of the proxy
    std::size_t visited_ = 0;               ///< triangles
    std::vector<ConstraintPlane> yielding_; ///< the planes of the slide, with shares
    TwoTicks<TouchOfGeom> reported_;
};
} // namespace ode_predictive_space::haptics

#endif
