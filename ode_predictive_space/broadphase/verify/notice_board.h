// Where moves are noted as they are reported, until the next update collects them.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_NOTICE_BOARD_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_NOTICE_BOARD_H

#include <cstring>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/base/simd.h"

namespace ode_predictive_space
{
/// A byte per object. Notices follow each other closely: a byte is only written, whereas a bit would have to wait until the
/// one before it in the same word has been written.
class NoticeBoard
{
public:
    /// Makes room for objects 0 to count - 1. Notes below that stay.
    void resize(std::size_t count) { resize_array(notes_, (count + per_word - 1) / per_word * per_word); }

    void note(ProxyId id) { notes_[id] = noted; }
    void erase(ProxyId id) { notes_[id] = 0; }

    /// Inserts all noted objects into the set, which must have room for them, and forgets them here.
    void drain_into(IdSet &set)
    {
        std::uint8_t *notes = notes_.data();
        for (std::size_t i = 0; i < notes_.size() / per_word; ++i, notes += per_word)
            if (const std::uint64_t word = as_word(notes))
            {
                set.insert_word(i, word);
                std::memset(notes, 0, per_word);
            }
    }

    std::size_t bytes() const { return bytes_of(notes_); }

private:
    static constexpr std::size_t per_word = IdSet::bits_per_word;
    static constexpr std::uint8_t noted = 0xff;

    static std::uint64_t as_word(const std::uint8_t *notes)
    {
        std::uint64_t word = 0;
        for (unsigned first = 0; first < per_word; first += 16)
            word |= std::uint64_t{high_bits(notes + first)} << first;
        return word;
    }

    std::vector<std::uint8_t> notes_;
};
} // namespace ode_predictive_space

#endif
