#include "tests/benchmarks/instructions/motion_stream.h"

#include <stdexcept>
#include <type_traits>

namespace ode_predictive_space::benchmarks
{
static_assert(std::is_trivially_copyable_v<Move>, "moves are written as they lie in memory");

void write_moves(std::FILE *out, const std::vector<Move> &moves)
{
    const std::uint64_t count = moves.size();
    if (std::fwrite(&count, sizeof count, 1, out) != 1 ||
        (!moves.empty() && std::fwrite(moves.data(), sizeof(Move), moves.size(), out) != moves.size()))
    {
        throw std::runtime_error("the motion could not be passed on");
    }
}

std::vector<Move> read_moves(std::FILE *in)
{
    std::uint64_t count = 0;
    if (std::fread(&count, sizeof count, 1, in) != 1)
    {
        throw std::runtime_error("the motion ends early");
    }
    std::vector<Move> moves(count);
    if (count > 0 && std::fread(moves.data(), sizeof(Move), moves.size(), in) != moves.size())
    {
        throw std::runtime_error("the motion ends early");
    }
    return moves;
}
} // namespace ode_predictive_space::benchmarks
