#include "ode_predictive_space/haptics/safety.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
Notice::Notice(NoticeKind notice_kind, double notice_time, std::string_view sentence)
    : kind(notice_kind), time(notice_time)
{
    const std::size_t length = std::min(sentence.size(), text.size() - 1);
    std::copy_n(sentence.begin(), length, text.begin());
}
} // namespace ode_predictive_space::haptics
