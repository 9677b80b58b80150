#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_VIEW_WRITER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_VIEW_WRITER_H

#include "demos/haptic/geom_reader.h"
#include "demos/haptic/haptic_run.h"
#include "demos/window/view.h"
#include "ode_predictive_space/prediction/history.h"

#include <limits>

namespace ode_predictive_space::demo
{
/// For the thread that steps the scene, unless noted.
class ViewWriter
{
public:
    /// @param picture_time s, simulated; the view of exactly that time is held for a picture. Infinite: none is.
    ViewWriter(const HapticRun &run, haptics::Snapshot<window::SceneView> &views, double picture_time);

    /// Continue the view; publish it when it is complete and the previous one has lasted for a frame.
    void after_step();

    /// Any thread may call this when the picture has been taken.
    void picture_taken() { holding_.store(false, std::memory_order_release); }

private:
    void finish(window::SceneView &view) const;
    void write_path(window::ProbeView &probe) const;
    void write_near_pairs(std::vector<window::NearPair> &pairs) const;

    const HapticRun &run_;
    haptics::Snapshot<window::SceneView> &views_;
    double picture_time_;
    std::atomic<bool> holding_{false};
    GeomReader reader_;
    History history_; ///< of the probe's places
    std::uint32_t steps_ = 0;
    std::chrono::steady_clock::time_point last_published_{};
};
} // namespace ode_predictive_space::demo

#endif
