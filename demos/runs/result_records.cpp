#include "demos/runs/result_records.h"

#include "demos/runs/table.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace ode_predictive_space::worlds
{
nlohmann::json record_of(const WorldRun &run, const WorldSpec &spec)
{
    const Statistics times = summarise(run.collide_times());
    return {{"scene", spec.name},
            {"n", spec.objects},
            {"space", run.name()},
            {"seed", spec.seed},
            {"ticks", run.ticks()},
            {"measured_ticks", run.measured_ticks()},
            {"mean_us", times.mean},
            {"median_us", times.median},
            {"p99_us", times.p99},
            {"p999_us", times.p999},
            {"max_us", times.max},
            {"pairs", run.pairs()},
            {"pair_hash", hexadecimal(run.pair_hash())},
            {"false_pairs", run.false_pairs()},
            {"contacts", run.contacts()}};
}

void write_json(const std::string &file, const nlohmann::json &value)
{
    errno = 0;
    std::ofstream out(file);
    out << value.dump(2) << '\n';
    out.close();
    if (!out)
        throw std::runtime_error(file + " cannot be written: " + std::strerror(errno ? errno : EIO));
}
} // namespace ode_predictive_space::worlds
