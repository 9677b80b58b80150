#ifndef ODE_PREDICTIVE_SPACE_RECORDING_NOTICES_H
#define ODE_PREDICTIVE_SPACE_RECORDING_NOTICES_H

#include <cstdint>
#include <mutex>
#include <unordered_map>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::recording
{
/// Is called for each notice that a space gets: ODE reports that a geom in it has moved or was set to where it was.
class NoticeListener
{
public:
    virtual void notify_moved(dGeomID geom) = 0;

protected:
    ~NoticeListener() = default;
};

/// Notices may come from several threads.
class NoticeCounts final : public NoticeListener
{
public:
    void notify_moved(dGeomID geom) override
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        ++counts_[geom];
    }

    /// The number of notices of a geom since the last call for it.
    std::uint32_t take(dGeomID geom)
    {
        const std::lock_guard<std::mutex> guard(mutex_);
        const auto place = counts_.find(geom);
        if (place == counts_.end())
            return 0;
        const std::uint32_t count = place->second;
        counts_.erase(place);
        return count;
    }

private:
    std::mutex mutex_;
    std::unordered_map<dGeomID, std::uint32_t> counts_;
};

} // namespace ode_predictive_space::recording

// For the launcher, which comes from the same build as the library; not for programs.
extern "C" {
/// Gives a predictive space's notices to a listener until it stops listening or the space is destroyed. May be repeated.
ODE_PREDICTIVE_API void ode_predictive_space_listen(dSpaceID space,
                                                    ode_predictive_space::recording::NoticeListener *listener);

ODE_PREDICTIVE_API void ode_predictive_space_stop_listening(ode_predictive_space::recording::NoticeListener *listener);
}

#endif
