// Where moves are noted as they are noticed, until the next update takes them down.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NOTICE_BOARD_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NOTICE_BOARD_H

#include <cstring>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "ode_predictive_space/broadphase/growth.h"
#include "ode_predictive_space/broadphase/id_set.h"

namespace ode_predictive_space
{
/// A byte per proxy. Notes come in one right after the other: a byte is written and not read, whereas a bit would have to
/// wait until the one before it in the same word has been written.
class NoticeBoard
{
public:
    /// Makes room for proxies 0 to count - 1; what is noted stays.
    void resize(std::size_t count) { grow(notes_, (count + per_word - 1) / per_word * per_word); }

    void note(ProxyId id) { notes_[id] = noted; }
    void erase(ProxyId id) { notes_[id] = 0; }

    /// Inserts into the set, which must have room for them, all that are noted, and forgets them here.
    void take_down(IdSet &set)
    {
        std::uint8_t *notes = notes_.data();
        for (std::size_t i = 0; i < notes_.size() / per_word; ++i, notes += per_word)
            if (const std::uint64_t word = as_word(notes))
            {
                set.insert_word(i, word);
                std::memset(notes, 0, per_word);
            }
    }

    std::size_t bytes() const { return notes_.capacity(); }

private:
    static constexpr std::size_t per_word = 64; // as in a word of a set
    static constexpr std::uint8_t noted = 0xff;

    static std::uint64_t as_word(const std::uint8_t *notes)
    {
        std::uint64_t word = 0;
#if defined(__SSE2__)
        for (unsigned first = 0; first < per_word; first += 16)
        {
            const __m128i sixteen = _mm_loadu_si128(reinterpret_cast<const __m128i *>(notes + first));
            word |= std::uint64_t{static_cast<std::uint16_t>(_mm_movemask_epi8(sixteen))} << first;
        }
#else
        for (unsigned i = 0; i < per_word; ++i)
            word |= std::uint64_t{notes[i] & 1u} << i;
#endif
        return word;
    }

    std::vector<std::uint8_t> notes_;
};
} // namespace ode_predictive_space

#endif
