// Makes a test program trap invalid operations and divisions by zero, as robotics and game programs do. If a library of the
// project makes one, the test fails and names the place in the library. ODE and all other libraries may make them.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <link.h>
#include <ucontext.h>
#include <xmmintrin.h>

#include <gtest/gtest.h>

namespace
{
constexpr unsigned trapped = _MM_MASK_INVALID | _MM_MASK_DIV_ZERO;
constexpr greg_t single_step = 0x100;

// Addresses of the project's libraries. None has more than a few segments of code.
struct Code
{
    std::uintptr_t begin, end, base;
};
std::vector<Code> our_code;

int add_if_ours(dl_phdr_info *object, std::size_t, void *)
{
    if (std::string(object->dlpi_name).find("libode_predictive_space") == std::string::npos)
        return 0;
    for (int i = 0; i < object->dlpi_phnum; ++i)
        if (const auto &segment = object->dlpi_phdr[i]; segment.p_type == PT_LOAD && (segment.p_flags & PF_X))
        {
            const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr;
            our_code.push_back({begin, begin + segment.p_memsz, object->dlpi_addr});
        }
    return 0;
}

constexpr int most_noted = 16;
std::atomic<int> noted{0};
std::atomic<std::uintptr_t> noted_places[most_noted];

void note_if_ours(std::uintptr_t place)
{
    const auto holds = [place](const Code &code) { return code.begin <= place && place < code.end; };
    const auto code = std::find_if(our_code.begin(), our_code.end(), holds);
    if (code == our_code.end())
        return;
    place -= code->base;
    const int known = std::min(noted.load(), most_noted);
    if (known < most_noted && std::find(noted_places, noted_places + known, place) == noted_places + known)
        if (const int index = noted++; index < most_noted)
            noted_places[index] = place;
}

// Continues behind the instruction, after which on_step() traps again.
void on_exception(int, siginfo_t *, void *context)
{
    auto &machine = static_cast<ucontext_t *>(context)->uc_mcontext;
    note_if_ours(static_cast<std::uintptr_t>(machine.gregs[REG_RIP]));
    machine.fpregs->mxcsr |= trapped;
    machine.gregs[REG_EFL] |= single_step;
}

void on_step(int, siginfo_t *, void *context)
{
    auto &machine = static_cast<ucontext_t *>(context)->uc_mcontext;
    machine.fpregs->mxcsr &= ~trapped;
    machine.gregs[REG_EFL] &= ~single_step;
}

void handle(int signal, void (*handler)(int, siginfo_t *, void *))
{
    struct sigaction action = {};
    action.sa_sigaction = handler;
    action.sa_flags = SA_SIGINFO;
    sigaction(signal, &action, nullptr);
}

std::string text_of_noted()
{
    std::ostringstream text;
    text << "invalid operations or divisions by zero in the library at" << std::hex;
    for (int i = 0; i < std::min(noted.load(), most_noted); ++i)
        text << " 0x" << noted_places[i];
    return text.str();
}

// These tests give the space numbers that are not finite, so results are not finite, either.
const std::set<std::string> not_finite = {"Contract.13_GeomsGoToExtremesAndComeBack",
                                          "Contract.13_BodiesGoToExtremesAndComeBack",
                                          "Contract.13_ExtremeVelocities",
                                          "Contract.13_ManyExtremeGeomsOfEveryKind",
                                          "Contract.13_ExtremeGeomsInNestedSpaces",
                                          "Contract.13_NothingIsLeftOutBySpheresForWantOfANumber",
                                          "Contract.13_OthersAreNotPoisoned",
                                          "Contract.13_SpacesOfGeomsWithoutAPlaceMeetWhatHasNoBounds",
                                          "Contract.13_DeviationsMayHaveNoEnd",
                                          "Contract.13_BodiesMayLoseTheirRotation",
                                          "UnchangedPose.APositionThatIsNoNumber",
                                          "HullData.OfAMeshThatIsNotFiniteIsNone",
                                          "ShapeProximity.OfPlacesThatAreNotNumbersIsThatOfBoxes"};

class Trapping : public ::testing::EmptyTestEventListener
{
    void OnTestStart(const ::testing::TestInfo &test) override
    {
        noted = 0;
        if (not_finite.count(std::string(test.test_suite_name()) + "." + test.name()) == 0)
            _mm_setcsr(_mm_getcsr() & ~trapped); // threads that the test starts inherit this
    }

    // A failure that is added here still counts for the test.
    void OnTestEnd(const ::testing::TestInfo &) override
    {
        _mm_setcsr(_mm_getcsr() | trapped);
        EXPECT_EQ(noted, 0) << text_of_noted();
    }

public:
    Trapping()
    {
        dl_iterate_phdr(add_if_ours, nullptr);
        handle(SIGFPE, on_exception);
        handle(SIGTRAP, on_step);
    }
};

class TrappingEnvironment : public ::testing::Environment
{
    void SetUp() override { ::testing::UnitTest::GetInstance()->listeners().Append(new Trapping); }
};

const ::testing::Environment *const environment = ::testing::AddGlobalTestEnvironment(new TrappingEnvironment);
} // namespace
