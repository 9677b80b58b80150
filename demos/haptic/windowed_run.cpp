#include "demos/haptic/windowed_run.h"

#include "demos/haptic/numbers.h"
#include "demos/haptic/view_writer.h"
#include "demos/window/window.h"
#include "ode_predictive_space/haptics/mouse_device.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace ode_predictive_space::demo
{
namespace
{
constexpr double stiffness_step = 1.25;
constexpr double softest = 10;       // N/m
constexpr double notice_seconds = 5; // that a notice stays in the window
constexpr double never = std::numeric_limits<double>::infinity();

/// State shared by both threads. The loop never waits for the window.
class WindowedRun : public window::Shown
{
public:
    WindowedRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                haptics::NoticeSink notice);

    /// The loop's thread: runs when the window is open, and restarts at the person's request.
    void work();

    /// Lets work() return. Any thread may call this.
    void end();

    /// After work() has returned. @throws the exception of work(), if any.
    RunResult result() const;

    const window::View &view() override;
    bool ended() override { return ended_.load(); }
    bool key(char key) override;
    std::vector<window::KeyHelp> keys() const override;
    bool pointer(const window::Pointer &pointer) override;
    void picture_taken() override;

private:
    void wait_for_window();
    void run_once();
    void make_run();
    void forget_run();
    void read_run();
    void read_loop(const haptics::LoopReport &report);
    void read_probe();
    void read_chart(const ServoChart &chart);
    void change_stiffness(double factor);
    void begin_anew();
    void show(const haptics::Notice &notice);

    const Options &options_;
    const worlds::WorldFactory &factory_;
    DemoDevice &device_;
    haptics::NoticeSink notice_;
    haptics::MouseDevice *mouse_; ///< null for other devices
    std::optional<window::Pointer> last_pointer_;
    double picture_time_; ///< s; infinite when no further picture is due
    RunControl control_;
    haptics::Snapshot<window::SceneView> views_;
    window::View view_; ///< the window's own
    std::atomic<bool> begin_anew_{false};
    std::atomic<bool> ended_{false};  ///< work() has returned
    std::atomic<bool> ending_{false}; ///< work() is to return
    bool window_is_there_ = false;
    std::condition_variable window_opened_;
    std::mutex run_mutex_;               ///< guards the two below
    std::unique_ptr<HapticRun> run_;     ///< null between two runs
    std::unique_ptr<ViewWriter> writer_; ///< of that run
    std::mutex notice_mutex_;
    std::string last_notice_;
    haptics::MonotonicClock clock_;
    double notice_time_ = -notice_seconds; ///< s
    RunResult result_;
    std::exception_ptr failure_;
};

WindowedRun::WindowedRun(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                         haptics::NoticeSink notice)
    : options_(options), factory_(factory), device_(device), notice_(std::move(notice)),
      mouse_(dynamic_cast<haptics::MouseDevice *>(&device.inner())),
      picture_time_(options.screenshot_file.empty() ? never : options.screenshot_time)
{
    view_.heading =
        options.scene + ", " + grouped(static_cast<std::uint64_t>(options.objects)) + " objects, " + options.space;
    view_.chart_seconds = ServoLog::column_seconds;
}

void WindowedRun::work()
{
    wait_for_window();
    dAllocateODEDataForThread(dAllocateMaskAll);
    try
    {
        do
        {
            run_once();
        } while (!ending_.load() && begin_anew_.exchange(false));
    }
    catch (...)
    {
        failure_ = std::current_exception();
    }
    forget_run();
    dCleanupODEAllDataForThread();
    ended_ = true;
}

void WindowedRun::wait_for_window()
{
    std::unique_lock<std::mutex> lock(run_mutex_);
    window_opened_.wait(lock, [this] { return window_is_there_ || ending_.load(); });
}

void WindowedRun::run_once()
{
    make_run();
    result_ = run_->run([this] { writer_->after_step(); });
    forget_run();
}

void WindowedRun::make_run()
{
    auto run = std::make_unique<HapticRun>(options_, factory_, device_, control_,
                                           [this](const haptics::Notice &notice) { show(notice); });
    auto writer = std::make_unique<ViewWriter>(*run, views_, picture_time_);
    const std::lock_guard<std::mutex> lock(run_mutex_);
    run_ = std::move(run);
    writer_ = std::move(writer);
    if (ending_.load())
        run_->stop();
}

void WindowedRun::forget_run()
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    writer_.reset();
    run_.reset();
}

void WindowedRun::end()
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    ending_ = true;
    window_opened_.notify_all();
    if (run_)
        run_->stop();
}

void WindowedRun::begin_anew()
{
    begin_anew_ = true;
    const std::lock_guard<std::mutex> lock(run_mutex_);
    if (run_)
        run_->stop();
}

RunResult WindowedRun::result() const
{
    if (failure_)
        std::rethrow_exception(failure_);
    return result_;
}

void WindowedRun::picture_taken()
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    picture_time_ = never;
    if (writer_)
        writer_->picture_taken();
    if (run_ && options_.seconds == 0)
        run_->stop(); // the run was only for the picture
}

void WindowedRun::show(const haptics::Notice &notice)
{
    notice_(notice);
    const std::lock_guard<std::mutex> lock(notice_mutex_);
    last_notice_ = notice.sentence();
    notice_time_ = clock_.now();
}

const window::View &WindowedRun::view()
{
    if (views_.take())
    {
        static_cast<window::SceneView &>(view_) = views_.latest();
    }
    read_run();
    const std::lock_guard<std::mutex> lock(notice_mutex_);
    const bool recent = clock_.now() - notice_time_ < notice_seconds;
    view_.notice = recent && !options_.fast ? last_notice_ : ""; // simulated time would be over before it is read
    return view_;
}

void WindowedRun::read_run()
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    window_is_there_ = true;
    window_opened_.notify_all();
    if (!run_)
        return;
    view_.nominal_period = options_.fast ? 0 : 1e3 / run_->servo_rate();
    view_.readings.clear();
    if (!options_.fast) // simulated time has no periods
        read_loop(run_->report());
    read_probe();
    read_chart(run_->servo_log().chart());
}

void WindowedRun::read_loop(const haptics::LoopReport &report)
{
    const auto milliseconds = [](double seconds) { return fixed(1e3 * seconds, 2); };
    const auto times = [&](const haptics::TimeSummary &summary) {
        return milliseconds(summary.p50) + " / " + milliseconds(summary.p99) + " / " + milliseconds(summary.p999) +
               " ms";
    };
    const double wanted = run_->servo_rate();
    auto &readings = view_.readings;
    readings.push_back({"loop", fixed(report.rate, 0) + " Hz" + (run_->decoupled() ? ", decoupled" : ""),
                        report.rate < 0.95 * wanted});
    readings.push_back({"real-time factor", fixed(report.real_time_factor, 2), report.real_time_factor < 0.95});
    readings.push_back({"period p50 / p99 / p99.9", times(report.period)});
    readings.push_back({"computation", times(report.compute)});
    readings.push_back({"too long", grouped(report.overruns) + " of " + grouped(report.ticks)});
}

void WindowedRun::read_probe()
{
    auto &readings = view_.readings;
    const double force = view_.probe.force.norm();
    readings.push_back({"force", fixed(force, 2) + " N"});
    readings.push_back({"stiffness at the hand", fixed(control_.stiffness.load(), 0) + " N/m"});
    readings.push_back({"near pairs", grouped(view_.near_pairs.size())});
    std::string next = "-";
    for (const window::Meeting &meeting : view_.probe.meetings)
    {
        if (meeting.seconds > 0)
        {
            next = "in " + fixed(1e3 * meeting.seconds, 0) + " ms";
            break;
        }
    }
    readings.push_back({"next encounter", next});
    readings.push_back({"simulated time", fixed(view_.time, 2) + " s"});
}

void WindowedRun::read_chart(const ServoChart &chart)
{
    view_.chart.clear();
    const std::uint64_t first = chart.made - std::min<std::uint64_t>(chart.made, ServoChart::columns);
    for (std::uint64_t i = first; i < chart.made; ++i)
    {
        const ServoColumn &column = chart.ring[i % ServoChart::columns];
        view_.chart.push_back({static_cast<float>(column.force), static_cast<float>(1e3 * column.period),
                               static_cast<float>(1e3 * column.compute)});
    }
}

void WindowedRun::change_stiffness(double factor)
{
    const std::lock_guard<std::mutex> lock(run_mutex_);
    if (!run_)
        return;
    const double wish = factor * control_.stiffness.load();
    control_.stiffness = std::clamp(wish, softest, std::max(softest, run_->max_stiffness()));
    if (wish > run_->max_stiffness())
    {
        const std::lock_guard<std::mutex> notice_lock(notice_mutex_);
        notice_time_ = clock_.now();
        last_notice_ = "The device can render no more than " + fixed(run_->max_stiffness(), 0) + " N/m";
    }
}

bool WindowedRun::key(char key)
{
    switch (key)
    {
    case ' ':
        control_.paused = !control_.paused.load();
        return true;
    case '+':
    case '=':
        change_stiffness(stiffness_step);
        return true;
    case '-':
        change_stiffness(1 / stiffness_step);
        return true;
    case 'c':
        device_.hold_clutch(!device_.clutch_held());
        return true;
    case 'r':
        begin_anew();
        return true;
    default:
        return false;
    }
}

std::vector<window::KeyHelp> WindowedRun::keys() const
{
    return {{"space", "pause", control_.paused.load()},
            {"+ -", "stiffness"},
            {"c", "clutch", device_.clutch_held()},
            {"r", "restart"}};
}

bool WindowedRun::pointer(const window::Pointer &pointer)
{
    if (mouse_ == nullptr)
        return false;
    mouse_->wheel(pointer.wheel);
    const bool moves_camera = pointer.buttons != 0;
    if (last_pointer_ && !moves_camera)
        mouse_->pointer(pointer.x - last_pointer_->x, pointer.y - last_pointer_->y);
    last_pointer_ = pointer;
    return !moves_camera;
}

class Joined
{
public:
    Joined(WindowedRun &run) : run_(run), thread_([&run] { run.work(); }) {}
    ~Joined()
    {
        run_.end();
        thread_.join();
    }
    Joined(const Joined &) = delete;
    Joined &operator=(const Joined &) = delete;

private:
    WindowedRun &run_;
    std::thread thread_;
};
} // namespace

RunResult run_in_window(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                        const haptics::NoticeSink &notice)
{
    window::WindowSettings settings;
    settings.screenshot = options.screenshot_file;
    settings.screenshot_time = options.screenshot_time;
    WindowedRun run(options, factory, device, notice);
    {
        const Joined thread(run);
        window::run_window(run, settings);
    }
    return run.result();
}
} // namespace ode_predictive_space::demo
